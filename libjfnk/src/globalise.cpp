#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// Part of the predicted reduction below which the radius shrinks, and above which it grows (Dennis
// & Schnabel 1983).
constexpr double poor = 0.1;
constexpr double good = 0.75;
constexpr double radius_growth = 4.0;

// Parabola and dogleg give up at this part of the full step: what is gained there is not progress.
constexpr double least_fraction = 1e-6;

// After a step that left the domain the next one is at most so many times as long at first.
constexpr double growth_at_edge = 2.0;

/// The longest step worth a try, by where the domain ended last; none known: infinite.
double reach(const Solve& solve) {
  const double feasible = solve.course.newton.feasible;
  return feasible > 0.0 ? growth_at_edge * feasible : std::numeric_limits<double>::infinity();
}

/// Remembers how long a step was in the end, if it had to be cut by the domain; a whole one tells
/// that the edge is no more near.
void remember_domain(Solve& solve, double step_norm, bool whole) {
  NewtonCourse& course = solve.course.newton;
  if (course.left_domain > 0) {
    course.feasible = step_norm;
  } else if (whole) {
    course.feasible = 0.0;
  } else if (course.feasible > 0.0) {
    course.feasible = std::max(course.feasible, step_norm);
  }
}

/// What a trial must not exceed: the highest of the last norms.
double yardstick(const Solve& solve) {
  const Course& course = solve.course;
  double highest = solve.work.base.norm;
  for (int i = 0; i < course.newton.last_norms_count; ++i) {
    highest = std::max(highest, course.newton.last_norms[static_cast<std::size_t>(i)]);
  }
  return highest;
}

void remember_norm(Solve& solve, double norm) {
  Course& course = solve.course;
  const int kept = solve.options.globalisation.window - 1;
  if (kept <= 0) return;
  auto& norms = course.newton.last_norms;
  for (int i = std::min(course.newton.last_norms_count, kept - 1); i > 0; --i) {
    norms[static_cast<std::size_t>(i)] = norms[static_cast<std::size_t>(i) - 1];
  }
  norms[0] = norm;
  course.newton.last_norms_count = std::min(course.newton.last_norms_count + 1, kept);
}

/// Cut of a step by the parabola through ||F||^2 at its ends and its slope -2 ||F|| (||F|| -
/// predicted) at the beginning.
double parabola_cut(const Globalisation& rule, double norm, double predicted, double found) {
  const double slope = -2.0 * norm * std::max(norm - predicted, 0.0);
  const double excess = (found - norm) * (found + norm) - slope;
  const double lowest = excess > 0.0 ? -0.5 * slope / excess : rule.greatest_cut;
  return std::clamp(lowest, rule.least_cut, rule.greatest_cut);
}

/// ||F|| along a step that is cut again and again: its slope at the beginning, by the last two
/// trials, against the one that J v promises.
class SlopeTest {
 public:
  explicit SlopeTest(double norm) : norm_(norm) {}
  /// ||F|| = `found` at a length where the linear model has `predicted`.
  void see(double length, double found, double predicted) {
    longer_ = shorter_;
    shorter_ = {length, (found - norm_) / length};
    promised_ = (predicted - norm_) / length;
    ++seen_;
  }
  [[nodiscard]] Trouble verdict() const {
    constexpr double near = 0.5;
    if (seen_ < 2 || !(promised_ < 0.0)) return Trouble::domain_edge;
    const double slope = (shorter_.slope * longer_.length - longer_.slope * shorter_.length) /
                         (longer_.length - shorter_.length);
    return std::abs(slope / promised_ - 1.0) < near ? Trouble::minimum : Trouble::broken_promise;
  }

 private:
  struct Secant {
    double length = 0.0;
    double slope = 0.0;
  };
  double norm_;
  double promised_ = 0.0;
  Secant longer_;
  Secant shorter_;
  int seen_ = 0;
};

Outcome look(Solve& solve, int cut) {
  Workspace& work = solve.work;
  int& left_domain = solve.course.newton.left_domain;
  if (cut == 0) left_domain = 0;
  const Outcome outcome = solve.evaluator.evaluate(
      work.trial, cut == 0 ? &Counts::newton_trials : &Counts::line_search);
  if (outcome == Outcome::out_of_domain) ++left_domain;
  return outcome;
}

Ending refused(Outcome outcome) {
  return outcome == Outcome::stopped ? Ending::stopped : Ending::limit;
}

void take_trial(Solve& solve, double fraction, Iteration& line) {
  Workspace& work = solve.work;
  remember_norm(solve, work.base.norm);
  std::swap(work.base, work.trial);
  line.step_length = fraction;
}

/// The end of a search in vain, after a last trial at base + last direction.
Ending fail(Solve& solve, const SlopeTest& test, double last, const Iteration& line) {
  // A step that promised nothing has told why already.
  constexpr double nothing_gained = 0.999;
  if (line.linear_residual > nothing_gained) return Ending::line_search_failed;
  Workspace& work = solve.work;
  Trouble trouble = test.verdict();
  if (trouble == Trouble::broken_promise) {
    // If ||F|| rises on the other side, too, it is at a minimum that J v cannot see.
    work.trial.u = work.base.u - last * work.direction;
    const Outcome outcome = solve.evaluator.evaluate(work.trial, &Counts::line_search);
    if (outcome == Outcome::stopped) return Ending::stopped;
    if (outcome == Outcome::ok && work.trial.norm >= work.base.norm) trouble = Trouble::minimum;
  }
  solve.note_trouble(trouble);
  return Ending::line_search_failed;
}

Ending search_line(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const Globalisation& rule = solve.options.globalisation;
  solve.evaluator.filter(work.base.u, work.direction);
  const double direction_norm = solve.evaluator.product().norm(work.direction);
  const double rho = std::min(1.0, line.linear_residual);
  const double gain = rule.sufficient_decrease * (1.0 - rho);
  const double highest = yardstick(solve);
  SlopeTest test(work.base.norm);
  const double first = std::min(1.0, reach(solve) / direction_norm);
  double lambda = first;
  double last = first;
  for (int cut = 0; cut <= rule.max_cuts; ++cut) {
    last = lambda;
    work.trial.u = work.base.u + last * work.direction;
    const Outcome outcome = look(solve, cut);
    if (outcome == Outcome::stopped || outcome == Outcome::limit) return refused(outcome);
    // Without a decrease asked for, a trial that changes nothing is no progress either.
    const bool falls =
        gain > 0.0 ? work.trial.norm <= (1.0 - gain * lambda) * highest : work.trial.norm < highest;
    if (outcome == Outcome::ok && falls) {
      take_trial(solve, lambda, line);
      line.step_norm = lambda * direction_norm;
      remember_domain(solve, line.step_norm, lambda == 1.0);
      return Ending::go_on;
    }
    const double predicted = work.base.norm * (1.0 - lambda * (1.0 - rho));
    if (outcome == Outcome::ok) test.see(lambda, work.trial.norm, predicted);
    if (outcome != Outcome::ok) {
      lambda *= rule.domain_factor;
    } else if (rule.rule == Globalisation::Rule::backtracking) {
      lambda *= rule.factor;
    } else {
      lambda *= parabola_cut(rule, work.base.norm, predicted, work.trial.norm);
      if (lambda < least_fraction) break;
    }
  }
  return fail(solve, test, last, line);
}

/// Like search_line, along the dogleg path of the Krylov space and within a radius that lives on.
Ending search_dogleg(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  const Globalisation& rule = solve.options.globalisation;
  const InnerProductRef& product = solve.evaluator.product();
  const double full = work.gmres.length();
  const double norm = work.base.norm;
  const double highest = yardstick(solve);
  double length = course.newton.radius > 0.0 ? std::min(full, course.newton.radius) : full;
  double predicted = norm * std::min(1.0, line.linear_residual);
  CountedPreconditioner counted{&solve.evaluator};
  const PreconditionerRef P = counted.ref();
  SlopeTest test(norm);
  for (int cut = 0; cut <= rule.max_cuts; ++cut) {
    if (length < full) predicted = work.gmres.shorten(length, P, work.direction, product);
    solve.evaluator.filter(work.base.u, work.direction);
    work.trial.u = work.base.u + work.direction;
    const Outcome outcome = look(solve, cut);
    if (outcome == Outcome::stopped || outcome == Outcome::limit) return refused(outcome);
    const double hoped = std::max(norm - predicted, 0.0);
    if (outcome == Outcome::ok && work.trial.norm <= highest - rule.sufficient_decrease * hoped) {
      const double ratio = (norm - work.trial.norm) / hoped;
      if (ratio < poor) {
        course.newton.radius = rule.greatest_cut * length;
      } else if (ratio > good || cut == 0) {
        const double growth = course.newton.left_domain > 0 ? growth_at_edge : radius_growth;
        course.newton.radius = std::max(course.newton.radius > 0.0 ? course.newton.radius : full,
                                        (ratio > good ? growth : 1.0) * length);
      } else {
        course.newton.radius = length;
      }
      line.step_norm = product.norm(work.direction);
      take_trial(solve, length / full, line);
      return Ending::go_on;
    }
    if (outcome == Outcome::ok) test.see(length, work.trial.norm, predicted);
    length *= outcome == Outcome::ok ? parabola_cut(rule, norm, predicted, work.trial.norm)
                                     : rule.domain_factor;
    course.newton.radius = length;
    if (length < least_fraction * full) break;
  }
  return fail(solve, test, 1.0, line);
}

/// Takes the step as it is; cuts it only where F has no value.
Ending take_whole_step(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const Globalisation& rule = solve.options.globalisation;
  solve.evaluator.filter(work.base.u, work.direction);
  const double direction_norm = solve.evaluator.product().norm(work.direction);
  double lambda = std::min(1.0, reach(solve) / direction_norm);
  for (int cut = 0; cut <= rule.max_cuts; ++cut) {
    work.trial.u = work.base.u + lambda * work.direction;
    const Outcome outcome = look(solve, cut);
    if (outcome == Outcome::stopped || outcome == Outcome::limit) return refused(outcome);
    if (outcome == Outcome::ok) {
      line.step_norm = lambda * direction_norm;
      remember_domain(solve, line.step_norm, lambda == 1.0);
      take_trial(solve, lambda, line);
      return Ending::go_on;
    }
    lambda *= rule.domain_factor;
  }
  solve.note_trouble(Trouble::domain_edge);
  return Ending::line_search_failed;
}

}  // namespace

bool by_full_steps(const Solve& solve) {
  const NewtonCourse& course = solve.course.newton;
  const bool chosen = solve.options.globalisation.rule == Globalisation::Rule::full_steps;
  return course.by_full_steps || (chosen && !course.by_lines);
}

Ending globalise(Solve& solve, bool gmres, Iteration& line) {
  if (by_full_steps(solve)) return take_whole_step(solve, line);
  const bool dogleg = solve.options.globalisation.rule == Globalisation::Rule::dogleg &&
                      !solve.course.newton.by_lines;
  return dogleg && gmres ? search_dogleg(solve, line) : search_line(solve, line);
}

}  // namespace jfnk::detail
