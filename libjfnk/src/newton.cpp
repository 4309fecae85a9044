#include <algorithm>
#include <cmath>
#include <utility>

#include "forcing.hpp"
#include "strategy.hpp"

namespace jfnk::detail {
namespace {

GmresOptions linear_options(const Options& options) {
  GmresOptions linear;
  linear.restart = options.krylov.restart;
  linear.max_iterations = options.krylov.max_iterations;
  linear.flexible = options.krylov.flexible;
  return linear;
}

/// Solves J du = -F to the forcing term; du into work.direction.
Ending find_direction(Solve& solve, double eta, Iteration& line) {
  Workspace& work = solve.work;
  Evaluator& evaluator = solve.evaluator;
  Counts& counts = solve.report.counts;
  if (solve.options.preconditioner_setup == PreconditionerSetup::every_newton_step &&
      solve.preconditioner.has_setup() && solve.report.newton_iterations > 0) {
    ++counts.preconditioner_setups;
    solve.preconditioner.setup(work.base.u);
  }
  const Outcome ready = evaluator.linearise(work.base);
  if (ready == Outcome::stopped) return Ending::stopped;
  if (ready != Outcome::ok) return Ending::linearisation_failed;

  Outcome last = Outcome::ok;
  auto action = [&](const Vector& v, Vector& Jv) {
    last = evaluator.action(v, Jv);
    switch (last) {
      case Outcome::ok:
        return Evaluation::ok;
      case Outcome::out_of_domain:
        return Evaluation::out_of_domain;
      default:
        return Evaluation::stop;
    }
  };
  GmresOptions linear = linear_options(solve.options);
  linear.relative_tolerance = eta;
  work.step = -work.base.r;
  work.direction.setZero();
  const GmresResult result = work.gmres.solve(OperatorRef(action), work.step, work.direction,
                                              linear, solve.preconditioner, evaluator.product());
  counts.preconditioner += work.gmres.preconditioner_applications();
  line.forcing = eta;
  line.linear_residual = result.relative_residual;
  line.krylov_iterations = result.iterations;
  solve.report.krylov_iterations += result.iterations;
  if (last == Outcome::stopped) return Ending::stopped;
  if (last == Outcome::limit) return Ending::limit;
  const double length = evaluator.product().norm(work.direction);
  return length > 0.0 && std::isfinite(length) ? Ending::schedule_done : Ending::krylov_stalled;
}

/// Backtracks along work.direction; the accepted point becomes work.base.
Ending search(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const Globalisation& rule = solve.options.globalisation;
  const double direction_norm = solve.evaluator.product().norm(work.direction);
  const double gain = rule.sufficient_decrease * (1.0 - std::min(1.0, line.linear_residual));
  double lambda = 1.0;
  for (int cut = 0; cut <= rule.max_cuts; ++cut) {
    work.trial.u = work.base.u + lambda * work.direction;
    const Outcome outcome = solve.evaluator.evaluate(
        work.trial, cut == 0 ? &Counts::newton_trials : &Counts::line_search);
    if (outcome == Outcome::stopped) return Ending::stopped;
    if (outcome == Outcome::limit) return Ending::limit;
    if (outcome == Outcome::ok && work.trial.norm <= (1.0 - gain * lambda) * work.base.norm) {
      std::swap(work.base, work.trial);
      line.step_length = lambda;
      line.step_norm = lambda * direction_norm;
      return Ending::schedule_done;
    }
    lambda *= outcome == Outcome::ok ? rule.factor : rule.domain_factor;
  }
  return Ending::line_search_failed;
}

}  // namespace

Ending newton_phase(Solve& solve, int max_steps) {
  Workspace& work = solve.work;
  work.base = work.best;
  ForcingSequence forcing(solve.options.krylov.forcing);
  for (int step = 0; step < max_steps; ++step) {
    Iteration line;
    line.phase = Phase::newton;
    const double eta = forcing.next(work.base.norm, solve.evaluator.tolerance(work.base));
    Ending ending = find_direction(solve, eta, line);
    if (ending == Ending::schedule_done) ending = search(solve, line);
    if (ending != Ending::schedule_done) return ending;
    ++solve.report.newton_iterations;
    const bool converged = solve.evaluator.converged(work.base, line.step_norm);
    solve.keep_if_best(work.base, converged);
    const bool go_on = solve.record(line, work.base);
    if (converged) return Ending::converged;
    if (!go_on) return Ending::stopped;
  }
  return Ending::schedule_done;
}

}  // namespace jfnk::detail
