#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

#include "jfnk/misuse.hpp"
#include "jfnk/options.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"
#include "jfnk/vector_traits.hpp"

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
      : object_(detail::erase(o)), call_([](void* p, const Iteration& i) {
          if constexpr (std::is_void_v<decltype(std::declval<O&>()(i))>) {
            detail::restore<O>(p)(i);
            return true;
          } else {
            return detail::restore<O>(p)(i);
          }
        }) {}

  /// False if the observer asks to stop.
  bool operator()(const Iteration& i) const { return call_(object_, i); }

 private:
  void* object_;
  bool (*call_)(void*, const Iteration&);
};

/// Changes of u and of F that belong together, of a solve, each divided by the length of the
/// latter: a column per pair.
struct SecantPairs {
  Eigen::MatrixXf step;
  Eigen::MatrixXf change;
};

namespace detail {

/// Vectors of doubles of Eigen's: mapped and fixed ones, parts of others, expressions.
template <class U>
concept EigenDoubles = requires(const U& u) {
  []<class D>(const Eigen::MatrixBase<D>&) {}(u);
  requires std::same_as<typename U::Scalar, double>;
  requires U::ColsAtCompileTime == 1;
};

template <class O>
constexpr void explain_observer() {
  static_assert(Observer<O>,
                "jfnk: the observer must be callable with a const Iteration& and return nothing or "
                "bool (false: stop)");
}

/// Calls `run(residual, values, preconditioner, rounding)` on vectors of doubles, whatever the type
/// of u: that of the residual's arguments, or one whose values fit into them.
/// @param write  whether u receives the values afterwards
template <bool write, class F, class U, class P, class Run>
auto on_doubles(F& residual, U& u, P& preconditioner, Run&& run) {
  using V = std::remove_const_t<U>;
  constexpr double rounding = std::numeric_limits<double>::epsilon();
  // Asked first where it costs no compiling of a generic residual for vectors it was not made for.
  constexpr bool native = std::same_as<V, Vector>;
  if constexpr (native) {
    explain_residual<F, Vector>();
    explain_preconditioner<P, Vector>();
    return run(residual, u, preconditioner, rounding);
  } else if constexpr (EigenDoubles<V> && TakesUAndR<F, Vector> &&
                       (!write || std::is_assignable_v<U&, const Vector&>)) {
    explain_residual<F, Vector>();
    explain_preconditioner<P, Vector>();
    Vector values = u;
    const auto result = run(residual, values, preconditioner, rounding);
    if constexpr (write) u = values;
    return result;
  } else if constexpr (ForeignVector<V>) {
    explain_residual<F, V>();
    Vector values(VectorTraits<V>::size(u));
    VectorTraits<V>::read(u, values);
    ForeignResidual<V, F> f(residual, u);
    const auto result = [&] {
      if constexpr (PreconditionerOn<P, Vector>) {
        return run(f, values, preconditioner, rounding_of<V>);
      } else {
        explain_preconditioner<P, V>();
        ForeignPreconditioner<V, P> p(preconditioner, u);
        return run(f, values, p, rounding_of<V>);
      }
    }();
    if constexpr (write) VectorTraits<V>::write(values, u);
    return result;
  } else {
    static_assert(native,
                  "jfnk: u must be a jfnk::Vector, another vector of Eigen's, a std::vector of "
                  "float or double, or of a type with a specialisation of jfnk::VectorTraits");
  }
}

}  // namespace detail

/// All that a solve needs to go on, as plain numbers: two solvers with equal options, residual and
/// preconditioner continue from equal snapshots bit for bit.
struct Snapshot {
  std::vector<std::int64_t> integers;
  std::vector<double> reals;
};

/// Solves F(u) = 0, keeping its memory from one solve to the next.
///
/// Nothing else is kept, but where `begin_with` asks for it: a second solve gives bit for bit what
/// a new Solver would. Distinct solvers may run in distinct threads. Memory grows with the pairs
/// and Krylov vectors in use; a solve that needs no more than one before allocates nothing but the
/// factors of a Jacobian learnt (see Learning).
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
  /// u is a `Vector`, or any other vector of doubles of Eigen's (a map, a fixed one) with a
  /// residual on `Vector`; or residual, preconditioner and u are all of one type with VectorTraits,
  /// such as std::vector (but `dot` takes two `Vector`, the local parts). In single precision
  /// `jacobian.noise`, unless chosen, becomes the root of its rounding unit. Functions, lambdas and
  /// objects will do.
  /// Exceptions of the residual, preconditioner or observer pass through; u is then unchanged.
  /// @param F  residual; see the concepts in residual.hpp for what it may offer
  /// @param[in,out] u  first guess; on return the solution or the best iterate (see Status)
  /// @param preconditioner  approximate inverse of the Jacobian
  /// @param observer  called after each nonlinear iteration
  /// @return valid until the next solve of this object
  /// @throws std::invalid_argument if u is empty, sizes of options disagree with it, or the
  /// residual
  ///   resizes its output
  template <class F, class U, class P = Identity, class O = NoObserver>
  const Report& solve(F&& residual, U&& u, P&& preconditioner = {}, O&& observer = {}) {
    detail::explain_observer<std::remove_reference_t<O>>();
    return *detail::on_doubles<true>(
        residual, u, preconditioner, [&](auto& f, Vector& values, auto& p, double rounding) {
          return &solve_erased(ResidualRef(f), values, PreconditionerRef(p), ObserverRef(observer),
                               rounding);
        });
  }

  /// The same by hand: `start`, then `step` while it returns true, then `report` and `solution`.
  /// `start` evaluates F at u and sets up the preconditioner. Vectors as for `solve`.
  /// @return whether there is anything left to do
  template <class F, class U, class P = Identity, class O = NoObserver>
  bool start(F&& residual, const U& u, P&& preconditioner = {}, O&& observer = {}) {
    detail::explain_observer<std::remove_reference_t<O>>();
    return detail::on_doubles<false>(
        residual, u, preconditioner, [&](auto& f, const Vector& values, auto& p, double rounding) {
          return start_erased(ResidualRef(f), values, PreconditionerRef(p), ObserverRef(observer),
                              rounding);
        });
  }

  /// One nonlinear iteration. After an exception of a callable there is nothing left to do.
  /// @return whether there is anything left to do; false as well if nothing was started
  template <Residual F, class P = Identity, class O = NoObserver>
  requires Preconditioner<P>
  bool step(F&& residual, P&& preconditioner = {}, O&& observer = {}) {
    detail::explain_residual<std::remove_reference_t<F>, Vector>();
    detail::explain_observer<std::remove_reference_t<O>>();
    return step_erased(ResidualRef(residual), PreconditionerRef(preconditioner),
                       ObserverRef(observer));
  }

  /// The same for a residual on another type of vector than `Vector`.
  /// @param like  any vector of that type and of the size of u; its values are not looked at
  template <class F, class U, class P = Identity, class O = NoObserver>
  requires(!Preconditioner<U>) bool step(F&& residual, const U& like, P&& preconditioner = {},
                                         O&& observer = {}) {
    detail::explain_observer<std::remove_reference_t<O>>();
    return detail::on_doubles<false>(
        residual, like, preconditioner, [&](auto& f, const Vector&, auto& p, double) {
          return step_erased(ResidualRef(f), PreconditionerRef(p), ObserverRef(observer));
        });
  }

  /// The next solve, of as many unknowns and by multisecants, begins with these pairs of one
  /// before. They spare evaluations where the same few modes are soft in both, as in load steps of
  /// plastic flow; where the Jacobian changes smoothly as a whole they cost some. All pairs are
  /// dropped when they lead nowhere (`Multisecant::given_patience`) or Newton has to help. Of no
  /// use, and not looked at, by Newton-Krylov and in the norm of P F; forgotten by `set_options`
  /// and `load`.
  /// @param pairs  of a solver with the same u_scale and f_scale, as `pairs` hands them out; of a
  ///   distributed residual the rows of this process
  /// @throws std::invalid_argument if steps and changes differ in size, or are not finite; `start`
  ///   and `solve` if they are not of the size of u
  void begin_with(SecantPairs pairs);
  /// The latest pairs of the last solve, oldest first; none where they are not changes of F
  /// (Newton-Krylov, the norm of P F, a learnt Jacobian) or too long for single precision.
  /// @param count  no more than so many
  /// @param[out] pairs  resized
  void pairs(int count, SecantPairs& pairs) const;

  /// What has happened so far: `Status::not_started` before `start`, `Status::in_progress` until
  /// `step` has returned false.
  [[nodiscard]] const Report& report() const;

  /// The iterate of the lowest ||F|| so far; empty before `start`.
  [[nodiscard]] Vector solution() const;

  /// Memory of its vectors and its history [bytes], as they have grown so far; not of the factors
  /// of a Jacobian learnt.
  [[nodiscard]] std::size_t bytes() const;
  /// The same of a long solve of n unknowns to come: all pairs of the multisecant are in use, and
  /// so many Krylov vectors.
  [[nodiscard]] std::size_t bytes_to_come(Eigen::Index n, bool preconditioned,
                                          int krylov_vectors = 10) const;
  /// The same into a vector of another type.
  /// @param[out] u  of the size of the first guess
  template <ForeignVector V>
  void solution(V& u) const {
    VectorTraits<V>::write(solution(), u);
  }

  /// The state between two steps.
  [[nodiscard]] Snapshot save() const;

  /// Continues from a saved state, under the options this solver has; the next call is `step`,
  /// which sets up the preconditioner where it was set up last.
  /// @throws std::invalid_argument if the snapshot is damaged or does not fit the options
  void load(const Snapshot& snapshot);

 private:
  const Report& solve_erased(const ResidualRef& residual, Vector& u,
                             const PreconditionerRef& preconditioner, const ObserverRef& observer,
                             double rounding);
  bool start_erased(const ResidualRef& residual, const Vector& u,
                    const PreconditionerRef& preconditioner, const ObserverRef& observer,
                    double rounding);
  bool step_erased(const ResidualRef& residual, const PreconditionerRef& preconditioner,
                   const ObserverRef& observer);

  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Finds u with F(u) = 0 once. See `Solver::solve`.
template <class F, class U, class P = Identity, class O = NoObserver>
[[nodiscard]] Report solve(F&& residual, U&& u, const Options& options = {},
                           P&& preconditioner = {}, O&& observer = {}) {
  Solver solver(options);
  return solver.solve(residual, u, preconditioner, observer);
}

}  // namespace jfnk
