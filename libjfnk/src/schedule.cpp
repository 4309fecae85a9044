#include <algorithm>
#include <cmath>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

int newton_steps(const Options& options, int round) {
  const double steps = options.hybrid.newton_steps * std::pow(options.hybrid.back_off, round);
  return static_cast<int>(std::min(steps, 1e6));
}

bool alone(const Solve& solve) {
  return solve.options.method == Method::newton_krylov;
}

bool in_final_newton(const Solve& solve) {
  return alone(solve) || solve.course.round >= solve.options.hybrid.rounds;
}

int final_newton_steps(const Options& options) {
  return options.method == Method::newton_krylov ? options.max_iterations
                                                 : options.hybrid.final_newton_steps;
}

/// Whether a round without the preconditioner is worth a try: if no step by it was a gain at all.
bool doubts_preconditioner(const Solve& solve) {
  const Course& course = solve.course;
  const Options& options = solve.options;
  const bool gained =
      solve.work.best.norm <= options.multisecant.progress * course.stage_start_norm;
  return options.stagnation.restart && course.round == 0 && !course.doubted && !gained &&
         !solve.evaluator.preconditioner().is_identity();
}

/// A round of multisecant without the preconditioner, from the best point.
void begin_without_preconditioner(Solve& solve) {
  Course& course = solve.course;
  course.doubted = true;
  course.suspended = true;
  solve.work.aside = solve.work.best;
  course.mixing_known = false;
  solve.evaluator.drop_preconditioner();
  solve.work.secants.clear();
  begin_multisecant(solve);
}

/// The preconditioner fits where it was set up: a round without it that failed is undone.
void end_without_preconditioner(Solve& solve) {
  Course& course = solve.course;
  course.suspended = false;
  course.mixing_known = false;
  solve.evaluator.resume_preconditioner();
  solve.work.secants.clear();
  solve.undo_round();
}

/// The next round, or the last Newton steps.
void next_round(Solve& solve) {
  ++solve.course.round;
  if (solve.course.round < solve.options.hybrid.rounds) {
    begin_multisecant(solve);
  } else {
    begin_newton(solve, final_newton_steps(solve.options));
  }
}

/// Rounds are over: Newton alone.
void begin_final_newton(Solve& solve) {
  solve.course.round = solve.options.hybrid.rounds;
  begin_newton(solve, final_newton_steps(solve.options));
}

/// From the first point again, remembering nothing.
void begin_again(Solve& solve) {
  Course& course = solve.course;
  solve.work.secants.clear();
  course.mixing_known = false;
  course.round = 0;
  course.round_cost = 0;
  if (alone(solve)) {
    begin_newton(solve, final_newton_steps(solve.options));
  } else {
    begin_multisecant(solve);
  }
  solve.work.base = solve.work.first;
  course.mark = solve.work.first.norm;
  solve.evaluator.accept(solve.work.base.u);
}

/// What is left when Newton has failed where it stands: another start, then another path.
Ending rescue(Solve& solve, Ending failure) {
  Course& course = solve.course;
  if (course.newton_failure == Ending::go_on) course.newton_failure = failure;
  const bool preconditioned = !solve.evaluator.preconditioner().is_identity();
  if (solve.options.stagnation.restart && preconditioned) {
    solve.evaluator.drop_preconditioner();
    begin_again(solve);
    return Ending::go_on;
  }
  if (solve.options.stagnation.restart && !course.restarted) {
    course.restarted = true;
    course.round = solve.options.hybrid.rounds;
    begin_newton_afresh(solve, final_newton_steps(solve.options));
    return Ending::go_on;
  }
  course.by_lines = false;
  if (solve.options.pseudo_transient.enabled && !course.transient_tried) {
    begin_pseudo_transient(solve);
    return Ending::go_on;
  }
  return course.newton_failure;
}

Ending after_newton(Solve& solve, Ending ending) {
  Course& course = solve.course;
  course.round_cost = solve.evaluations() - course.stage_start_evaluations;
  if (ending == Ending::schedule_done) {
    if (in_final_newton(solve)) return ending;
    next_round(solve);
    return Ending::go_on;
  }
  if (may_measure_noise(solve)) {
    Ending interrupted = Ending::go_on;
    const int left = course.stage_limit - course.stage_iterations;
    if (adapt_to_noise(solve, interrupted)) {
      begin_newton(solve, std::max(left, 1));
      return Ending::go_on;
    }
    if (interrupted != Ending::go_on) return interrupted;
  }
  // Newton would fail again from where it has just failed without moving.
  const bool moved = solve.work.best.norm < course.stage_start_norm;
  if (!in_final_newton(solve) && moved && ending != Ending::stagnated) {
    next_round(solve);
    return Ending::go_on;
  }
  return rescue(solve, ending);
}

Ending after_pseudo_transient(Solve& solve) {
  const bool gained = solve.work.best.norm < solve.course.stage_start_norm;
  if (!gained) return solve.course.newton_failure;
  begin_final_newton(solve);
  return Ending::go_on;
}

/// Rebuilds the preconditioner where the options say so. The gain per evaluation since the last
/// setup, its cost included, first rises and then falls; a renewal pays once it has fallen.
void renew_preconditioner(Solve& solve) {
  constexpr double fallen = 0.8;
  constexpr double patience = 3.0;  // in setups, where nothing was gained at all
  Course& course = solve.course;
  const bool newton = course.stage == Stage::newton;
  if (!solve.evaluator.preconditioner().has_setup()) return;
  bool due = false;
  if (solve.options.preconditioner_setup == PreconditionerSetup::every_newton_step) {
    due = newton && solve.report.newton_iterations > 0;
  } else if (solve.options.preconditioner_setup == PreconditionerSetup::when_it_pays) {
    const double cost = solve.options.setup_cost;
    const double spent = cost + solve.evaluations() - course.setup_evaluations;
    const double gain = std::log(course.setup_norm / solve.work.best.norm);
    if (gain > 0.0) {
      const double rate = gain / spent;
      course.setup_best_rate = std::max(course.setup_best_rate, rate);
      due = rate < fallen * course.setup_best_rate;
    } else {
      due = course.stage_iterations > 0 && spent > patience * (cost + 1.0);
    }
  }
  if (!due) return;
  solve.work.setup_point = solve.work.base.u;
  solve.evaluator.setup(solve.work.base.u);
  course.setup_evaluations = solve.evaluations();
  course.setup_norm = solve.work.best.norm;
  course.setup_best_rate = 0.0;
  course.radius = 0.0;  // it is measured through the preconditioner
  // as are Broyden's updates
  solve.work.broyden.clear();
  course.inverted = false;
}

}  // namespace

void begin_schedule(Solve& solve) {
  Course& course = solve.course;
  if (solve.evaluator.preconditioner().has_setup()) {
    solve.work.setup_point = solve.work.best.u;
    solve.evaluator.setup(solve.work.best.u);
  }
  course.setup_evaluations = solve.evaluations();
  course.setup_norm = solve.work.best.norm;
  if (alone(solve)) {
    begin_newton(solve, final_newton_steps(solve.options));
  } else {
    begin_multisecant(solve);
  }
}

Ending advance(Solve& solve) {
  Course& course = solve.course;
  if (course.stage == Stage::newton && course.stage_iterations >= course.stage_limit) {
    return after_newton(solve, Ending::schedule_done);
  }
  renew_preconditioner(solve);
  Ending ending = Ending::go_on;
  switch (course.stage) {
    case Stage::multisecant:
      ending = multisecant_step(solve);
      break;
    case Stage::newton:
      ending = newton_step(solve);
      break;
    case Stage::pseudo_transient:
      ending = pseudo_transient_step(solve);
      break;
    case Stage::ended:
      return Ending::stopped;
  }
  if (is_final(ending)) return ending;
  if (ending == Ending::go_on) {
    ++course.stage_iterations;
    const bool cured =
        course.stage == Stage::pseudo_transient &&
        solve.work.best.norm <= solve.options.pseudo_transient.gain * course.stage_start_norm;
    if (course.stage_iterations < course.stage_limit && !cured) return Ending::go_on;
    ending = Ending::schedule_done;
  }
  switch (course.stage) {
    case Stage::multisecant:
      if (solve.options.method == Method::multisecant) return ending;
      if (doubts_preconditioner(solve)) {
        begin_without_preconditioner(solve);
        return Ending::go_on;
      }
      if (course.suspended) end_without_preconditioner(solve);
      begin_newton(solve, newton_steps(solve.options, course.round));
      return Ending::go_on;
    case Stage::newton:
      return after_newton(solve, ending);
    default:
      return after_pseudo_transient(solve);
  }
}

}  // namespace jfnk::detail
