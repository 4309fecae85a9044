#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <vector>

#include "jfnk/options.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"

namespace jfnk {

/// Any callable `(const Iteration&)` that returns void, or bool: false stops the solve.
template <class O>
concept Observer = requires(O& o, const Iteration& i) {
  o(i);
  requires std::is_void_v<decltype(o(i))> || std::same_as<decltype(o(i)), bool>;
};

/// Sees nothing.
struct NoObserver {
  void operator()(const Iteration&) const {}
};

/// Non-owning, type-erased view of an observer.
class ObserverRef {
 public:
  template <class O>
  requires(!std::same_as<std::remove_cv_t<O>, ObserverRef> &&
           Observer<O>) explicit ObserverRef(O& o)
      : object_(const_cast<void*>(static_cast<const void*>(std::addressof(o)))),
        call_([](void* p, const Iteration& i) {
          if constexpr (std::is_void_v<decltype(std::declval<O&>()(i))>) {
            (*static_cast<O*>(p))(i);
            return true;
          } else {
            return (*static_cast<O*>(p))(i);
          }
        }) {}

  /// False if the observer asks to stop.
  bool operator()(const Iteration& i) const { return call_(object_, i); }

 private:
  void* object_;
  bool (*call_)(void*, const Iteration&);
};

/// All that a solve needs to go on, as plain numbers: two solvers with equal options, residual and
/// preconditioner continue from equal snapshots bit for bit.
struct Snapshot {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

/// Solves F(u) = 0, keeping its memory from one solve to the next.
///
/// Nothing else is kept: a second solve gives bit for bit what a new Solver would. Distinct solvers
/// may run in distinct threads. No allocation between the first and the last evaluation but for the
/// factors of a Jacobian that is learnt (see Learning).
class Solver {
 public:
  /// @throws std::invalid_argument with every message of `validate` if options are not usable
  explicit Solver(const Options& options = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// The choices in force.
  [[nodiscard]] const Options& options() const;
  /// Replaces them, and forgets a solve in progress. @throws std::invalid_argument as the
  /// constructor
  void set_options(const Options& options);

  /// Finds u with F(u) = 0.
  ///
  /// Exceptions of the residual, preconditioner or observer pass through; u is then unchanged.
  /// @param F  residual; see the concepts in residual.hpp for what it may offer
  /// @param[in,out] u  first guess; on return the solution or the best iterate (see Status)
  /// @param preconditioner  approximate inverse of the Jacobian
  /// @param observer  called after each nonlinear iteration
  /// @return valid until the next solve of this object
  /// @throws std::invalid_argument if u is empty, sizes of options disagree with it, or the
  /// residual
  ///   resizes its output
  template <Residual F, Preconditioner P = Identity, Observer O = NoObserver>
  const Report& solve(F&& residual, Vector& u, P&& preconditioner = {}, O&& observer = {}) {
    return solve_erased(ResidualRef(residual), u, PreconditionerRef(preconditioner),
                        ObserverRef(observer));
  }

  /// The same by hand: `start`, then `step` while it returns true, then `report` and `solution`.
  /// `start` evaluates F at u and sets up the preconditioner.
  /// @return whether there is anything left to do
  template <Residual F, Preconditioner P = Identity, Observer O = NoObserver>
  bool start(F&& residual, const Vector& u, P&& preconditioner = {}, O&& observer = {}) {
    return start_erased(ResidualRef(residual), u, PreconditionerRef(preconditioner),
                        ObserverRef(observer));
  }

  /// One nonlinear iteration. After an exception of a callable, begin again by `start`.
  /// @return whether there is anything left to do; false as well if nothing was started
  template <Residual F, Preconditioner P = Identity, Observer O = NoObserver>
  bool step(F&& residual, P&& preconditioner = {}, O&& observer = {}) {
    return step_erased(ResidualRef(residual), PreconditionerRef(preconditioner),
                       ObserverRef(observer));
  }

  /// What has happened so far; `Status::in_progress` until `step` has returned false.
  [[nodiscard]] const Report& report() const;

  /// The iterate of the lowest ||F|| so far; empty before `start`.
  [[nodiscard]] Vector solution() const;

  /// The state between two steps.
  [[nodiscard]] Snapshot save() const;

  /// Continues from a saved state, under the options this solver has; the next call is `step`,
  /// which sets up the preconditioner where it was set up last.
  /// @throws std::invalid_argument if the snapshot is damaged or does not fit the options
  void load(const Snapshot& snapshot);

 private:
  const Report& solve_erased(const ResidualRef& residual, Vector& u,
                             const PreconditionerRef& preconditioner, const ObserverRef& observer);
  bool start_erased(const ResidualRef& residual, const Vector& u,
                    const PreconditionerRef& preconditioner, const ObserverRef& observer);
  bool step_erased(const ResidualRef& residual, const PreconditionerRef& preconditioner,
                   const ObserverRef& observer);

  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Finds u with F(u) = 0 once. See `Solver::solve`.
template <Residual F, Preconditioner P = Identity, Observer O = NoObserver>
[[nodiscard]] Report solve(F&& residual, Vector& u, const Options& options = {},
                           P&& preconditioner = {}, O&& observer = {}) {
  Solver solver(options);
  return solver.solve(residual, u, preconditioner, observer);
}

}  // namespace jfnk
