#include "jfnk/solver.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "outcome_text.hpp"
#include "strategy.hpp"

namespace jfnk {
namespace detail {

bool Solve::record(Iteration line, const Iterate& at) const {
  line.index = static_cast<int>(report.history.size());
  line.residual_norm = at.norm;
  line.reference_norm = at.reference;
  line.best_residual_norm = work.best.norm;
  line.evaluations = report.counts.total();
  report.history.push_back(line);
  return observer(report.history.back());
}

void Solve::keep_if_best(const Iterate& point, bool solution) const {
  if (solution || point.norm < work.best.norm) work.best = point;
}

void Solve::precondition(const Vector& r, Vector& z) const {
  if (!preconditioner.is_identity()) ++report.counts.preconditioner;
  preconditioner.apply(r, z);
}

namespace {

void resize(Workspace& work, Eigen::Index n, const Options& options, bool preconditioned) {
  for (Iterate* point : {&work.base, &work.trial, &work.best}) point->resize(n);
  for (Vector* v : {&work.step, &work.direction, &work.probe}) v->resize(n);
  if (options.method != Method::multisecant) {
    GmresOptions linear;
    linear.restart = options.krylov.restart;
    linear.max_iterations = options.krylov.max_iterations;
    linear.flexible = options.krylov.flexible;
    work.gmres.resize(n, linear, preconditioned);
  }
  if (options.method != Method::newton_krylov) {
    work.secants.resize(n, options.multisecant.memory);
  }
}

void begin(Report& report, const Options& options) {
  // One line per nonlinear iteration, and each iteration costs an evaluation or more.
  constexpr int most_lines = 20000;
  std::vector<Iteration> history = std::move(report.history);
  history.clear();
  history.reserve(static_cast<std::size_t>(std::min(options.max_evaluations, most_lines)) + 1);
  report = Report{};
  report.history = std::move(history);
  report.residual_norm = std::numeric_limits<double>::quiet_NaN();
  report.initial_residual_norm = report.residual_norm;
}

Ending run_hybrid(Solve& solve) {
  const Hybrid& plan = solve.options.hybrid;
  for (int round = 0; round < plan.rounds; ++round) {
    Ending ending = multisecant_phase(solve, std::numeric_limits<int>::max());
    if (is_final(ending)) return ending;
    const double before = solve.work.best.norm;
    ending = newton_phase(solve, plan.newton_steps);
    if (is_final(ending)) return ending;
    // Newton would fail again from where it has just failed without moving.
    if (ending != Ending::schedule_done && solve.work.best.norm >= before) return ending;
  }
  return newton_phase(solve, plan.final_newton_steps);
}

Ending run(Solve& solve) {
  switch (solve.options.method) {
    case Method::multisecant:
      return multisecant_phase(solve, solve.options.max_iterations);
    case Method::hybrid:
      return run_hybrid(solve);
    case Method::newton_krylov:
      break;
  }
  return newton_phase(solve, solve.options.max_iterations);
}

/// Evaluates the first u; returns the ending if the solve ends there, else schedule_done.
Ending start(Solve& solve, Status& failure) {
  Iterate& first = solve.work.best;
  Report& report = solve.report;
  const Outcome outcome =
      first.u.allFinite() ? solve.evaluator.evaluate_start(first) : Outcome::out_of_domain;
  if (outcome == Outcome::stopped) return Ending::stopped;
  if (outcome != Outcome::ok) {
    failure = Status::out_of_domain_at_start;
    report.worst_component = first_not_finite(first.u.allFinite() ? first.r : first.u);
    return Ending::patience_lost;
  }
  report.initial_residual_norm = first.norm;
  Iteration line;
  const bool go_on = solve.record(line, first);
  if (solve.evaluator.converged(first, -1.0)) return Ending::converged;
  return go_on ? Ending::schedule_done : Ending::stopped;
}

void finish(Solve& solve, Status status, Vector& u) {
  Report& report = solve.report;
  const Iterate& best = solve.work.best;
  report.status = status;
  if (!report.history.empty()) {
    u = best.u;
    report.residual_norm = best.norm;
    report.reference_norm = best.reference;
    report.tolerance = solve.evaluator.tolerance(best);
    best.r.cwiseAbs().maxCoeff(&report.worst_component);
  }
  report.reason = reason(report, solve.options);
}

Status status_of(Ending ending) {
  switch (ending) {
    case Ending::converged:
      return Status::converged;
    case Ending::schedule_done:
      return Status::max_iterations;
    case Ending::patience_lost:
      return Status::multisecant_stalled;
    case Ending::line_search_failed:
      return Status::line_search_failed;
    case Ending::krylov_stalled:
      return Status::krylov_stalled;
    case Ending::linearisation_failed:
      return Status::linearisation_failed;
    case Ending::stopped:
      return Status::stopped;
    case Ending::limit:
      return Status::evaluation_limit;
  }
  return Status::max_iterations;
}

void throw_if_invalid(const Options& options) {
  const std::vector<std::string> messages = validate(options);
  if (messages.empty()) return;
  std::string text = "jfnk::Options:";
  for (const std::string& message : messages) text += " " + message + ";";
  text.pop_back();
  throw std::invalid_argument(text);
}

}  // namespace
}  // namespace detail

struct Solver::Memory {
  Options options;
  detail::Workspace work;
  Report report;
};

Solver::Solver(const Options& options) : memory_(std::make_unique<Memory>()) {
  set_options(options);
}
Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

const Options& Solver::options() const {
  return memory_->options;
}

void Solver::set_options(const Options& options) {
  detail::throw_if_invalid(options);
  memory_->options = options;
}

const Report& Solver::solve_erased(const ResidualRef& residual, Vector& u,
                                   const PreconditionerRef& preconditioner,
                                   const ObserverRef& observer) {
  if (u.size() == 0) throw std::invalid_argument("jfnk::Solver: u is empty");
  const Options& options = memory_->options;
  detail::Workspace& work = memory_->work;
  Report& report = memory_->report;
  detail::resize(work, u.size(), options, !preconditioner.is_identity());
  detail::begin(report, options);
  work.best.u = u;

  detail::Evaluator evaluator(residual, options, report.counts, work.probe);
  detail::Solve solve{options, evaluator, preconditioner, observer, work, report};
  Status failure = Status::converged;
  detail::Ending ending = detail::start(solve, failure);
  if (failure == Status::out_of_domain_at_start) {
    detail::finish(solve, failure, u);
    return report;
  }
  if (ending == detail::Ending::schedule_done) {
    if (preconditioner.has_setup()) {
      ++report.counts.preconditioner_setups;
      preconditioner.setup(work.best.u);
    }
    ending = detail::run(solve);
  }
  detail::finish(solve, detail::status_of(ending), u);
  return report;
}

}  // namespace jfnk
