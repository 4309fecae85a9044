#include "strategy.hpp"

// Newton's full steps as a way out, for semismooth systems such as contact.
namespace jfnk::detail {
namespace {

// A semismooth system that full steps solve at all took less than this.
constexpr int most_full_steps = 100;

/// Whether there are factors that can be had anew at each step.
bool has_renewable_factors(const Solve& solve) {
  return solve.work.evaluator_state.learnt || solve.evaluator.caller_can_set_up();
}

/// Whether full steps are a way out: there are such factors, and it is not what was asked for.
bool may_take_full_steps(const Solve& solve) {
  return solve.options.stagnation.restart && has_renewable_factors(solve) &&
         solve.options.globalisation.rule != Globalisation::Rule::full_steps;
}

/// From the first point, without regard to ||F||, as semismooth systems want them.
void begin_full_steps(Solve& solve) {
  Course& course = solve.course;
  Workspace& work = solve.work;
  solve.evaluator.resume_preconditioner();
  if (solve.evaluator.caller_can_set_up()) work.evaluator_state.learnt = false;
  begin_newton(solve, most_full_steps);
  work.base = work.first;
  solve.evaluator.accept(work.base.u);
  course.newton.by_lines = false;
  course.newton.by_full_steps = true;
}

/// Whether the last Newton step was cut so far that ||F|| must be kinked or bent too much for it,
/// before anything else has failed.
bool step_was_cut_short(const Solve& solve) {
  constexpr double short_part = 0.01;
  const Course& course = solve.course;
  const Iteration& last = solve.report.history.back();
  return last.phase == Phase::newton && course.rescue.newton_failure == Ending::go_on &&
         !by_full_steps(solve) && last.step_length < short_part && course.newton.left_domain == 0;
}

}  // namespace

void try_full_steps_early(Solve& solve) {
  bool& tried = solve.course.rescue.early_full_steps;
  if (tried || !may_take_full_steps(solve) || !solve.evaluator.caller_can_set_up() ||
      !step_was_cut_short(solve))
    return;
  tried = true;
  begin_full_steps(solve);
}

bool try_full_steps_amid_rescues(Solve& solve) {
  bool& tried = solve.course.rescue.early_full_steps;
  if (tried || !may_take_full_steps(solve)) return false;
  tried = true;
  begin_full_steps(solve);
  return true;
}

bool try_full_steps_at_last(Solve& solve) {
  bool& tried = solve.course.rescue.last_full_steps;
  if (tried || !may_take_full_steps(solve)) return false;
  tried = true;
  begin_full_steps(solve);
  return true;
}

}  // namespace jfnk::detail
