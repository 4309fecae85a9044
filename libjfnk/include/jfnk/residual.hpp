#pragma once

#include <Eigen/Core>
#include <bit>
#include <concepts>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "jfnk/vector_operations.hpp"

namespace jfnk {

/// What a residual says about one evaluation.
enum class Evaluation {
  ok,             ///< `r` holds F(u)
  out_of_domain,  ///< F cannot be evaluated at this u; recoverable, `r` is ignored
  stop            ///< give up the whole solve now; `r` is ignored
};

namespace detail {

/// What `r` is filled with before it is handed to F: a NaN that says where it comes from.
[[nodiscard]] inline double unwritten() {
  return std::bit_cast<double>(std::uint64_t{0x7ff86a666e6b0001});
}
/// Whether a value is still that one, or came of it by arithmetic or by way of a float.
[[nodiscard]] inline bool is_unwritten(double value) {
  constexpr int beyond_float = 29;  // digits of a double that a float lacks
  constexpr std::uint64_t no_sign = ~std::uint64_t{0} >> 1U;
  const auto bits = [](double x) {
    return (std::bit_cast<std::uint64_t>(x) & no_sign) >> beyond_float;
  };
  return bits(value) == bits(unwritten());
}

template <class R>
inline constexpr bool is_outcome =
    std::is_void_v<R> || std::same_as<R, bool> || std::same_as<R, Evaluation>;

/// The address of anything callable, functions included, without its type.
template <class T>
void* erase(T& t) {
  if constexpr (std::is_function_v<T>) {
    return reinterpret_cast<void*>(std::addressof(t));
  } else {
    return const_cast<void*>(static_cast<const void*>(std::addressof(t)));
  }
}

/// What `erase` was given.
template <class T>
T& restore(void* address) {
  if constexpr (std::is_function_v<T>) {
    return *reinterpret_cast<T*>(address);
  } else {
    return *static_cast<T*>(address);
  }
}

/// Calls `call` and reads its answer: nothing means ok, false means out_of_domain.
template <class Call>
Evaluation outcome_of(Call&& call) {
  using R = std::invoke_result_t<Call>;
  if constexpr (std::is_void_v<R>) {
    call();
    return Evaluation::ok;
  } else if constexpr (std::same_as<R, bool>) {
    return call() ? Evaluation::ok : Evaluation::out_of_domain;
  } else {
    return call();
  }
}

}  // namespace detail

/// Any callable `f(u, r)` that overwrites `r` and returns void, bool or Evaluation.
///
/// `r` arrives with the size of `u`, which it must keep, and full of NaN, so that a component that
/// F forgets to write is found out. A NaN or an infinity in `r` counts as
/// `Evaluation::out_of_domain`. Equal `u` must give equal `r`.
template <class F>
concept Residual = requires(F& f, const Vector& u, Vector& r) {
  f(u, r);
  requires detail::is_outcome<decltype(f(u, r))>;
};

/// A residual with its own Jacobian action: `linearise(u)`, then many `apply_jacobian(v, Jv)`.
///
/// Both may return void, bool or Evaluation. The last evaluated point need not be the `u` of
/// `linearise`, so it must not be taken for granted.
template <class F>
concept HasJacobian = requires(F& f, const Vector& u, Vector& Jv) {
  f.linearise(u);
  f.apply_jacobian(u, Jv);
  requires detail::is_outcome<decltype(f.linearise(u))>;
  requires detail::is_outcome<decltype(f.apply_jacobian(u, Jv))>;
};

/// A residual that names the scale its relative tolerance refers to, for the latest evaluation.
///
/// Without it the scale is ||F(u0)||. Example: the larger of the norms of reactions and loads.
template <class F>
concept HasReferenceNorm = requires(const F& f) {
  { f.reference_norm() } -> std::convertible_to<double>;
};

/// A residual spread over processes: the number of unknowns on all of them together. Its `dot` must
/// sum over all, and every process must return the same Evaluation.
template <class F>
concept HasGlobalSize = requires(const F& f) {
  { f.global_size() } -> std::convertible_to<Eigen::Index>;
};

/// A residual that is told which points the solver made its own: `on_accept(u)` at the first u,
/// after each accepted step, and when the solver goes back to an earlier point. What a residual
/// remembers (loading or unloading, say) belongs here, never into its evaluation.
template <class F>
concept HasOnAccept = requires(F& f, const Vector& u) {
  f.on_accept(u);
};

/// A residual that may change a step before it is tried: `filter_step(u, du)`.
template <class F>
concept HasStepFilter = requires(F& f, const Vector& u, Vector& du) {
  f.filter_step(u, du);
};

/// Non-owning, type-erased view of a residual and of the optional members it was found to have.
///
/// The residual must outlive the view. Cost of a call: one indirect call.
class ResidualRef {
 public:
  template <class F>
  requires(!std::same_as<std::remove_cv_t<F>, ResidualRef> &&
           Residual<F>) explicit ResidualRef(F& f)
      : object_(detail::erase(f)) {
    evaluate_ = [](void* o, const Vector& u, Vector& r) {
      return detail::outcome_of([&] { return detail::restore<F>(o)(u, r); });
    };
    if constexpr (HasJacobian<F>) {
      linearise_ = [](void* o, const Vector& u) {
        return detail::outcome_of([&] { return detail::restore<F>(o).linearise(u); });
      };
      apply_jacobian_ = [](void* o, const Vector& v, Vector& Jv) {
        return detail::outcome_of([&] { return detail::restore<F>(o).apply_jacobian(v, Jv); });
      };
    }
    if constexpr (HasReferenceNorm<F>) {
      reference_norm_ = [](void* o) {
        return static_cast<double>(detail::restore<F>(o).reference_norm());
      };
    }
    if constexpr (HasInnerProduct<F> || HasShareOut<F>) {
      inner_product_ = InnerProductRef(std::as_const(f));
    }
    if constexpr (HasGlobalSize<F>) {
      global_size_ = [](void* o) {
        return static_cast<Eigen::Index>(detail::restore<F>(o).global_size());
      };
    }
    if constexpr (HasOnAccept<F>) {
      on_accept_ = [](void* o, const Vector& u) { detail::restore<F>(o).on_accept(u); };
    }
    if constexpr (HasStepFilter<F>) {
      filter_step_ = [](void* o, const Vector& u, Vector& du) {
        detail::restore<F>(o).filter_step(u, du);
      };
    }
  }

  /// F(u) into r.
  Evaluation operator()(const Vector& u, Vector& r) const { return evaluate_(object_, u, r); }
  /// Whether the residual brings its own Jacobian action.
  [[nodiscard]] bool has_jacobian() const { return linearise_ != nullptr; }
  /// Fixes the point about which `apply_jacobian` acts; only if `has_jacobian()`.
  Evaluation linearise(const Vector& u) const { return linearise_(object_, u); }
  /// J v into Jv; only if `has_jacobian()`, after `linearise`.
  Evaluation apply_jacobian(const Vector& v, Vector& Jv) const {
    return apply_jacobian_(object_, v, Jv);
  }
  /// Whether the residual brings its own reference norm.
  [[nodiscard]] bool has_reference_norm() const { return reference_norm_ != nullptr; }
  /// The scale of the latest evaluation; only if `has_reference_norm()`.
  [[nodiscard]] double reference_norm() const { return reference_norm_(object_); }
  /// The residual's inner product, or the Euclidean one.
  [[nodiscard]] const InnerProductRef& inner_product() const { return inner_product_; }
  /// Whether the unknowns are spread over processes.
  [[nodiscard]] bool is_distributed() const { return global_size_ != nullptr; }
  /// Unknowns on all processes; `local` if the residual is not distributed.
  [[nodiscard]] Eigen::Index global_size(Eigen::Index local) const {
    return global_size_ == nullptr ? local : global_size_(object_);
  }
  /// Whether the residual wants to hear of accepted points.
  [[nodiscard]] bool has_on_accept() const { return on_accept_ != nullptr; }
  /// Tells it; only if `has_on_accept()`.
  void on_accept(const Vector& u) const { on_accept_(object_, u); }
  /// Whether the residual changes steps.
  [[nodiscard]] bool has_step_filter() const { return filter_step_ != nullptr; }
  /// Changes a step; only if `has_step_filter()`.
  void filter_step(const Vector& u, Vector& du) const { filter_step_(object_, u, du); }

 private:
  void* object_;
  Evaluation (*evaluate_)(void*, const Vector&, Vector&) = nullptr;
  Evaluation (*linearise_)(void*, const Vector&) = nullptr;
  Evaluation (*apply_jacobian_)(void*, const Vector&, Vector&) = nullptr;
  double (*reference_norm_)(void*) = nullptr;
  Eigen::Index (*global_size_)(void*) = nullptr;
  void (*on_accept_)(void*, const Vector&) = nullptr;
  void (*filter_step_)(void*, const Vector&, Vector&) = nullptr;
  InnerProductRef inner_product_;
};

}  // namespace jfnk
