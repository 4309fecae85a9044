#include <array>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "memory.hpp"

namespace jfnk {
namespace detail {
namespace {

// First integer of a snapshot; raised when its fields change.
constexpr std::int64_t snapshot_version = 8;

struct Writer {
  Snapshot& out;

  template <class T>
  requires(std::is_integral_v<T> || std::is_enum_v<T>) void operator()(const T& value) {
    out.integers.push_back(static_cast<std::int64_t>(value));
  }
  void operator()(double value) { out.reals.push_back(value); }
  void operator()(const Vector& v) { out.reals.insert(out.reals.end(), v.begin(), v.end()); }
  template <std::size_t size>
  void operator()(const std::array<double, size>& values) {
    out.reals.insert(out.reals.end(), values.begin(), values.end());
  }
  template <Listed T>
  void operator()(T& part) {
    part.for_each_field(*this);
  }
};

struct Reader {
  const Snapshot& in;
  std::size_t integer = 0;
  std::size_t real = 0;

  template <class T>
  requires(std::is_integral_v<T> || std::is_enum_v<T>) void operator()(T& value) {
    if (integer >= in.integers.size()) fail();
    value = static_cast<T>(in.integers[integer++]);
  }
  void operator()(double& value) {
    if (real >= in.reals.size()) fail();
    value = in.reals[real++];
  }
  void operator()(Vector& v) {
    for (double& value : v) (*this)(value);
  }
  template <std::size_t size>
  void operator()(std::array<double, size>& values) {
    for (double& value : values) (*this)(value);
  }
  template <Listed T>
  void operator()(T& part) {
    part.for_each_field(*this);
  }
  [[noreturn]] static void fail() {
    throw std::invalid_argument("jfnk::Solver::load: the snapshot is damaged");
  }
};

/// Calls `walk` on each field.
template <class Walker, class... Fields>
void walk_all(Walker& walk, Fields&... fields) {
  (walk(fields), ...);
}

// The bindings below do not compile when a member is added and not named.

template <class Walker>
void walk_line(Walker& walk, Iteration& line) {
  auto& [index, phase, residual_norm, reference_norm, best_residual_norm, step_norm, step_length,
         forcing, linear_residual, krylov_iterations, secant_pairs, evaluations] = line;
  walk_all(walk, index, phase, residual_norm, reference_norm, best_residual_norm, step_norm,
           step_length, forcing, linear_residual, krylov_iterations, secant_pairs, evaluations);
}

template <class Walker>
void walk_counts(Walker& walk, Counts& counts) {
  auto& [start, newton_trials, line_search, multisecant, pseudo_transient, noise,
         difference_actions, user_actions, linearisations, preconditioner, preconditioner_setups,
         learning] = counts;
  walk_all(walk, start, newton_trials, line_search, multisecant, pseudo_transient, noise,
           difference_actions, user_actions, linearisations, preconditioner, preconditioner_setups,
           learning);
}

/// All but the history and what is only known at the end.
template <class Walker>
void walk_report(Walker& walk, Report& report) {
  walk(report.residual_norm);
  walk(report.initial_residual_norm);
  walk(report.reference_norm);
  walk(report.tolerance);
  walk(report.newton_iterations);
  walk(report.multisecant_iterations);
  walk(report.pseudo_transient_steps);
  walk(report.krylov_iterations);
  walk(report.last_linear_residual);
  walk(report.last_forcing);
  walk(report.measured_noise);
  walk(report.trouble);
  walk_counts(walk, report.counts);
}

/// Whether this can be the course of a solve in progress.
bool plausible_course(const Course& c) {
  const auto kept = static_cast<int>(c.newton.last_norms.size());
  return c.stage.kind >= Stage::multisecant && c.stage.kind < Stage::ended &&
         c.newton.last_norms_count >= 0 && c.newton.last_norms_count <= kept &&
         c.stage.round >= 0 && c.stage.iterations >= 0 && c.preconditioner.groups >= 0;
}

/// Whether the counts can be those of a solve.
bool plausible_counts(const Counts& c) {
  std::int64_t sum = 0;
  for (const int count :
       {c.start, c.newton_trials, c.line_search, c.multisecant, c.pseudo_transient, c.noise,
        c.difference_actions, c.user_actions, c.learning}) {
    if (count < 0) return false;
    sum += count;
  }
  return sum <= std::numeric_limits<int>::max();
}

template <class Walker>
void walk_iterate(Walker& walk, Iterate& point) {
  auto& [u, r, norm, reference] = point;
  walk_all(walk, u, r, norm, reference);
}

/// Every number between two steps that decides what follows, walked once for both directions.
template <class Walker>
void walk_state(Walker& walk, Workspace& work, Course& course, Report& report) {
  walk(course);
  walk_report(walk, report);
  walk_iterate(walk, work.base);
  walk_iterate(walk, work.best);
  walk_iterate(walk, work.first);
  walk_iterate(walk, work.aside);
  walk(work.evaluator_state.start_norm);
  walk(work.evaluator_state.noise);
  walk(work.evaluator_state.without_preconditioner);
  walk(work.setup_point);
  if (course.preconditioner.pattern_known) walk(work.evaluator.learnt.pattern());
  if (work.evaluator_state.learnt) walk(work.evaluator.learnt);
  work.secants.for_each_field(walk);
  work.broyden.for_each_field(walk);
  walk(work.by_least_squares);
  walk(work.by_broyden);
  walk(work.preconditioned);
  for (Iteration& line : report.history) walk_line(walk, line);
}

}  // namespace
}  // namespace detail

Snapshot Solver::save() const {
  Memory& m = *memory_;
  if (m.course.stage.kind == detail::Stage::ended) {
    throw std::invalid_argument("jfnk::Solver::save: no solve is in progress");
  }
  Snapshot snapshot;
  detail::Writer write{snapshot};
  write(detail::snapshot_version);
  write(m.options.method);
  write(m.work.base.u.size());
  write(m.work.secants.capacity());
  write(m.options.multisecant.single_precision);
  write(m.work.setup_point.size());
  write(m.work.evaluator_state.learnt);
  write(m.report.history.size());
  detail::walk_state(write, m.work, m.course, m.report);
  return snapshot;
}

void Solver::load(const Snapshot& snapshot) {
  auto loaded = std::make_unique<Memory>();
  loaded->options = memory_->options;
  Memory& m = *loaded;
  detail::Reader read{snapshot};
  std::int64_t version = 0;
  Method method = Method::hybrid;
  std::int64_t n = 0;
  std::int64_t capacity = 0;
  std::int64_t setup_size = 0;
  std::int64_t lines = 0;
  bool single_precision = false;
  bool learnt = false;
  read(version);
  if (version != detail::snapshot_version) {
    throw std::invalid_argument("jfnk::Solver::load: snapshot version " + std::to_string(version) +
                                ", this library reads " + std::to_string(detail::snapshot_version));
  }
  read(method);
  read(n);
  read(capacity);
  read(single_precision);
  read(setup_size);
  read(learnt);
  read(lines);
  const auto held = static_cast<std::int64_t>(snapshot.reals.size());
  const bool plausible =
      n >= 0 && n <= held / 5 && (setup_size == 0 || setup_size == n) && lines >= 0 &&
      lines <= held && capacity >= (method == Method::newton_krylov ? 0 : 1) && (n > 0 || !learnt);
  if (!plausible) detail::Reader::fail();
  if (method != m.options.method || capacity > m.options.multisecant.memory ||
      single_precision != m.options.multisecant.single_precision) {
    throw std::invalid_argument("jfnk::Solver::load: saved under other options");
  }
  detail::resize(m.work, n, std::max<std::int64_t>(n, capacity), m.options, setup_size > 0);
  m.work.secants.resize(n, static_cast<int>(capacity), single_precision);
  m.work.setup_point.resize(setup_size);
  m.work.evaluator.learnt.reset(n);
  if (learnt) detail::use_learnt_jacobian(m.work, m.options);
  m.report.history.resize(static_cast<std::size_t>(lines));
  detail::walk_state(read, m.work, m.course, m.report);
  if (read.integer != snapshot.integers.size() || read.real != snapshot.reals.size() ||
      !detail::plausible_counts(m.report.counts) || !detail::plausible_course(m.course) ||
      m.work.secants.given() < 0 || m.work.secants.given() > m.work.secants.size()) {
    detail::Reader::fail();
  }
  detail::LearntJacobian& jacobian = m.work.evaluator.learnt;
  const bool in_use = learnt && !m.work.evaluator_state.without_preconditioner;
  if (in_use && !jacobian.factorise(jacobian.shift())) detail::Reader::fail();
  m.report.status = Status::in_progress;
  m.hands_out = detail::pairs_are_of_residual(m.options);
  m.needs_setup = true;
  memory_ = std::move(loaded);
}

}  // namespace jfnk
