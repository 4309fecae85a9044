#pragma once

#include <Eigen/Core>
#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace jfnk {

/// The vector of unknowns and of residuals.
using Vector = Eigen::VectorXd;

/// What a residual says about one evaluation.
enum class Evaluation {
  ok,             ///< `r` holds F(u)
  out_of_domain,  ///< F cannot be evaluated at this u; recoverable, `r` is ignored
  stop            ///< give up the whole solve now; `r` is ignored
};

namespace detail {

template <class R>
inline constexpr bool is_outcome =
    std::is_void_v<R> || std::same_as<R, bool> || std::same_as<R, Evaluation>;

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
/// `r` arrives with the size of `u` and must keep it. A NaN or an infinity in `r` counts as
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

/// A residual with its own inner product, as vectors spread over processes need.
template <class F>
concept HasInnerProduct = requires(const F& f, const Vector& a, const Vector& b) {
  { f.dot(a, b) } -> std::convertible_to<double>;
};

/// Non-owning view of an inner product; the Euclidean one when default constructed.
class InnerProductRef {
 public:
  InnerProductRef() = default;
  template <HasInnerProduct F>
  explicit InnerProductRef(const F& f)
      : object_(std::addressof(f)), dot_([](const void* o, const Vector& a, const Vector& b) {
          return static_cast<double>(static_cast<const F*>(o)->dot(a, b));
        }) {}

  /// <a, b>. Cost: one pass over both.
  [[nodiscard]] double dot(const Vector& a, const Vector& b) const {
    return dot_ == nullptr ? a.dot(b) : dot_(object_, a, b);
  }
  /// sqrt(<a, a>), free of overflow and underflow for the Euclidean product.
  [[nodiscard]] double norm(const Vector& a) const;

 private:
  const void* object_ = nullptr;
  double (*dot_)(const void*, const Vector&, const Vector&) = nullptr;
};

/// Non-owning, type-erased view of a residual and of the optional members it was found to have.
///
/// The residual must outlive the view. Cost of a call: one indirect call.
class ResidualRef {
 public:
  template <class F>
  requires(!std::same_as<std::remove_cv_t<F>, ResidualRef> &&
           Residual<F>) explicit ResidualRef(F& f)
      : object_(erase(f)) {
    evaluate_ = [](void* o, const Vector& u, Vector& r) {
      return detail::outcome_of([&] { return restore<F>(o)(u, r); });
    };
    if constexpr (HasJacobian<F>) {
      linearise_ = [](void* o, const Vector& u) {
        return detail::outcome_of([&] { return restore<F>(o).linearise(u); });
      };
      apply_jacobian_ = [](void* o, const Vector& v, Vector& Jv) {
        return detail::outcome_of([&] { return restore<F>(o).apply_jacobian(v, Jv); });
      };
    }
    if constexpr (HasReferenceNorm<F>) {
      reference_norm_ = [](void* o) { return static_cast<double>(restore<F>(o).reference_norm()); };
    }
    if constexpr (HasInnerProduct<F>) inner_product_ = InnerProductRef(std::as_const(f));
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

 private:
  template <class F>
  static void* erase(F& f) {
    return const_cast<void*>(static_cast<const void*>(std::addressof(f)));
  }
  template <class F>
  static F& restore(void* o) {
    return *static_cast<F*>(o);
  }

  void* object_;
  Evaluation (*evaluate_)(void*, const Vector&, Vector&) = nullptr;
  Evaluation (*linearise_)(void*, const Vector&) = nullptr;
  Evaluation (*apply_jacobian_)(void*, const Vector&, Vector&) = nullptr;
  double (*reference_norm_)(void*) = nullptr;
  InnerProductRef inner_product_;
};

}  // namespace jfnk
