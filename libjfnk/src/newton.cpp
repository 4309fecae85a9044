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
    return ending;
  }
  ++solve.report.newton_iterations;
  const double lowest = solve.work.best.norm;
  if (const Ending ending = solve.accept_base(line); ending != Ending::go_on) return ending;
  if (!by_full_steps(solve)) return judge_progress(solve, norm, line);
  return judge_full_step(solve, solve.work.best.norm < lowest);
}

}  // namespace jfnk::detail
