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

/// Learns from the columns of J that work.step is the sum of, by one product; they lie `distance`
/// or more apart, so that entries nearer to one of them are of that one. Nothing if one is too full
/// for a lattice's.
Finding look_at_columns(Solve& solve, Eigen::Index distance, bool& anything_new) {
  Workspace& work = solve.work;
  LatticePattern& pattern = work.evaluator.learnt.pattern();
  const Finding finding = multiply(solve);
  if (finding != Finding::ok) return finding;
  std::vector<LatticePattern::Column> columns;
  Eigen::Index width = 0;
  for (Eigen::Index j = 0; j < work.step.size(); ++j) {
    if (work.step[j] == 0.0) continue;
    columns.push_back(pattern.read(j, work.direction, (distance - 1) / 2));
    const LatticePattern::Column& column = columns.back();
    if (static_cast<int>(column.offsets.size()) > solve.options.learning.most_rows) {
      return Finding::nothing;
    }
    width = std::max(width, pattern.width(column));
  }
  anything_new = false;
  // What lies far beyond the widest so far may be of another column: to be seen once more, apart.
  if (columns.size() > 1 && width > pattern.width() + pattern.width() / 4 + 1) {
    pattern.widen(width);
    anything_new = true;
    return Finding::ok;
  }
  for (const LatticePattern::Column& column : columns) {
    anything_new = pattern.learn(column) || anything_new;
  }
  return Finding::ok;
}

/// Looks at column j alone.
Finding look_at_column(Solve& solve, Eigen::Index j, bool& anything_new) {
  Vector& step = solve.work.step;
  step.setZero();
  step[j] = 1.0;
  return look_at_columns(solve, 2 * step.size(), anything_new);
}

/// Looks at columns as near to each other as can be told apart, one of them near a given part of
/// the way between two.
Finding look_everywhere(Solve& solve, double part, int remainder, bool& anything_new) {
  // Half of the way between two is for entries further out than any seen so far.
  constexpr Eigen::Index least_columns = 3;
  Vector& step = solve.work.step;
  const Eigen::Index n = step.size();
  const Eigen::Index distance = 3 * solve.work.evaluator.learnt.pattern().width() + 2;
  const auto place = [&](Eigen::Index way) {
    return static_cast<Eigen::Index>(part * static_cast<double>(way)) + remainder;
  };
  if (least_columns * distance > n) {
    return look_at_column(solve, std::min(place(n), n - 1), anything_new);
  }
  step.setZero();
  const Eigen::Index first = place(distance) % distance;
  for (Eigen::Index j = first; j + distance <= n + first; j += distance) step[j] = 1.0;
  return look_at_columns(solve, distance, anything_new);
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

/// Which diagonals are occupied, from a few columns here and there of what was linearised.
Finding find_diagonals(Solve& solve) {
  // As many products as it takes until one tells nothing new; at indices of unlike remainders, so
  // that every field of a node gets its turn.
  constexpr std::array<double, 6> places{0.5, 0.25, 0.75, 0.4, 0.6, 0.1};
  constexpr int alone = 2;  // columns that tell how far apart others must be
  constexpr int least = 3;
  const Eigen::Index n = solve.work.base.u.size();
  int seen = 0;
  for (const double place : places) {
    bool anything_new = false;
    const auto j = static_cast<Eigen::Index>(place * static_cast<double>(n)) + seen;
    const Finding finding = seen < alone ? look_at_column(solve, std::min(j, n - 1), anything_new)
                                         : look_everywhere(solve, place, seen, anything_new);
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

/// How much of a product with a vector that touches all entries they leave unexplained. If that is
/// too much, looks at the column, if J is symmetric in structure, of the row explained worst.
Finding test_entries(Solve& solve, double& error, bool& anything_new) {
  // A few rows may have entries of their own: what they spoil is soon mended by secants.
  constexpr double good = 0.1;
  Workspace& work = solve.work;
  anything_new = false;
  random_direction(0, solve.evaluator.product(), work.step);
  if (const Finding finding = multiply(solve); finding != Finding::ok) return finding;
  const Vector missed = work.evaluator.learnt.multiply(work.step) - work.direction;
  error = missed.norm() / work.direction.norm();
  if (error <= good) return Finding::ok;
  Eigen::Index worst = 0;
  missed.cwiseAbs().maxCoeff(&worst);
  const Finding finding = look_at_column(solve, worst, anything_new);
  return finding == Finding::nothing ? Finding::ok : finding;
}

/// Evaluations still to come if the rate of the last half of them goes on; with a preconditioner of
/// the caller's, whose best time is the end, that of all.
double evaluations_left(const Solve& solve) {
  constexpr int least = 8;
  const Iterate& best = solve.work.best;
  const std::vector<Iteration>& history = solve.report.history;
  const int spent = history.back().evaluations;
  const bool plain = solve.evaluator.preconditioner().is_identity();
  const int begin = plain ? spent - std::max(least, spent / 2) : 0;
  double norm = solve.work.first.norm;
  int before = 0;
  for (auto line = history.rbegin(); line != history.rend() && begin > 0; ++line) {
    if (line->evaluations > begin) continue;
    norm = line->best_residual_norm;
    before = line->evaluations;
    break;
  }
  const double gained = std::log(norm / best.norm);
  const double left = std::log(best.norm / solve.evaluator.tolerance(best));
  return gained > 0.0 ? (spent - before) * left / gained : std::numeric_limits<double>::infinity();
}

/// Whether factors fit into memory and cost less than the evaluations they may spare.
bool factors_pay(const Solve& solve) {
  const Learning& rule = solve.options.learning;
  const LearntJacobian& jacobian = solve.work.evaluator.learnt;
  const auto n = static_cast<double>(solve.work.base.u.size());
  const double most_operations = rule.operations * n * evaluations_left(solve);
  const auto pays = [&](const FactorCost& cost) {
    return cost.entries <= rule.most_entries && cost.operations <= most_operations;
  };
  return pays(jacobian.cost_of_band()) || pays(jacobian.cost(rule.most_entries));
}

/// Tries to learn the Jacobian.
/// @param[out] later  it may pay later on, as the diagonals are known by then
Finding learn_jacobian(Solve& solve, bool& later) {
  constexpr int attempts = 3;
  constexpr double worthwhile = 0.5;    // products, of the evaluations they may spare
  constexpr double groups_per_row = 2;  // entries of a row are in groups of their own, at least
  constexpr int columns_per_group = 3;  // at least; with fewer, n products would do as well
  constexpr double bearable = 0.3;      // of the Jacobian, unexplained
  LearntJacobian& jacobian = solve.work.evaluator.learnt;
  PreconditionerCourse& course = solve.course.preconditioner;
  const Eigen::Index n = solve.work.base.u.size();
  double budget = std::min(worthwhile * evaluations_left(solve),
                           groups_per_row * solve.options.learning.most_rows);
  later = false;
  if (!course.pattern_known) {
    jacobian.reset(n);
    if (const Finding finding = linearise_off_base(solve); finding != Finding::ok) return finding;
    const int before = solve.evaluations();
    if (const Finding finding = find_diagonals(solve); finding != Finding::ok) return finding;
    course.pattern_known = true;
    budget -= solve.evaluations() - before;
  }
  for (int attempt = 0; attempt < attempts; ++attempt) {
    jacobian.group_columns();
    course.groups = jacobian.groups();
    later = attempt == 0 && (course.groups > budget || !factors_pay(solve));
    if (later || columns_per_group * course.groups > n) return Finding::nothing;
    budget -= course.groups;
    if (const Finding finding = find_entries(solve, solve.work.best, 0.0); finding != Finding::ok) {
      return finding;
    }
    double error = 0.0;
    bool anything_new = false;
    const Finding finding = test_entries(solve, error, anything_new);
    if (finding != Finding::ok) return finding;
    const int groups = anything_new ? jacobian.groups_to_come() : 0;
    const bool better = groups > 0 && groups <= budget && columns_per_group * groups <= n;
    if (!better) return error <= bearable ? Finding::ok : Finding::nothing;
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
  // Again, if the products were found too many for what was left: when secants have failed.
  const bool again = course.preconditioner.pattern_known;
  if (again && (course.stage.round == 0 || spent < course.preconditioner.next_try)) return false;
  return evaluations_left(solve) > rule.worth;
}

Ending learn(Solve& solve) {
  Workspace& work = solve.work;
  Course& course = solve.course;
  bool later = false;
  const Finding finding = learn_jacobian(solve, later);
  course.preconditioner.learning_tried = !later;
  // Kinked residuals want the products again and again, and often end by secants alone: not before
  // as much was spent as that may cost.
  constexpr int renewals = 4;
  course.preconditioner.next_try =
      std::max(2 * course.preconditioner.next_try, renewals * course.preconditioner.groups);
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
  for (Vector* v : {&work.preconditioned, &work.preconditioned_before}) v->resize(n);
  if (!options.multisecant.broyden) return;
  work.broyden.resize(n, options.multisecant.memory);
  for (Vector* v : {&work.by_least_squares, &work.by_broyden, &work.image}) v->resize(n);
}

}  // namespace jfnk::detail
