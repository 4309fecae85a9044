#include <utility>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

/// The multisecant step from work.base into work.step:
/// du = -dU gamma - mixing P (F - dF gamma), gamma = argmin ||F - dF gamma||.
void find_step(Solve& solve) {
  Workspace& work = solve.work;
  Vector& remainder = work.probe;
  work.secants.project(work.base.r, work.step, remainder, solve.evaluator.product());
  solve.precondition(remainder, work.direction);
  work.step -= solve.options.multisecant.mixing * work.direction;
}

/// Evaluates base + step; out of the domain, halves the way from the best point to the trial.
Ending look(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  work.trial.u = work.base.u + work.step;
  line.step_length = 1.0;
  for (int cut = 0; cut <= solve.options.multisecant.max_cuts; ++cut) {
    const Outcome outcome = solve.evaluator.evaluate(
        work.trial, cut == 0 ? &Counts::multisecant : &Counts::line_search);
    if (outcome == Outcome::ok) return Ending::schedule_done;
    if (outcome == Outcome::stopped) return Ending::stopped;
    if (outcome == Outcome::limit) return Ending::limit;
    work.trial.u = 0.5 * (work.trial.u + work.best.u);
    line.step_length *= 0.5;
  }
  return Ending::patience_lost;
}

/// Stores the pair (trial - base) and makes the trial the base.
void advance(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  work.step = work.trial.u - work.base.u;
  work.probe = work.trial.r - work.base.r;
  line.step_norm = product.norm(work.step);
  work.secants.add(work.step, work.probe, solve.options.multisecant.max_condition, product);
  std::swap(work.base, work.trial);
}

}  // namespace

Ending multisecant_phase(Solve& solve, int max_iterations) {
  Workspace& work = solve.work;
  const Multisecant& rule = solve.options.multisecant;
  work.base = work.best;
  double mark = work.best.norm;
  int last_fall = solve.report.counts.total();
  for (int iteration = 0; iteration < max_iterations; ++iteration) {
    Iteration line;
    line.phase = Phase::multisecant;
    line.secant_pairs = work.secants.size();
    find_step(solve);
    if (const Ending ending = look(solve, line); ending != Ending::schedule_done) return ending;
    advance(solve, line);
    ++solve.report.multisecant_iterations;
    const bool converged = solve.evaluator.converged(work.base, line.step_norm);
    solve.keep_if_best(work.base, converged);
    const bool go_on = solve.record(line, work.base);
    if (converged) return Ending::converged;
    if (!go_on) return Ending::stopped;
    const int evaluations = solve.report.counts.total();
    if (work.best.norm < rule.progress * mark) {
      mark = work.best.norm;
      last_fall = evaluations;
    }
    if (evaluations - last_fall >= rule.patience) return Ending::patience_lost;
    if (work.base.norm > rule.rejection * work.best.norm) work.base = work.best;
  }
  return Ending::schedule_done;
}

}  // namespace jfnk::detail
