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
  return alone(solve) || solve.course.stage.round >= solve.options.hybrid.rounds;
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
      solve.work.best.norm <= options.multisecant.progress * course.stage.start_norm;
  return options.stagnation.restart && course.stage.round == 0 && !course.preconditioner.doubted &&
         !gained && !solve.evaluator.preconditioner().is_identity() &&
         !solve.evaluator.preconditioned_by_learning();
}

/// A round of multisecant without the preconditioner, from the best point.
void begin_without_preconditioner(Solve& solve) {
  Course& course = solve.course;
  course.preconditioner.doubted = true;
  course.preconditioner.suspended = true;
  solve.work.aside = solve.work.best;
  course.multisecant.mixing_known = false;
  solve.evaluator.drop_preconditioner();
  solve.work.secants.clear();
  begin_multisecant(solve);
}

/// The preconditioner fits where it was set up: a round without it that failed is undone, unless it
/// came far.
void end_without_preconditioner(Solve& solve) {
  constexpr double far = 0.1;
  Course& course = solve.course;
  course.preconditioner.suspended = false;
  course.multisecant.mixing_known = false;
  solve.evaluator.resume_preconditioner();
  solve.work.secants.clear();
  if (solve.work.best.norm <= far * solve.work.aside.norm) {
    solve.return_to_best();
  } else {
    solve.undo_round();
  }
}

/// The caller's preconditioner about work.base.
void set_up(Solve& solve) {
  solve.work.setup_point = solve.work.base.u;
  solve.evaluator.setup(solve.work.base.u);
}

/// The next round, or the last Newton steps.
void next_round(Solve& solve) {
  ++solve.course.stage.round;
  if (solve.course.stage.round < solve.options.hybrid.rounds) {
    begin_multisecant(solve);
  } else {
    begin_newton(solve, final_newton_steps(solve.options));
  }
}

/// Rounds are over: Newton alone.
void begin_final_newton(Solve& solve) {
  solve.course.stage.round = solve.options.hybrid.rounds;
  begin_newton(solve, final_newton_steps(solve.options));
}

/// From the first point again, remembering nothing.
void begin_again(Solve& solve) {
  if (alone(solve)) {
    begin_newton(solve, final_newton_steps(solve.options));
  } else {
    begin_rounds(solve);
  }
  solve.work.base = solve.work.first;
  solve.course.multisecant.mark = solve.work.first.norm;
  solve.evaluator.accept(solve.work.base.u);
}

/// The same without preconditioner.
void begin_again_plainly(Solve& solve) {
  solve.evaluator.drop_preconditioner();
  begin_again(solve);
}

bool try_transient(Solve& solve) {
  Course& course = solve.course;
  course.newton.by_lines = false;
  if (!solve.options.pseudo_transient.enabled || course.rescue.transient_tried) return false;
  begin_pseudo_transient(solve);
  return true;
}

bool try_first_point_by_lines(Solve& solve) {
  Course& course = solve.course;
  if (!solve.options.stagnation.restart || course.rescue.restarted) return false;
  course.rescue.restarted = true;
  course.stage.round = solve.options.hybrid.rounds;
  begin_newton_afresh(solve, final_newton_steps(solve.options));
  return true;
}

/// The plain method and its rescues, as if nothing had been learnt.
void begin_unlearnt(Solve& solve) {
  solve.course.rescue.restarted = false;
  solve.course.rescue.transient_tried = false;
  begin_again_plainly(solve);
}

/// With factors of the Jacobian itself another path is the better hope, and cheap.
void rescue_with_learnt_factors(Solve& solve) {
  if (try_transient(solve)) return;
  if (try_full_steps_amid_rescues(solve)) return;
  if (!try_first_point_by_lines(solve)) begin_unlearnt(solve);
}

/// Whether two searches have come down to the same minimum of ||F||: another would, too. With
/// learnt factors there are better hopes, and what looks like a minimum may be a kink.
bool is_minimum_again(Solve& solve) {
  constexpr double alike = 1e-6;
  constexpr double down = 0.9;
  RescueCourse& course = solve.course.rescue;
  const double norm = solve.work.base.norm;
  const bool at_minimum = solve.report.trouble == Trouble::minimum && course.trouble_norm == norm &&
                          norm < down * solve.work.first.norm && !solve.work.evaluator_state.learnt;
  if (!at_minimum) return false;
  const bool again = std::abs(norm - course.minimum_norm) <= alike * norm;
  course.minimum_norm = norm;
  return again;
}

/// What is left when Newton has failed where it stands: another start, then another path.
Ending rescue(Solve& solve, Ending failure) {
  Course& course = solve.course;
  if (course.rescue.newton_failure == Ending::go_on) course.rescue.newton_failure = failure;
  if (failure == Ending::stationary || is_minimum_again(solve)) return failure;
  if (solve.evaluator.preconditioned_by_learning()) {
    rescue_with_learnt_factors(solve);
    return Ending::go_on;
  }
  if (solve.options.stagnation.restart && !solve.evaluator.preconditioner().is_identity()) {
    begin_again_plainly(solve);
    return Ending::go_on;
  }
  if (try_first_point_by_lines(solve) || try_transient(solve)) return Ending::go_on;
  if (try_full_steps_at_last(solve)) return Ending::go_on;
  return course.rescue.newton_failure;
}

/// Full steps have failed: the end if they were the last rescue, else the next round.
Ending after_full_steps(Solve& solve) {
  Course& course = solve.course;
  const Ending failure = course.rescue.newton_failure;
  if (course.rescue.last_full_steps) return failure;
  course.newton.by_full_steps = false;
  solve.return_to_best();
  // The factors are of a point far off.
  if (solve.evaluator.preconditioned_by_learning()) {
    course.preconditioner.stale = solve.work.evaluator.learnt.groups();
  } else {
    set_up(solve);
  }
  if (failure != Ending::go_on) return rescue(solve, failure);
  if (alone(solve)) {
    begin_newton(solve, final_newton_steps(solve.options));
  } else {
    next_round(solve);
  }
  return Ending::go_on;
}

Ending after_newton(Solve& solve, Ending ending) {
  Course& course = solve.course;
  if (course.newton.by_full_steps) return after_full_steps(solve);
  course.rescue.round_cost = solve.evaluations() - course.stage.start_evaluations;
  if (ending == Ending::schedule_done) {
    if (in_final_newton(solve)) return ending;
    next_round(solve);
    return Ending::go_on;
  }
  const bool flat = solve.report.trouble == Trouble::flat;
  if (may_measure_noise(solve) && (!flat || changes_farther_off(solve))) {
    Ending interrupted = Ending::go_on;
    const int left = course.stage.limit - course.stage.iterations;
    if (adapt_to_noise(solve, interrupted)) {
      begin_newton(solve, std::max(left, 1));
      return Ending::go_on;
    }
    if (interrupted != Ending::go_on) return interrupted;
  }
  // Newton would fail again from where it has just failed without moving.
  const bool moved = solve.work.best.norm < course.stage.start_norm;
  const bool hopeful = ending != Ending::stagnated && ending != Ending::stationary;
  if (!in_final_newton(solve) && moved && hopeful) {
    next_round(solve);
    return Ending::go_on;
  }
  return rescue(solve, ending);
}

Ending after_pseudo_transient(Solve& solve) {
  const bool gained = solve.work.best.norm < solve.course.stage.start_norm;
  const bool learnt = solve.evaluator.preconditioned_by_learning();
  if (!gained && learnt) return rescue(solve, solve.course.rescue.newton_failure);
  if (!gained && try_full_steps_at_last(solve)) return Ending::go_on;
  if (!gained) return solve.course.rescue.newton_failure;
  if (learnt)
    solve.course.preconditioner.stale =
        solve.work.evaluator.learnt.groups();  // its factors are shifted
  begin_final_newton(solve);
  return Ending::go_on;
}

/// Whether a preconditioner is due that costs so many evaluations. The gain per evaluation since
/// the last setup, its cost included, first rises and then falls; a renewal pays once it has
/// fallen.
bool setup_pays(Solve& solve, double cost) {
  constexpr double fallen = 0.8;
  constexpr double patience = 3.0;  // in setups, where nothing was gained at all
  Course& course = solve.course;
  const double spent = cost + solve.evaluations() - course.preconditioner.setup_evaluations;
  const double gain = std::log(course.preconditioner.setup_norm / solve.work.best.norm);
  if (gain <= 0.0) return course.stage.iterations > 0 && spent > patience * (cost + 1.0);
  const double rate = gain / spent;
  course.preconditioner.setup_best_rate = std::max(course.preconditioner.setup_best_rate, rate);
  return rate < fallen * course.preconditioner.setup_best_rate;
}

bool setup_is_due(Solve& solve) {
  const bool newton = solve.course.stage.kind == Stage::newton;
  if (newton && solve.course.newton.by_full_steps) return true;
  if (solve.evaluator.preconditioned_by_learning()) {
    const int cost = solve.work.evaluator.learnt.groups();
    constexpr double head_start = 2.0;  // its cost is known, and small
    return newton ? head_start * solve.course.preconditioner.stale >= cost
                  : setup_pays(solve, cost);
  }
  if (!solve.evaluator.preconditioner().has_setup()) return false;
  switch (solve.options.preconditioner_setup) {
    case PreconditionerSetup::every_newton_step:
      return newton && solve.report.newton_iterations > 0;
    case PreconditionerSetup::when_it_pays:
      return setup_pays(solve, solve.options.setup_cost) ||
             (newton && solve.course.preconditioner.stale > 0 &&
              solve.course.preconditioner.stale >= solve.options.setup_cost);
    default:
      return false;
  }
}

/// Rebuilds the preconditioner where that is due.
Ending renew_preconditioner(Solve& solve) {
  Course& course = solve.course;
  if (!setup_is_due(solve)) return Ending::go_on;
  if (solve.evaluator.preconditioned_by_learning()) {
    bool usable = false;
    const Ending ending = renew_learnt_jacobian(solve, 0.0, usable);
    if (ending != Ending::go_on) return ending;
    if (!usable) {
      begin_unlearnt(solve);
      return Ending::go_on;
    }
  } else {
    set_up(solve);
  }
  course.preconditioner.setup_evaluations = solve.evaluations();
  course.preconditioner.setup_norm = solve.work.best.norm;
  course.preconditioner.setup_best_rate = 0.0;
  course.newton.radius = 0.0;  // it is measured through the preconditioner
  // as are Broyden's updates
  solve.work.broyden.clear();
  if (in_preconditioned_norm(solve)) solve.work.secants.clear();
  solve.work.secants.forget_images();
  course.multisecant.inverted = false;
  course.multisecant.preconditioned = false;
  return Ending::go_on;
}

}  // namespace

void begin_rounds(Solve& solve) {
  Course& course = solve.course;
  solve.work.secants.clear();
  course.multisecant.mixing_known = false;
  course.newton.by_lines = false;
  course.stage.round = 0;
  course.rescue.round_cost = 0;
  begin_multisecant(solve);
}

void begin_schedule(Solve& solve) {
  Course& course = solve.course;
  if (solve.evaluator.preconditioner().has_setup()) {
    solve.work.setup_point = solve.work.best.u;
    solve.evaluator.setup(solve.work.best.u);
  }
  course.preconditioner.setup_evaluations = solve.evaluations();
  course.preconditioner.setup_norm = solve.work.best.norm;
  if (alone(solve)) {
    begin_newton(solve, final_newton_steps(solve.options));
  } else {
    begin_multisecant(solve);
  }
}

Ending advance(Solve& solve) {
  Course& course = solve.course;
  if (course.stage.kind == Stage::newton && course.stage.iterations >= course.stage.limit) {
    return after_newton(solve, Ending::schedule_done);
  }
  if (wants_to_learn(solve)) {
    if (const Ending ending = learn(solve); ending != Ending::go_on) return ending;
  }
  try_full_steps_early(solve);
  Ending ending = renew_preconditioner(solve);
  if (ending != Ending::go_on) return ending;
  switch (course.stage.kind) {
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
    ++course.stage.iterations;
    const bool cured =
        course.stage.kind == Stage::pseudo_transient &&
        solve.work.best.norm <= solve.options.pseudo_transient.gain * course.stage.start_norm;
    if (course.stage.iterations < course.stage.limit && !cured) return Ending::go_on;
    ending = Ending::schedule_done;
  }
  switch (course.stage.kind) {
    case Stage::multisecant:
      if (solve.options.method == Method::multisecant) return ending;
      if (doubts_preconditioner(solve)) {
        begin_without_preconditioner(solve);
        return Ending::go_on;
      }
      if (course.preconditioner.suspended) end_without_preconditioner(solve);
      begin_newton(solve, newton_steps(solve.options, course.stage.round));
      return Ending::go_on;
    case Stage::newton:
      return after_newton(solve, ending);
    default:
      return after_pseudo_transient(solve);
  }
}

}  // namespace jfnk::detail
