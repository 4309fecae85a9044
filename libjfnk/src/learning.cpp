#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "noise_level.hpp"
#include "strategy.hpp"

// The Jacobian of a residual on a lattice, learnt by looking where single unknowns make themselves
// felt, then differenced in groups of columns (Curtis, Powell & Reid 1974).
namespace jfnk::detail {
namespace {

/// How a step of learning ended.
enum class Finding { ok, nothing, stopped, limit };

Finding finding_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::ok:
      return Finding::ok;
    case Outcome::out_of_domain:
      return Finding::nothing;
    case Outcome::stopped:
      return Finding::stopped;
    default:
      return Finding::limit;
  }
}

Ending ending_of(Finding finding) {
  if (finding == Finding::stopped) return Ending::stopped;
  return finding == Finding::limit ? Ending::limit : Ending::go_on;
}

/// J times work.step into work.direction about the point of the last `linearise`.
Finding multiply(Solve& solve) {
  const int before = solve.evaluations();
  const Outcome outcome = solve.evaluator.action(solve.work.step, solve.work.direction);
  solve.report.counts.learning += solve.evaluations() - before;
  return finding_of(outcome);
}

/// Learns from column j; nothing if it is too full for a lattice's.
Finding look_at_column(Solve& solve, Eigen::Index j, bool& anything_new) {
  Workspace& work = solve.work;
  work.step.setZero();
  work.step[j] = 1.0;
  const Finding finding = multiply(solve);
  if (finding != Finding::ok) return finding;
  const auto occupied = (work.direction.array() != 0.0).count();
  if (occupied > solve.options.learning.most_rows) return Finding::nothing;
  anything_new = work.evaluator.learnt.learn_column(j, work.direction);
  return Finding::ok;
}

/// Linearises near work.base, but at no special point: where unknowns are zero or equal, entries
/// may vanish that are there elsewhere.
Finding linearise_off_base(Solve& solve) {
  constexpr double part = 1e-3;
  constexpr double golden_ratio = 0.61803398874989485;  // its multiples modulo 1 are all unlike
  Workspace& work = solve.work;
  const Eigen::Index n = work.base.u.size();
  const double size = part * (1.0 + work.base.u.norm() / std::sqrt(static_cast<double>(n)));
  for (Eigen::Index i = 0; i < n; ++i) {
    const double place = golden_ratio * static_cast<double>(i + 1);
    work.trial.u[i] = work.base.u[i] + size * (place - std::floor(place));
  }
  const Iterate* point = &work.base;
  if (solve.evaluator.within_bounds(work.trial.u)) {
    const int before = solve.evaluations();
    const Outcome outcome = solve.evaluator.evaluate(work.trial, &Counts::difference_actions);
    solve.report.counts.learning += solve.evaluations() - before;
    if (outcome == Outcome::stopped || outcome == Outcome::limit) return finding_of(outcome);
    if (outcome == Outcome::ok) point = &work.trial;
  }
  return finding_of(solve.evaluator.linearise(*point));
}

/// Which diagonals are occupied, from a few columns here and there.
Finding find_diagonals(Solve& solve) {
  // As many as it takes until one tells nothing new; at indices of unlike remainders, so that
  // every field of a node gets its turn.
  constexpr std::array<double, 6> places{0.5, 0.25, 0.75, 0.4, 0.6, 0.1};
  constexpr int least = 3;
  const Eigen::Index n = solve.work.base.u.size();
  if (const Finding finding = linearise_off_base(solve); finding != Finding::ok) return finding;
  int seen = 0;
  for (const double place : places) {
    const auto j = static_cast<Eigen::Index>(place * static_cast<double>(n)) + seen;
    bool anything_new = false;
    const Finding finding = look_at_column(solve, std::min(j, n - 1), anything_new);
    if (finding != Finding::ok) return finding;
    if (++seen >= least && !anything_new) return Finding::ok;
  }
  return Finding::nothing;  // numbered in no order
}

/// The entries at a point, and their factors.
Finding find_entries(Solve& solve, const Iterate& point, double shift) {
  Workspace& work = solve.work;
  LearntJacobian& jacobian = work.evaluator.learnt;
  const Outcome ready = solve.evaluator.linearise(point);
  if (ready != Outcome::ok) return finding_of(ready);
  for (int group = 0; group < jacobian.groups(); ++group) {
    jacobian.write_group(group, work.step);
    if (const Finding finding = multiply(solve); finding != Finding::ok) return finding;
    jacobian.read_group(group, work.direction);
  }
  return jacobian.factorise(shift) ? Finding::ok : Finding::nothing;
}

/// Whether the entries explain a product with a vector that touches all of them; if not, looks at
/// the column, if J is symmetric in structure, of the row that is explained worst.
Finding test_entries(Solve& solve, bool& anything_new) {
  constexpr double good = 1e-3;
  constexpr double bearable = 0.3;  // a few rows may have entries of their own
  Workspace& work = solve.work;
  anything_new = false;
  random_direction(0, solve.evaluator.product(), work.step);
  if (const Finding finding = multiply(solve); finding != Finding::ok) return finding;
  const Vector missed = work.evaluator.learnt.multiply(work.step) - work.direction;
  const double error = missed.norm() / work.direction.norm();
  if (error <= good) return Finding::ok;
  Eigen::Index worst = 0;
  missed.cwiseAbs().maxCoeff(&worst);
  const Finding finding = look_at_column(solve, worst, anything_new);
  if (finding == Finding::stopped || finding == Finding::limit) return finding;
  return anything_new || error <= bearable ? Finding::ok : Finding::nothing;
}

/// Evaluations still to come if the rate of so far goes on.
double evaluations_left(const Solve& solve) {
  const Iterate& best = solve.work.best;
  const double gained = std::log(solve.work.first.norm / best.norm);
  const double left = std::log(best.norm / solve.evaluator.tolerance(best));
  return gained > 0.0 ? solve.evaluations() * left / gained
                      : std::numeric_limits<double>::infinity();
}

/// Whether factors fit into memory and cost less than the evaluations they may spare.
bool factors_pay(const Solve& solve) {
  const Learning& rule = solve.options.learning;
  const LearntJacobian& jacobian = solve.work.evaluator.learnt;
  const auto n = static_cast<double>(solve.work.base.u.size());
  const FactorCost cost = jacobian.cost(rule.most_entries);
  return cost.entries <= rule.most_entries &&
         cost.operations <= rule.operations * n * evaluations_left(solve);
}

Finding learn_jacobian(Solve& solve) {
  constexpr int attempts = 3;
  constexpr double worthwhile = 0.5;    // products, of the evaluations they may spare
  constexpr double groups_per_row = 2;  // entries of a row are in groups of their own, at least
  constexpr int columns_per_group = 3;  // at least; with fewer, n products would do as well
  LearntJacobian& jacobian = solve.work.evaluator.learnt;
  const Eigen::Index n = solve.work.base.u.size();
  double budget = std::min(worthwhile * evaluations_left(solve),
                           groups_per_row * solve.options.learning.most_rows);
  jacobian.reset(n);
  if (const Finding finding = find_diagonals(solve); finding != Finding::ok) return finding;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    jacobian.group_columns();
    budget -= jacobian.groups();
    if (budget < 0.0 || columns_per_group * jacobian.groups() > n) return Finding::nothing;
    if (!factors_pay(solve)) return Finding::nothing;
    if (const Finding finding = find_entries(solve, solve.work.best, 0.0); finding != Finding::ok) {
      return finding;
    }
    bool anything_new = false;
    const Finding finding = test_entries(solve, anything_new);
    if (finding != Finding::ok || !anything_new) return finding;
  }
  return Finding::nothing;
}

}  // namespace

bool wants_to_learn(const Solve& solve) {
  const Course& course = solve.course;
  const Learning& rule = solve.options.learning;
  const ResidualRef& residual = solve.evaluator.residual();
  const bool possible = rule.enabled && solve.options.method == Method::hybrid &&
                        !residual.is_distributed() &&
                        solve.work.base.u.size() >= rule.least_unknowns;
  if (!possible || course.preconditioner.learning_tried) return false;
  if (course.stage.kind == Stage::pseudo_transient || solve.report.measured_noise > 0.0)
    return false;
  const int spent = solve.evaluations();
  const bool plain = solve.evaluator.preconditioner().is_identity();
  const int earliest = plain ? rule.after : rule.after_preconditioned;
  if (spent < earliest && (plain || course.stage.round == 0)) return false;
  return evaluations_left(solve) > rule.worth;
}

Ending learn(Solve& solve) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  course.preconditioner.learning_tried = true;
  const Finding finding = learn_jacobian(solve);
  if (finding != Finding::ok) return ending_of(finding);
  use_learnt_jacobian(work, solve.options);
  course.preconditioner.setup_evaluations = solve.evaluations();
  course.preconditioner.setup_norm = work.best.norm;
  course.preconditioner.setup_best_rate = 0.0;
  course.preconditioner.stale = 0;
  course.preconditioner.suspended = false;
  begin_rounds(solve);
  return Ending::go_on;
}

Ending renew_learnt_jacobian(Solve& solve, double shift, bool& usable) {
  const Finding finding = find_entries(solve, solve.work.base, shift);
  usable = finding == Finding::ok;
  solve.course.preconditioner.stale = 0;
  return ending_of(finding);
}

void use_learnt_jacobian(Workspace& work, const Options& options) {
  const Eigen::Index n = work.base.u.size();
  work.evaluator_state.learnt = true;
  work.evaluator_state.without_preconditioner = false;
  if (!options.multisecant.broyden) return;
  work.broyden.resize(n, options.multisecant.memory);
  for (Vector* v : {&work.by_least_squares, &work.by_broyden, &work.image}) v->resize(n);
}

}  // namespace jfnk::detail
