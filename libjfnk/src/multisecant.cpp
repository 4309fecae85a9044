#include <cmath>
#include <limits>
#include <utility>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// A first step that changes F by less than this part of what the Jacobian action said is a sign of
// noise in the action.
constexpr double far_less = 0.3;

int patience(const Solve& solve) {
  constexpr int unpreconditioned = 20;
  constexpr int preconditioned = 10;
  const int chosen = solve.options.multisecant.patience;
  if (chosen > 0) return chosen;
  return solve.evaluator.preconditioner().is_identity() ? unpreconditioned : preconditioned;
}

/// The multisecant step from work.base into work.step:
/// du = -dU gamma - mixing P (F - dF gamma), gamma = argmin ||F - dF gamma||.
void find_step(Solve& solve) {
  Workspace& work = solve.work;
  Vector& remainder = work.evaluator.probe;
  work.secants.project(work.base.r, work.step, remainder, solve.evaluator.product());
  solve.evaluator.precondition(remainder, work.direction);
  work.step -= solve.course.mixing * work.direction;
  solve.evaluator.filter(work.base.u, work.step);
}

/// Evaluates base + step; out of the domain, halves the way from the best point to the trial.
Ending look(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  work.trial.u = work.base.u + work.step;
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

/// Stores the pair (trial - base) and makes the trial the base; returns the change of F.
double move(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  Vector& difference = work.evaluator.probe;
  work.step = work.trial.u - work.base.u;
  difference = work.trial.r - work.base.r;
  line.step_norm = product.norm(work.step);
  const double change = product.norm(difference);
  work.secants.add(work.step, difference, solve.options.multisecant.max_condition, product);
  std::swap(work.base, work.trial);
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
  solve.course.mixing *= along / length / length;
  solve.course.expected_change = std::abs(solve.course.mixing) * length * work.base.norm;
  work.secants.add(work.step, work.direction, solve.options.multisecant.max_condition, product);
  return Ending::go_on;
}

/// Begins the memory anew with what the last Newton step learnt of the Jacobian.
void renew_memory(Solve& solve) {
  Workspace& work = solve.work;
  CountedPreconditioner counted{&solve.evaluator};
  work.secants.clear();
  work.gmres.hand_out_space(counted.ref(), [&](const Vector& z, const Vector& q, const auto& r) {
    return work.secants.append(z, q, r, solve.options.multisecant.max_condition);
  });
}

}  // namespace

void begin_multisecant(Solve& solve) {
  Course& course = solve.course;
  const bool alone = solve.options.method == Method::multisecant;
  solve.return_to_best();
  course.stage = Stage::multisecant;
  course.stage_iterations = 0;
  course.stage_limit = alone ? solve.options.max_iterations : std::numeric_limits<int>::max();
  course.stage_start_norm = solve.work.best.norm;
  course.wild = 0;
  course.mark = solve.work.best.norm;
  course.last_fall = solve.evaluations();
  if (solve.options.multisecant.renew && solve.work.gmres.can_shorten()) renew_memory(solve);
}

Ending multisecant_step(Solve& solve) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  const Multisecant& rule = solve.options.multisecant;
  if (!course.mixing_known) {
    course.mixing_known = true;
    course.mixing = rule.mixing;
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
  const double expected = std::exchange(course.expected_change, 0.0);
  if (change < far_less * expected && may_measure_noise(solve)) {
    Ending ending = Ending::go_on;
    if (adapt_to_noise(solve, ending)) {
      solve.return_to_best();
      return Ending::go_on;
    }
    if (ending != Ending::go_on) return ending;
  }
  ++solve.report.multisecant_iterations;
  if (const Ending ending = solve.accept_base(line); ending != Ending::go_on) return ending;
  if (work.best.norm < rule.progress * course.mark) {
    course.mark = work.best.norm;
    course.last_fall = solve.evaluations();
  }
  if (solve.evaluations() - course.last_fall >= patience(solve)) return Ending::patience_lost;
  course.wild = work.base.norm > rule.wild * work.best.norm ? course.wild + 1 : 0;
  if (course.wild >= rule.wild_patience) return Ending::patience_lost;
  if (work.base.norm > rule.rejection * work.best.norm) solve.return_to_best();
  return Ending::go_on;
}

}  // namespace jfnk::detail
