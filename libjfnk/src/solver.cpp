#include "jfnk/solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "memory.hpp"
#include "outcome_text.hpp"
#include "passes.hpp"

namespace jfnk {
namespace detail {

bool Solve::record(Iteration line, const Iterate& at) const {
  line.index = static_cast<int>(report.history.size());
  line.residual_norm = at.norm;
  line.reference_norm = at.reference;
  const bool set_aside = course.preconditioner.doubted && !course.preconditioner.suspended &&
                         work.aside.norm < work.best.norm;
  line.best_residual_norm = set_aside ? work.aside.norm : work.best.norm;
  line.evaluations = report.counts.total();
  report.history.push_back(line);
  return observer(report.history.back());
}

Ending Solve::accept_base(const Iteration& line) const {
  const bool converged = evaluator.converged(work.base, line.step_norm);
  // The reference norm may vary, so that a point which meets the tolerance need not have the lowest
  // norm.
  if (converged || work.base.norm < work.best.norm) {
    work.best.resize(work.base.u.size());
    evaluator.product().pass(work.base.u.size(), 4, [&](Rows rows) {
      rows.of(work.best.u) = rows.of(work.base.u);
      rows.of(work.best.r) = rows.of(work.base.r);
    });
    work.best.norm = work.base.norm;
    work.best.reference = work.base.reference;
  }
  evaluator.accept(work.base.u);
  const bool go_on = record(line, work.base);
  if (converged) return Ending::converged;
  return go_on ? Ending::go_on : Ending::stopped;
}

void Solve::note_trouble(Trouble trouble) const {
  constexpr double alike = 1.01;
  const bool known = report.trouble != Trouble::none;
  if (known && work.base.norm > alike * course.rescue.trouble_norm) return;
  report.trouble = trouble;
  course.rescue.trouble_norm = work.base.norm;
}

void Solve::undo_round() const {
  std::swap(work.best, work.aside);
  return_to_best();
}

void Solve::return_to_best() const {
  const bool moves = work.base.norm != work.best.norm;
  work.base = work.best;
  if (moves) evaluator.accept(work.base.u);
}

void resize(Workspace& work, Eigen::Index n, Eigen::Index global, const Options& options,
            bool preconditioned) {
  for (Iterate* point : {&work.base, &work.trial, &work.best, &work.first, &work.aside})
    point->resize(n);
  for (Vector* v : {&work.step, &work.direction, &work.evaluator.probe}) v->resize(n);
  const bool u_scaled = options.u_scale.size() > 0;
  work.evaluator.physical.resize(u_scaled ? n : 0);
  work.evaluator.image.resize(options.f_scale.size() > 0 && preconditioned ? n : 0);
  work.setup_point.resize(preconditioned ? n : 0);
  if (options.method != Method::multisecant) {
    GmresOptions linear;
    linear.global_size = global;
    linear.restart = options.krylov.restart;
    linear.max_iterations = options.krylov.max_iterations;
    linear.flexible = options.krylov.flexible;
    linear.single_precision = options.krylov.single_precision;
    switch (options.krylov.solver) {
      case Krylov::Solver::bicgstab:
        work.bicgstab.resize(n, preconditioned);
        break;
      case Krylov::Solver::conjugate_gradients:
        work.conjugate_gradients.resize(n, preconditioned);
        break;
      default:
        work.gmres.resize(n, linear, preconditioned);
    }
  }
  if (options.method != Method::newton_krylov) {
    const Eigen::Index pairs = std::min<Eigen::Index>(options.multisecant.memory, global);
    work.secants.resize(n, static_cast<int>(pairs), options.multisecant.single_precision);
    const bool broyden = preconditioned && options.multisecant.broyden;
    work.broyden.resize(n, broyden ? options.multisecant.memory : 0);
    for (Vector* v : {&work.by_least_squares, &work.by_broyden, &work.image}) {
      v->resize(broyden ? n : 0);
    }
    const Multisecant& rule = options.multisecant;
    const bool kept = rule.broyden || rule.preconditioned_norm || options.learning.enabled;
    for (Vector* v : {&work.preconditioned, &work.preconditioned_before}) {
      v->resize(preconditioned && kept ? n : 0);
    }
  }
}

namespace {

/// Lines of history that are made room for: one per nonlinear iteration, and each iteration costs
/// an evaluation or more.
std::size_t most_lines(const Options& options) {
  constexpr int most = 20000;
  return static_cast<std::size_t>(std::min(options.max_evaluations, most)) + 1;
}

void begin(Report& report, const Options& options) {
  std::vector<Iteration> history = std::move(report.history);
  history.clear();
  history.reserve(most_lines(options));
  // Copied into what the report holds already: a new one would allocate its words.
  static const Report blank;
  report = blank;
  report.reason.clear();
  report.history = std::move(history);
  report.status = Status::in_progress;
  report.residual_norm = std::numeric_limits<double>::quiet_NaN();
  report.initial_residual_norm = report.residual_norm;
}

/// The three largest |F_i| that are not zero, largest first.
void find_worst(const Vector& r, std::vector<Component>& worst) {
  constexpr std::size_t shown = 3;
  worst.clear();
  for (Eigen::Index i = 0; i < r.size(); ++i) {
    if (r[i] == 0.0) continue;
    const auto place = std::find_if(worst.begin(), worst.end(), [&](const Component& c) {
      return std::abs(r[i]) > std::abs(c.residual);
    });
    if (place == worst.end() && worst.size() == shown) continue;
    worst.insert(place, Component{i, r[i]});
    if (worst.size() > shown) worst.pop_back();
  }
}

void describe_best(Solve& solve) {
  Report& report = solve.report;
  const Iterate& best = solve.work.best;
  report.residual_norm = best.norm;
  report.reference_norm = best.reference;
  report.tolerance = solve.evaluator.tolerance(best);
}

void finish(Solve& solve, Status status) {
  Report& report = solve.report;
  const bool set_aside =
      solve.course.preconditioner.doubted && !solve.course.preconditioner.suspended;
  if (set_aside && status != Status::converged && solve.work.aside.norm < solve.work.best.norm) {
    std::swap(solve.work.best, solve.work.aside);
  }
  solve.course.stage.kind = Stage::ended;
  report.status = status;
  if (!report.history.empty()) {
    describe_best(solve);
    const Vector& r = solve.work.best.r;
    if (r.size() > 0) r.cwiseAbs().maxCoeff(&report.worst_component);
    if (status != Status::converged) {
      find_worst(r, report.worst);
      solve.return_to_best();
    }
  }
  const bool failed = status != Status::converged && !report.history.empty();
  report.reason = reason(report, solve.options, failed ? sizes_of(solve.work.first.u) : Sizes{});
}

/// A failed line search is a local minimum if J v was right and yet of no use, or if the last
/// linear solve could not lower F at all though it had the whole space.
bool at_local_minimum(const Report& report) {
  constexpr double nothing_gained = 0.999;
  if (report.trouble == Trouble::minimum) return true;
  return report.last_linear_residual > nothing_gained && report.trouble != Trouble::krylov_capped;
}

Status status_of(Ending ending, const Report& report) {
  switch (ending) {
    case Ending::converged:
      return Status::converged;
    case Ending::go_on:
    case Ending::schedule_done:
      return Status::max_iterations;
    case Ending::patience_lost:
      return Status::multisecant_stalled;
    case Ending::line_search_failed:
    case Ending::transient_failed:
      return at_local_minimum(report) ? Status::local_minimum : Status::line_search_failed;
    case Ending::stagnated:
      // Steps that the domain cuts to nothing are a search that fails, slowly.
      if (report.trouble == Trouble::domain_edge) return Status::line_search_failed;
      return at_local_minimum(report) ? Status::local_minimum : Status::stagnated;
    case Ending::krylov_stalled:
      return report.trouble == Trouble::minimum ? Status::local_minimum : Status::krylov_stalled;
    case Ending::linearisation_failed:
      return Status::linearisation_failed;
    case Ending::stopped:
      return Status::stopped;
    case Ending::limit:
      return Status::evaluation_limit;
    case Ending::stationary:
      return Status::local_minimum;
    case Ending::noise_floor:
      return Status::noise_floor;
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

void require_size(const Vector& v, Eigen::Index n, const char* name) {
  if (v.size() == 0 || v.size() == n) return;
  throw std::invalid_argument(std::string("jfnk::Solver: u has size ") + std::to_string(n) + ", " +
                              name + " has size " + std::to_string(v.size()));
}

void require_fit(const Options& options, const ResidualRef& residual, const Vector& u) {
  if (u.size() == 0 && !residual.is_distributed()) {
    throw std::invalid_argument("jfnk::Solver: u is empty");
  }
  require_size(options.u_scale, u.size(), "u_scale");
  require_size(options.f_scale, u.size(), "f_scale");
  require_size(options.lower, u.size(), "lower");
  require_size(options.upper, u.size(), "upper");
  if (residual.is_distributed() && options.lower.size() + options.upper.size() > 0) {
    throw std::invalid_argument("jfnk::Solver: bounds are not offered for distributed residuals");
  }
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const bool low = options.lower.size() > 0 && !(u[i] >= options.lower[i]);
    const bool high = options.upper.size() > 0 && !(u[i] <= options.upper[i]);
    if (!low && !high) continue;
    throw std::invalid_argument("jfnk::Solver: u[" + std::to_string(i) + "] = " + number(u[i], 6) +
                                " is outside its bounds");
  }
}

/// Puts pairs of a former solve into the memory.
void take_given(Solve& solve, const SecantPairs& given) {
  if (given.step.cols() == 0 || in_preconditioned_norm(solve)) return;
  solve.work.secants.clear(keeps_images(solve));
  solve.work.secants.begin_with(given.step, given.change, solve.options.multisecant.max_condition,
                                solve.evaluator.product());
}

/// What of the given is of use. @throws std::invalid_argument if that does not fit
SecantPairs of_use(SecantPairs given, const Options& options, Eigen::Index n) {
  if (given.step.cols() == 0 || !pairs_are_of_residual(options)) return {};
  if (given.step.rows() == n) return given;
  throw std::invalid_argument("jfnk::Solver: u has size " + std::to_string(n) +
                              ", the pairs it was given have size " +
                              std::to_string(given.step.rows()));
}

/// Evaluates the first u; true if there is anything left to do.
bool start(Solve& solve) {
  Iterate& first = solve.work.best;
  Report& report = solve.report;
  const bool finite = std::isfinite(solve.evaluator.product().norm(first.u));
  const Outcome outcome = finite ? solve.evaluator.evaluate_start(first) : Outcome::out_of_domain;
  if (outcome != Outcome::ok) {
    if (outcome == Outcome::out_of_domain) {
      report.worst_component =
          finite ? first_not_finite(first.r, solve.evaluator.refused()) : first_not_finite(first.u);
    }
    finish(solve, outcome == Outcome::stopped ? Status::stopped : Status::out_of_domain_at_start);
    const Eigen::Index worst = report.worst_component;
    if (finite && worst >= 0 && is_unwritten(first.r[worst])) report.reason = unwritten_text(worst);
    return false;
  }
  report.initial_residual_norm = first.norm;
  solve.work.base = first;
  solve.work.first = first;
  solve.work.aside = solve.work.best;
  solve.evaluator.accept(first.u);
  const bool go_on = solve.record(Iteration{}, first);
  describe_best(solve);
  if (solve.evaluator.converged(first, -1.0)) {
    finish(solve, Status::converged);
    return false;
  }
  if (!go_on) {
    finish(solve, Status::stopped);
    return false;
  }
  begin_schedule(solve);
  return true;
}

constexpr double double_rounding = std::numeric_limits<double>::epsilon();

/// Calls what may throw an exception of the caller's, after which the solve is at an end.
template <class Call>
bool unless_thrown(Course& course, Report& report, Call&& call) {
  try {
    return call();
  } catch (...) {
    course = {};
    report.status = Status::threw;
    report.reason = reason(report, {}, {});
    throw;
  }
}

}  // namespace
}  // namespace detail

namespace {

/// Eigen's allFinite, a register's width at a time.
bool is_finite(const Eigen::MatrixXf& m) {
  return (m - m).sum() == 0.0F;
}

}  // namespace

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
  memory_->course = {};
  memory_->given = {};
  memory_->hands_out = false;
}

void Solver::begin_with(SecantPairs pairs) {
  const bool fit =
      pairs.step.rows() == pairs.change.rows() && pairs.step.cols() == pairs.change.cols();
  if (!fit || !is_finite(pairs.step) || !is_finite(pairs.change)) {
    throw std::invalid_argument(
        fit ? "jfnk::Solver::begin_with: the pairs are not finite"
            : "jfnk::Solver::begin_with: steps and changes differ in size or number");
  }
  memory_->given = std::move(pairs);
}

void Solver::pairs(int count, SecantPairs& pairs) const {
  const detail::Workspace& work = memory_->work;
  const bool of_residual = memory_->hands_out && !work.evaluator_state.learnt;
  work.secants.copy_latest(of_residual ? count : 0, pairs.step, pairs.change);
  // Steps may be too long for single precision, in units of their own.
  if (!is_finite(pairs.step)) work.secants.copy_latest(0, pairs.step, pairs.change);
}

const Report& Solver::report() const {
  return memory_->report;
}

Vector Solver::solution() const {
  const Vector& u = memory_->work.best.u;
  const Vector& scale = memory_->options.u_scale;
  return scale.size() == u.size() && u.size() > 0 ? Vector(u.cwiseProduct(scale)) : u;
}

std::size_t Solver::bytes() const {
  const detail::Workspace& work = memory_->work;
  Eigen::Index numbers = 0;
  for (const detail::Iterate* at :
       {&work.base, &work.trial, &work.best, &work.first, &work.aside}) {
    numbers += at->u.size() + at->r.size();
  }
  for (const Vector* v :
       {&work.step, &work.direction, &work.setup_point, &work.evaluator.probe,
        &work.evaluator.physical, &work.evaluator.image, &work.by_least_squares, &work.by_broyden,
        &work.image, &work.preconditioned, &work.preconditioned_before}) {
    numbers += v->size();
  }
  return static_cast<std::size_t>(numbers) * sizeof(double) + work.gmres.bytes() +
         work.bicgstab.bytes() + work.conjugate_gradients.bytes() + work.secants.bytes() +
         work.broyden.bytes() + memory_->report.history.capacity() * sizeof(Iteration) +
         static_cast<std::size_t>(memory_->given.step.size() + memory_->given.change.size()) *
             sizeof(float);
}

std::size_t Solver::bytes_to_come(Eigen::Index n, bool preconditioned, int krylov_vectors) const {
  const Options& options = memory_->options;
  const Eigen::Index p = preconditioned ? 1 : 0;
  Eigen::Index vectors = 13 + p;  // iterates and residuals, step, direction, probe; setup_point
  Eigen::Index singles = 0;
  if (options.method != Method::multisecant) {
    const Eigen::Index most = std::min(options.krylov.restart, options.krylov.max_iterations) + 1;
    const Eigen::Index basis = std::min<Eigen::Index>({most, krylov_vectors + 1, n + 1});
    if (options.krylov.solver == Krylov::Solver::bicgstab) {
      vectors += 6 + p;
    } else if (options.krylov.solver == Krylov::Solver::conjugate_gradients) {
      vectors += 3 + p;
    } else {
      vectors += 2 + p;
      (options.krylov.single_precision ? singles : vectors) += basis;
    }
  }
  if (options.method != Method::newton_krylov) {
    const Multisecant& rule = options.multisecant;
    const Eigen::Index pairs = std::min<Eigen::Index>(rule.memory, n);
    const bool broyden = preconditioned && rule.broyden;
    vectors += 1 + (broyden ? 3 + 2 * rule.memory : 0);
    const Eigen::Index columns = (broyden && !rule.preconditioned_norm ? 3 : 2) * pairs;
    (rule.single_precision ? singles : vectors) += columns;
    if (preconditioned && (broyden || rule.preconditioned_norm || options.learning.enabled)) {
      vectors += 2;
    }
  }
  return static_cast<std::size_t>(vectors * n) * sizeof(double) +
         static_cast<std::size_t>(singles * n) * sizeof(float) +
         detail::most_lines(options) * sizeof(Iteration);
}

bool Solver::start_erased(const ResidualRef& residual, const Vector& u,
                          const PreconditionerRef& preconditioner, const ObserverRef& observer,
                          double rounding) {
  Memory& m = *memory_;
  SecantPairs offered = std::exchange(m.given, {});
  detail::require_fit(m.options, residual, u);
  const SecantPairs given = detail::of_use(std::move(offered), m.options, u.size());
  detail::resize(m.work, u.size(), residual.global_size(u.size()), m.options,
                 !preconditioner.is_identity());
  detail::begin(m.report, m.options);
  m.course = {};
  m.needs_setup = false;
  m.work.evaluator_state = {};
  const double chosen = m.options.jacobian.noise;
  m.work.evaluator_state.noise = chosen == Jacobian{}.noise && rounding > detail::double_rounding
                                     ? std::sqrt(rounding)
                                     : chosen;
  detail::Evaluator evaluator(residual, preconditioner, m.options, m.report.counts,
                              m.work.evaluator, m.work.evaluator_state);
  m.work.best.u = u;
  evaluator.to_solver_units(m.work.best.u);
  detail::Solve solve{m.options, evaluator, observer, m.work, m.course, m.report};
  m.hands_out = detail::pairs_are_of_residual(m.options);
  return detail::unless_thrown(m.course, m.report, [&] {
    detail::take_given(solve, given);
    return detail::start(solve);
  });
}

bool Solver::step_erased(const ResidualRef& residual, const PreconditionerRef& preconditioner,
                         const ObserverRef& observer) {
  Memory& m = *memory_;
  if (m.course.stage.kind == detail::Stage::ended) return false;
  detail::Evaluator evaluator(residual, preconditioner, m.options, m.report.counts,
                              m.work.evaluator, m.work.evaluator_state);
  detail::Solve solve{m.options, evaluator, observer, m.work, m.course, m.report};
  return detail::unless_thrown(m.course, m.report, [&] {
    if (std::exchange(m.needs_setup, false)) {
      const bool was_set_up = m.work.setup_point.size() > 0;
      if (was_set_up && preconditioner.has_setup()) {
        preconditioner.setup(evaluator.physical(m.work.setup_point));
      }
    }
    const detail::Ending ending = detail::advance(solve);
    if (ending == detail::Ending::go_on) {
      detail::describe_best(solve);
      return true;
    }
    detail::finish(solve, detail::status_of(ending, m.report));
    return false;
  });
}

const Report& Solver::solve_erased(const ResidualRef& residual, Vector& u,
                                   const PreconditionerRef& preconditioner,
                                   const ObserverRef& observer, double rounding) {
  bool more = start_erased(residual, u, preconditioner, observer, rounding);
  while (more) more = step_erased(residual, preconditioner, observer);
  if (!memory_->report.history.empty()) u = solution();
  return memory_->report;
}

}  // namespace jfnk
