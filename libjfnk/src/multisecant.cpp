#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "passes.hpp"
#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// A first step that changes F by less than this part of what the Jacobian action said is a sign of
// noise in the action.
constexpr double far_less = 0.3;

/// Evaluations allowed without progress: after a round of Newton no more than that took.
int patience(const Solve& solve) {
  constexpr int unpreconditioned = 20;
  constexpr int preconditioned = 10;
  constexpr int least = 4;
  const int chosen = solve.options.multisecant.patience;
  if (chosen > 0) return chosen;
  const bool plain = solve.evaluator.preconditioner().is_identity();
  const int most = plain ? unpreconditioned : preconditioned;
  const int cost = solve.course.rescue.round_cost;
  return cost > 0 ? std::clamp(cost, least, most) : most;
}

/// Points in a row far above the best that are suffered. With factors that can be had anew, fewer.
int wild_patience(const Solve& solve) {
  constexpr int with_learnt_factors = 2;
  const int chosen = solve.options.multisecant.wild_patience;
  return solve.evaluator.preconditioned_by_learning() ? std::min(chosen, with_learnt_factors)
                                                      : chosen;
}

/// Whether Broyden's updates of the preconditioner are kept besides the least squares.
bool has_broyden(const Solve& solve) {
  return solve.options.multisecant.broyden && !solve.evaluator.preconditioner().is_identity();
}

/// Whether P F at work.base is of use.
bool keeps_preconditioned(const Solve& solve) {
  return keeps_images(solve) || in_preconditioned_norm(solve);
}

/// Forgets what belongs to a point that work.base is no more.
void forget_base(Solve& solve) {
  solve.course.multisecant.inverted = false;
  solve.course.multisecant.preconditioned = false;
  solve.work.secants.forget_next();
}

/// P F at work.base into work.preconditioned, unless it is there.
void precondition_base(Solve& solve) {
  Workspace& work = solve.work;
  const bool known = std::exchange(solve.course.multisecant.preconditioned, true);
  if (known && work.preconditioned.size() == work.base.r.size()) return;
  solve.evaluator.precondition(work.base.r, work.preconditioned);
}

/// H F = dU gamma + mixing P (F - dF gamma) at work.base, gamma = argmin ||F - dF gamma||, or of P
/// times that; `sign` times H F.
void invert_by_least_squares(Solve& solve, double sign, Vector& z) {
  Workspace& work = solve.work;
  const Vector& r = work.base.r;
  const double mixing = solve.course.multisecant.mixing;
  const InnerProductRef& product = solve.evaluator.product();
  if (in_preconditioned_norm(solve)) {
    work.secants.invert(work.preconditioned, work.preconditioned, mixing, sign, z, product);
  } else if (keeps_images(solve)) {
    work.secants.invert(r, work.preconditioned, mixing, sign, z, product);
  } else if (solve.evaluator.preconditioner().is_identity()) {
    work.secants.invert(r, r, mixing, sign, z, product);
  } else {
    Vector& remainder = work.evaluator.probe;
    work.secants.project(r, z, remainder, product);
    solve.evaluator.precondition(remainder, work.direction);
    product.pass(z.size(), 3, [&](Rows rows) {
      rows.of(z) = sign * mixing * rows.of(work.direction) - sign * rows.of(z);
    });
  }
}

/// H F at work.base by rank-one updates of mixing P.
void invert_by_broyden(Solve& solve, Vector& z) {
  z = solve.course.multisecant.mixing * solve.work.preconditioned;
  solve.work.broyden.improve(z, solve.evaluator.product());
}

/// Whether the next step is Broyden's: it foretold the last ones well, and not worse.
bool trusts_broyden(const Solve& solve) {
  // Broyden, Dennis & Moré (1973) ask ||I - H J|| < 1/2 of H; 0.4 to 0.6 serve alike.
  constexpr double greatest_error = 0.6;
  const Course& course = solve.course;
  const bool drawn = course.multisecant.lead == 0.0;
  const bool leads = drawn ? solve.work.broyden.size() >= solve.work.secants.size()
                           : course.multisecant.lead < 0.0;
  return leads && course.multisecant.broyden_error <= greatest_error;
}

/// The step from work.base into work.step.
void find_step(Solve& solve) {
  Workspace& work = solve.work;
  if (keeps_images(solve) != work.secants.has_images()) work.secants.clear(keeps_images(solve));
  if (work.secants.images_are_old()) {
    work.secants.renew_images(
        [&](const Vector& y, Vector& image) { solve.evaluator.precondition(y, image); });
  }
  if (keeps_preconditioned(solve)) precondition_base(solve);
  if (!has_broyden(solve)) {
    invert_by_least_squares(solve, -1.0, work.step);
  } else {
    invert_by_least_squares(solve, 1.0, work.by_least_squares);
    if (!solve.course.multisecant.inverted) invert_by_broyden(solve, work.by_broyden);
    work.step = trusts_broyden(solve) ? -work.by_broyden : -work.by_least_squares;
  }
  solve.evaluator.filter(work.base.u, work.step);
}

/// Evaluates base + step; out of the domain, halves the way from the best point to the trial.
Ending look(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  add(solve.evaluator.product(), work.trial.u, work.base.u, 1.0, work.step);
  line.step_length = 1.0;
  for (int cut = 0; cut <= solve.options.multisecant.max_cuts; ++cut) {
    const Outcome outcome = solve.evaluator.evaluate(
        work.trial, cut == 0 ? &Counts::multisecant : &Counts::line_search);
    if (outcome == Outcome::ok) return Ending::go_on;
    if (outcome == Outcome::stopped) return Ending::stopped;
    if (outcome == Outcome::limit) return Ending::limit;
    work.trial.u = 0.5 * (work.trial.u + work.best.u);
    line.step_length *= 0.5;
  }
  return Ending::patience_lost;
}

/// Lets both models foretell work.step, which led from work.trial to work.base, from the change of
/// F; then Broyden's learns from it.
void compare_models(Solve& solve) {
  // Of former pairs: the last five or so count for the lead, the last two for the error.
  constexpr double memory = 0.8;
  constexpr double error_memory = 0.5;
  constexpr double hopeless = 1e100;
  Workspace& work = solve.work;
  Course& course = solve.course;
  const InnerProductRef& product = solve.evaluator.product();
  const auto error = [&](const Vector& image) {
    work.direction = work.step - image;
    const double relative = product.norm(work.direction) / product.norm(work.step);
    return std::isfinite(relative)
               ? std::clamp(relative, std::numeric_limits<double>::epsilon(), hopeless)
               : hopeless;
  };
  invert_by_least_squares(solve, 1.0, work.image);
  work.by_least_squares = work.image - work.by_least_squares;
  const double by_least_squares = error(work.by_least_squares);
  invert_by_broyden(solve, work.image);
  work.by_broyden = work.image - work.by_broyden;
  const double by_broyden = error(work.by_broyden);
  course.multisecant.lead =
      memory * course.multisecant.lead + std::log(by_broyden / by_least_squares);
  course.multisecant.broyden_error =
      std::max(error_memory * course.multisecant.broyden_error, by_broyden);
  if (work.broyden.full()) work.broyden.clear();
  // The first pair after a restart was foretold by another H.
  course.multisecant.inverted =
      work.broyden.add(work.step, work.by_broyden, product) && work.broyden.size() > 1;
  if (!course.multisecant.inverted) return;
  work.by_broyden = work.image;
  work.broyden.improve_by_last(work.by_broyden, product);
}

/// What led from work.trial to work.base, and the change of F; returns the latter's norm.
double find_changes(Solve& solve, Vector& step, Vector& difference, double& step_norm) {
  const Iterate& from = solve.work.trial;
  const Iterate& to = solve.work.base;
  const Eigen::Index n = to.u.size();
  step.resize(n);
  difference.resize(n);
  const std::array<const Vector*, 2> both{&step, &difference};
  std::array<double, 2> norms{};
  solve.evaluator.product().pass(
      n, 6,
      [&](Rows rows) {
        rows.of(step) = rows.of(to.u) - rows.of(from.u);
        rows.of(difference) = rows.of(to.r) - rows.of(from.r);
      },
      both, norms);
  step_norm = norms[0];
  return norms[1];
}

/// Stores the pair (trial - base) and makes the trial the base; returns the change of F.
double move(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  std::swap(work.base, work.trial);
  work.secants.forget_next();
  Vector& difference = work.evaluator.probe;
  const double change = find_changes(solve, work.step, difference, line.step_norm);
  // Nothing has to be learnt for where all is done.
  if (solve.evaluator.converged(work.base, line.step_norm)) {
    forget_base(solve);
    return change;
  }
  // P F was, and becomes its change.
  Vector& image = work.preconditioned_before;
  if (keeps_preconditioned(solve)) {
    image.swap(work.preconditioned);
    solve.course.multisecant.preconditioned = false;
    precondition_base(solve);
  }
  if (has_broyden(solve)) {
    compare_models(solve);
    add(product, difference, work.base.r, -1.0, work.trial.r);  // it had other use for the memory
  }
  if (keeps_preconditioned(solve)) image = work.preconditioned - image;
  const bool of_images = in_preconditioned_norm(solve);
  work.secants.add({.du = work.step,
                    .dr = of_images ? image : difference,
                    .length = of_images ? product.norm(image) : change,
                    .image = &image,
                    .next = of_images ? &work.preconditioned : &work.base.r},
                   solve.options.multisecant.max_condition, product);
  return change;
}

/// The step length along -F that is best for the linear model, from one Jacobian action, which also
/// is the first pair of the memory.
Ending measure_mixing(Solve& solve) {
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  if (solve.evaluator.linearise(work.base) != Outcome::ok) return Ending::go_on;
  // Of unit length, so that no unit of F makes a square overflow.
  work.step = work.base.r / work.base.norm;
  const Outcome outcome = solve.evaluator.action(work.step, work.direction);
  if (outcome == Outcome::stopped) return Ending::stopped;
  if (outcome == Outcome::limit) return Ending::limit;
  const double length = product.norm(work.direction);
  const double along = product.dot(work.direction, work.step);
  if (outcome != Outcome::ok || !std::isfinite(length) || along == 0.0) return Ending::go_on;
  solve.course.multisecant.mixing *= along / length / length;
  solve.course.multisecant.expected_change =
      std::abs(solve.course.multisecant.mixing) * length * work.base.norm;
  work.secants.add({work.step, work.direction, length}, solve.options.multisecant.max_condition,
                   product);
  return Ending::go_on;
}

/// Begins the memory anew with what the last Newton step learnt of the Jacobian.
void renew_memory(Solve& solve) {
  Workspace& work = solve.work;
  CountedPreconditioner counted{&solve.evaluator};
  work.secants.clear(keeps_images(solve));
  work.gmres.hand_out_space(
      counted.ref(), [&](const Vector& z, const ColumnList& q, const auto& r) {
        return work.secants.append(z, q, r, solve.options.multisecant.max_condition,
                                   solve.evaluator.product());
      });
}

/// Whether it is time for Newton, after a step that changed F by so much.
bool loses_patience(Solve& solve, double change) {
  MultisecantCourse& course = solve.course.multisecant;
  const Workspace& work = solve.work;
  // Not by a bit: F is flat, or the step is lost in the rounding of u.
  if (change == 0.0 && solve.options.multisecant.patience == 0) return true;
  if (solve.evaluations() - course.last_fall >= patience(solve)) return true;
  const bool is_wild = work.base.norm > solve.options.multisecant.wild * work.best.norm;
  course.wild = is_wild ? course.wild + 1 : 0;
  return course.wild >= wild_patience(solve);
}

/// Whether pairs of a former solve are still in use and lead nowhere.
bool given_mislead(const Solve& solve, bool patience_lost) {
  const int idle = solve.evaluations() - solve.course.multisecant.last_fall;
  return solve.work.secants.given() > 0 &&
         (patience_lost || idle >= solve.options.multisecant.given_patience);
}

/// Goes on from the best point, knowing nothing.
void forget_given(Solve& solve) {
  solve.work.secants.clear(keeps_images(solve));
  solve.work.broyden.clear();
  solve.course.multisecant.lead = 0.0;
  solve.course.multisecant.broyden_error = 0.0;
  solve.return_to_best();
  forget_base(solve);
  solve.course.multisecant.last_fall = solve.evaluations();
  solve.course.multisecant.wild = 0;
}

/// Measures the noise if that is still due; true if the steps begin anew with what it told.
bool adapts_to_noise(Solve& solve, Ending& ending) {
  if (!may_measure_noise(solve) || !adapt_to_noise(solve, ending)) return false;
  solve.return_to_best();
  forget_base(solve);
  return true;
}

}  // namespace

bool in_preconditioned_norm(const Solve& solve) {
  // Of learnt factors it is known that they were the inverse Jacobian: P F is then the error.
  return (solve.options.multisecant.preconditioned_norm &&
          !solve.evaluator.preconditioner().is_identity()) ||
         solve.evaluator.preconditioned_by_learning();
}

bool keeps_images(const Solve& solve) {
  return has_broyden(solve) && !in_preconditioned_norm(solve);
}

void begin_multisecant(Solve& solve) {
  Course& course = solve.course;
  const bool alone = solve.options.method == Method::multisecant;
  solve.return_to_best();
  course.stage.kind = Stage::multisecant;
  course.stage.iterations = 0;
  course.stage.limit = alone ? solve.options.max_iterations : std::numeric_limits<int>::max();
  course.stage.start_norm = solve.work.best.norm;
  course.stage.start_evaluations = solve.evaluations();
  course.multisecant.wild = 0;
  course.multisecant.lead = 0.0;
  course.multisecant.broyden_error = 0.0;
  forget_base(solve);
  course.multisecant.mark = solve.work.best.norm;
  course.multisecant.last_fall = solve.evaluations();
  solve.work.broyden.clear();
  const bool helped_out = course.stage.round > 0;  // where pairs that were given led
  if (in_preconditioned_norm(solve)) {
    solve.work.secants.clear();  // the preconditioner may be another by now
  } else if (solve.options.multisecant.renew && solve.work.gmres.can_shorten()) {
    renew_memory(solve);
  } else if (helped_out && solve.work.secants.given() > 0) {
    solve.work.secants.clear(keeps_images(solve));
  }
}

Ending multisecant_step(Solve& solve) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  const Multisecant& rule = solve.options.multisecant;
  if (!course.multisecant.mixing_known) {
    course.multisecant.mixing_known = true;
    course.multisecant.mixing = rule.mixing;
    if (rule.scale_mixing && solve.evaluator.preconditioner().is_identity()) {
      if (const Ending ending = measure_mixing(solve); ending != Ending::go_on) return ending;
    }
  }
  Iteration line;
  line.phase = Phase::multisecant;
  line.secant_pairs = work.secants.size();
  find_step(solve);
  if (const Ending ending = look(solve, line); ending != Ending::go_on) return ending;
  const double change = move(solve, line);
  const double expected = std::exchange(course.multisecant.expected_change, 0.0);
  if (change < far_less * expected) {
    Ending ending = Ending::go_on;
    if (adapts_to_noise(solve, ending) || ending != Ending::go_on) return ending;
  }
  ++solve.report.multisecant_iterations;
  if (const Ending ending = solve.accept_base(line); ending != Ending::go_on) return ending;
  if (work.best.norm < rule.progress * course.multisecant.mark) {
    course.multisecant.mark = work.best.norm;
    course.multisecant.last_fall = solve.evaluations();
  }
  const bool lost = loses_patience(solve, change);
  if (given_mislead(solve, lost)) {
    forget_given(solve);
    return Ending::go_on;
  }
  if (lost) {
    // Steps in the last digits of u: is ||F|| as low as it can be?
    constexpr double last_digits = 1e-13;
    const double size = solve.evaluator.product().norm(work.base.u);
    Ending ending = Ending::patience_lost;
    if (line.step_norm > last_digits * size) return ending;
    return adapts_to_noise(solve, ending) ? Ending::go_on : ending;
  }
  if (work.base.norm > rule.rejection * work.best.norm) {
    solve.return_to_best();
    forget_base(solve);
  }
  return Ending::go_on;
}

}  // namespace jfnk::detail
