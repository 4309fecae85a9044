#include <algorithm>
#include <cmath>
#include <utility>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// The first explicit step of the flow would change u by this part of 1 + ||u||.
constexpr double first_change = 0.1;
// A step that raises ||F|| more than this is made again, shorter.
constexpr double greatest_rise = 2.0;
constexpr double time_cut = 0.25;
constexpr double steady_growth = 1.5;  // besides ||F_k-1|| / ||F_k||
constexpr double greatest_growth = 10.0;
constexpr int max_cuts = 12;
// A change of ||F|| by less than this part is none; after so many such steps, each ten times as
// long as the one before, F is flat or u at the end of its domain.
constexpr double hardly_any = 1e-6;
constexpr int most_idle_steps = 8;
constexpr double linear_tolerance = 0.1;
// Beyond this times its first ||F|| the flow runs away.
constexpr double far_away = 1e3;

/// With the learnt Jacobian: factors of J + shift I, J as new as that pays.
Ending renew_shifted_factors(Solve& solve, double shift) {
  LearntJacobian& jacobian = solve.work.evaluator.learnt;
  bool usable = true;
  Ending ending = Ending::go_on;
  if (solve.course.stage.iterations == 0 ||
      2.0 * solve.course.preconditioner.stale >= jacobian.groups()) {
    ending = renew_learnt_jacobian(solve, shift, usable);
  } else if (shift != jacobian.shift()) {
    usable = jacobian.factorise(shift);
  }
  if (!usable) solve.evaluator.drop_preconditioner();
  return ending;
}

}  // namespace

void begin_pseudo_transient(Solve& solve) {
  Course& course = solve.course;
  const InnerProductRef& product = solve.evaluator.product();
  solve.return_to_best();
  course.stage.kind = Stage::pseudo_transient;
  course.stage.iterations = 0;
  course.stage.limit = solve.options.pseudo_transient.max_steps;
  course.stage.start_norm = solve.work.best.norm;
  course.rescue.transient_tried = true;
  course.transient.time_step = 0.0;
  course.transient.time_step =
      first_change * (1.0 + product.norm(solve.work.base.u)) / solve.work.base.norm;
  course.transient.shift_sign = 0.0;
  course.transient.idle_steps = 0;
}

Ending pseudo_transient_step(Solve& solve) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  const InnerProductRef& product = solve.evaluator.product();
  if (course.transient.shift_sign == 0.0) {
    // The flow du/dt = -F settles if J is positive along F, du/dt = F if it is negative.
    course.transient.shift_sign = 1.0;
    if (solve.evaluator.linearise(work.base) == Outcome::ok) {
      const Outcome outcome = solve.evaluator.action(work.base.r, work.direction);
      if (outcome == Outcome::stopped) return Ending::stopped;
      if (outcome == Outcome::limit) return Ending::limit;
      if (outcome == Outcome::ok && product.dot(work.direction, work.base.r) < 0.0) {
        course.transient.shift_sign = -1.0;
      }
    }
  }
  for (int cut = 0; cut <= max_cuts; ++cut) {
    const double shift = course.transient.shift_sign / course.transient.time_step;
    if (solve.evaluator.preconditioned_by_learning()) {
      const Ending ending = renew_shifted_factors(solve, shift);
      if (ending != Ending::go_on) return ending;
    }
    Iteration line;
    line.phase = Phase::pseudo_transient;
    const LinearSolution solution = find_direction(solve, linear_tolerance, shift, line);
    if (is_final(solution.ending)) return solution.ending;
    if (solution.ending == Ending::go_on) {
      solve.evaluator.filter(work.base.u, work.direction);
      work.trial.u = work.base.u + work.direction;
      const Outcome outcome = solve.evaluator.evaluate(work.trial, &Counts::pseudo_transient);
      if (outcome == Outcome::stopped) return Ending::stopped;
      if (outcome == Outcome::limit) return Ending::limit;
      if (outcome == Outcome::ok && work.trial.norm <= greatest_rise * work.base.norm) {
        const double ratio = work.base.norm / work.trial.norm;
        const bool idle = std::abs(ratio - 1.0) < hardly_any;
        course.transient.idle_steps = idle ? course.transient.idle_steps + 1 : 0;
        course.transient.time_step *=
            idle ? greatest_growth : std::min(steady_growth * ratio, greatest_growth);
        line.step_length = 1.0;
        line.step_norm = product.norm(work.direction);
        std::swap(work.base, work.trial);
        ++solve.report.pseudo_transient_steps;
        const Ending ending = solve.accept_base(line);
        const bool given_up = course.transient.idle_steps >= most_idle_steps ||
                              work.base.norm > far_away * course.stage.start_norm;
        return ending == Ending::go_on && given_up ? Ending::transient_failed : ending;
      }
    }
    course.transient.time_step *= time_cut;
  }
  return Ending::transient_failed;
}

}  // namespace jfnk::detail
