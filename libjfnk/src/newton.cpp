#include <algorithm>
#include <cmath>
#include <limits>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// A step that keeps less than this of the reduction promised is poor. So many in a row, or one so
// short, are taken for a sign of noise.
constexpr double poor = 0.1;
constexpr int too_many_poor = 3;
constexpr double too_short = 0.01;

// A linear model that could take away no more than this part of ||F|| says that ||F|| is
// stationary.
constexpr double nothing_promised = 1e-4;

// More left of ||F|| than this is no progress, whatever the options say.
constexpr double all_but_all = 1.0 - 1e-10;

/// Whether the last steps are lost in the rounding of u.
bool too_short_for_rounding(Solve& solve, const Iteration& line) {
  constexpr int too_many = 3;
  const double size = solve.evaluator.product().norm(solve.work.base.u);
  const bool is_short = line.step_norm <= std::numeric_limits<double>::epsilon() * size;
  int& count = solve.course.newton.short_steps;
  count = is_short ? count + 1 : 0;
  return count >= too_many;
}

/// Watches what the steps bring; go_on unless they bring too little.
Ending judge_progress(Solve& solve, double norm_before, const Iteration& line) {
  Course& course = solve.course;
  const double norm = solve.work.base.norm;
  const double promised = norm_before * (1.0 - line.linear_residual);
  course.newton.poor_steps =
      norm_before - norm < poor * promised ? course.newton.poor_steps + 1 : 0;
  const bool suspicious = course.newton.poor_steps >= too_many_poor ||
                          (course.newton.poor_steps > 0 && line.step_length < too_short);
  if (suspicious && may_measure_noise(solve)) {
    Ending interrupted = Ending::go_on;
    if (adapt_to_noise(solve, interrupted)) course.newton.poor_steps = 0;
    if (interrupted != Ending::go_on) return interrupted;
  }
  if (too_short_for_rounding(solve, line)) {
    solve.note_trouble(Trouble::short_steps);
    return Ending::line_search_failed;
  }
  const Stagnation& rule = solve.options.stagnation;
  if (++course.newton.window_steps < rule.window) return Ending::go_on;
  const double left = std::min(rule.left, all_but_all);
  const bool stagnated = norm > left * course.newton.window_norm;
  course.newton.window_steps = 0;
  course.newton.window_norm = norm;
  return stagnated ? Ending::stagnated : Ending::go_on;
}

/// Part of ||F|| that the linear model of the last step could take away within that step's length,
/// in whatever direction of the Krylov space.
double promise_within(Solve& solve, double norm, double fraction) {
  Workspace& work = solve.work;
  CountedPreconditioner counted{&solve.evaluator};
  const double left = work.gmres.shorten(fraction * work.gmres.length(), counted.ref(),
                                         work.direction, solve.evaluator.product());
  return 1.0 - left / norm;
}

/// Whether a stationary point can be told here: the last linear solve has seen all directions that
/// matter, and ||F|| has come down, so that it is not a maximum. With factors that can be had anew
/// there are better hopes, and what looks stationary may be a kink.
bool can_tell_stationary(const Solve& solve, const LinearSolution& solution,
                         const Iteration& line) {
  constexpr double exact = 0.1;
  constexpr double down = 0.9;
  const Eigen::Index size = solve.evaluator.residual().global_size(solve.work.base.u.size());
  const bool whole = line.linear_residual < exact || line.krylov_iterations >= size;
  return solution.gmres && whole && solve.work.base.norm < down * solve.work.first.norm &&
         !solve.work.evaluator_state.learnt && !solve.evaluator.caller_can_set_up();
}

/// Whether a step that the bend of F has cut says that ||F|| is stationary: its linear model, as
/// far as it was right, could take away next to nothing. One that could take away little is
/// followed by others, which tell.
Ending judge_cut(Solve& solve, double norm_before, const LinearSolution& solution,
                 const Iteration& line) {
  constexpr double little = 0.01;
  constexpr double kept = 0.8;  // of the promise, by a step that nothing but the radius cut
  constexpr int more = 3;
  const bool cut = line.step_length <= little && solve.course.newton.left_domain == 0;
  if (!cut || !can_tell_stationary(solve, solution, line)) return Ending::go_on;
  const double promised = promise_within(solve, norm_before, line.step_length);
  const double gained = 1.0 - solve.work.base.norm / norm_before;
  if (promised > little || gained > kept * promised) return Ending::go_on;
  if (promised <= nothing_promised) {
    solve.note_trouble(Trouble::minimum);
    return Ending::stationary;
  }
  StageCourse& stage = solve.course.stage;
  stage.limit = std::max(stage.limit, stage.iterations + 1 + more);
  return Ending::go_on;
}

/// The same of a search in vain.
Ending judge_failure(Solve& solve, Ending ending, const LinearSolution& solution,
                     const Iteration& line) {
  const bool at_minimum = ending == Ending::line_search_failed &&
                          solve.report.trouble == Trouble::minimum &&
                          solve.course.rescue.trouble_norm == solve.work.base.norm;
  const bool told =
      at_minimum && !by_full_steps(solve) && can_tell_stationary(solve, solution, line);
  return told ? Ending::stationary : ending;
}

/// Watches full steps, on which ||F|| may rise.
Ending judge_full_step(Solve& solve, bool best) {
  NewtonCourse& course = solve.course.newton;
  if (!course.by_full_steps || solve.course.rescue.last_full_steps) {
    course.since_best = best ? 0 : course.since_best + 1;
    return course.since_best < solve.options.globalisation.watchdog ? Ending::go_on
                                                                    : Ending::stagnated;
  }
  // An early try. Where F is made of pieces that are all but straight, a step soon undoes nearly
  // all that the first ones did to ||F||, which then goes on falling: on contact beams to 0.7 in
  // six steps. Elsewhere neither is so.
  constexpr double undone = 0.1;
  constexpr int first_steps = 3;
  constexpr double progress = 0.9;
  constexpr int patience = 6;
  const double norm = solve.work.base.norm;
  const int steps = solve.course.stage.iterations + 1;
  const bool rises = steps == 1 || (steps <= first_steps && norm > course.highest_full);
  if (rises) course.highest_full = norm;
  const bool falls = rises || norm < progress * course.lowest_full;
  if (falls) course.lowest_full = norm;
  if (steps == first_steps + 1 && course.lowest_full > undone * course.highest_full) {
    return Ending::stagnated;
  }
  course.since_best = falls ? 0 : course.since_best + 1;
  return course.since_best < patience ? Ending::go_on : Ending::stagnated;
}

}  // namespace

void begin_newton_afresh(Solve& solve, int steps) {
  begin_newton(solve, steps);
  solve.work.base = solve.work.first;
  solve.evaluator.accept(solve.work.base.u);
  solve.course.newton.window_norm = solve.work.base.norm;
  solve.course.newton.by_lines = true;
}

void begin_newton(Solve& solve, int steps) {
  Course& course = solve.course;
  solve.return_to_best();
  course.stage.kind = Stage::newton;
  course.stage.iterations = 0;
  course.stage.limit = steps;
  course.stage.start_norm = solve.work.best.norm;
  course.stage.start_evaluations = solve.evaluations();
  course.newton.forcing = {};
  course.newton.radius = 0.0;
  course.newton.last_norms_count = 0;
  course.newton.window_norm = solve.work.best.norm;
  course.newton.window_steps = 0;
  course.newton.poor_steps = 0;
  course.newton.short_steps = 0;
  course.newton.by_full_steps = false;
  course.newton.since_best = 0;
  course.newton.feasible = 0.0;
}

Ending newton_step(Solve& solve) {
  Iteration line;
  line.phase = Phase::newton;
  const double norm = solve.work.base.norm;
  const double eta = next_forcing(solve.options.krylov.forcing, solve.course.newton.forcing, norm,
                                  solve.evaluator.tolerance(solve.work.base));
  const LinearSolution solution = find_direction(solve, eta, 0.0, line);
  if (solution.ending != Ending::go_on) return solution.ending;
  if (const Ending ending = globalise(solve, solution.gmres, line); ending != Ending::go_on) {
    return judge_failure(solve, ending, solution, line);
  }
  ++solve.report.newton_iterations;
  const double lowest = solve.work.best.norm;
  if (const Ending ending = solve.accept_base(line); ending != Ending::go_on) return ending;
  if (!by_full_steps(solve)) {
    const Ending ending = judge_progress(solve, norm, line);
    return ending == Ending::go_on ? judge_cut(solve, norm, solution, line) : ending;
  }
  return judge_full_step(solve, solve.work.best.norm < lowest);
}

}  // namespace jfnk::detail
