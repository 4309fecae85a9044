#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

#include "jfnk/solver.hpp"

/// Vectors of other kinds than Eigen::VectorXd.
///
/// The solver computes in double precision on contiguous memory. A vector type joins by telling, in
/// a specialisation of VectorTraits, how to copy its local part out and in; residuals,
/// preconditioners and Jacobian actions are then written in terms of that type. Cost: one copy of
/// each argument and result per call.
namespace jfnk {

/// What the solver must know of a vector type V. To be specialised:
///
///   using Scalar = ...;                                  // sets the accuracy of differences
///   static Eigen::Index size(const V& v);                // of the local part
///   static V like(const V& v);                           // another vector of this kind and size
///   static void read(const V& v, Eigen::VectorXd& out);  // out has the right size
///   static void write(const Eigen::VectorXd& in, V& v);  // v has the right size
template <class V>
struct VectorTraits;

template <class T>
requires std::floating_point<T>
struct VectorTraits<std::vector<T>> {
  using Scalar = T;
  static Eigen::Index size(const std::vector<T>& v) { return static_cast<Eigen::Index>(v.size()); }
  static std::vector<T> like(const std::vector<T>& v) { return std::vector<T>(v.size()); }
  static void read(const std::vector<T>& v, Eigen::VectorXd& out) {
    out = Eigen::Map<const Eigen::Matrix<T, Eigen::Dynamic, 1>>(v.data(), size(v))
              .template cast<double>();
  }
  static void write(const Eigen::VectorXd& in, std::vector<T>& v) {
    Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, 1>>(v.data(), size(v)) = in.template cast<T>();
  }
};

template <>
struct VectorTraits<Eigen::VectorXf> {
  using Scalar = float;
  static Eigen::Index size(const Eigen::VectorXf& v) { return v.size(); }
  static Eigen::VectorXf like(const Eigen::VectorXf& v) { return Eigen::VectorXf(v.size()); }
  static void read(const Eigen::VectorXf& v, Eigen::VectorXd& out) { out = v.cast<double>(); }
  static void write(const Eigen::VectorXd& in, Eigen::VectorXf& v) { v = in.cast<float>(); }
};

/// A vector type with traits.
template <class V>
concept ForeignVector = requires(const V& v, V& w, Eigen::VectorXd& d) {
  typename VectorTraits<V>::Scalar;
  { VectorTraits<V>::size(v) } -> std::convertible_to<Eigen::Index>;
  { VectorTraits<V>::like(v) } -> std::convertible_to<V>;
  VectorTraits<V>::read(v, d);
  VectorTraits<V>::write(d, w);
};

namespace detail {

/// A residual on V, seen as one on Eigen::VectorXd, with the optional members it has.
template <class V, class F>
class ForeignResidual {
 public:
  using Traits = VectorTraits<V>;
  ForeignResidual(F& f, const V& example)
      : f_(f), in_(Traits::like(example)), out_(Traits::like(example)) {}

  Evaluation operator()(const Vector& u, Vector& r) {
    Traits::write(u, in_);
    if (Traits::size(out_) == r.size()) Traits::write(r, out_);  // full of NaN
    const Evaluation outcome = outcome_of([&] { return f_(std::as_const(in_), out_); });
    if (Traits::size(out_) != r.size()) {
      r.resize(Traits::size(out_));  // the solver names both sizes
    } else if (outcome == Evaluation::ok) {
      Traits::read(out_, r);
    }
    return outcome;
  }
  Evaluation linearise(const Vector& u) requires requires(F& f, const V& v) { f.linearise(v); }
  {
    Traits::write(u, in_);
    return outcome_of([&] { return f_.linearise(std::as_const(in_)); });
  }
  Evaluation apply_jacobian(const Vector& v, Vector& Jv) requires requires(F& f, const V& a, V& b) {
    f.apply_jacobian(a, b);
  }
  {
    Traits::write(v, in_);
    const Evaluation outcome =
        outcome_of([&] { return f_.apply_jacobian(std::as_const(in_), out_); });
    if (outcome == Evaluation::ok) Traits::read(out_, Jv);
    return outcome;
  }
  double reference_norm() const requires requires(const F& f) { f.reference_norm(); }
  { return f_.reference_norm(); }
  /// The residual's own, which then sees local parts.
  double dot(const Vector& a, const Vector& b) const requires HasInnerProduct<F> {
    return f_.dot(a, b);
  }
  Eigen::Index global_size() const requires HasGlobalSize<F> { return f_.global_size(); }
  void on_accept(const Vector& u) requires requires(F& f, const V& v) { f.on_accept(v); }
  {
    Traits::write(u, in_);
    f_.on_accept(std::as_const(in_));
  }
  void filter_step(const Vector& u, Vector& du) requires requires(F& f, const V& v, V& w) {
    f.filter_step(v, w);
  }
  {
    Traits::write(u, in_);
    Traits::write(du, out_);
    f_.filter_step(std::as_const(in_), out_);
    Traits::read(out_, du);
  }

 private:
  F& f_;
  V in_;
  V out_;
};

/// A preconditioner on V, likewise.
template <class V, class P>
class ForeignPreconditioner {
 public:
  using Traits = VectorTraits<V>;
  ForeignPreconditioner(P& p, const V& example)
      : p_(p), in_(Traits::like(example)), out_(Traits::like(example)) {}
  void apply(const Vector& r, Vector& z) {
    Traits::write(r, in_);
    p_.apply(std::as_const(in_), out_);
    Traits::read(out_, z);
  }
  void setup(const Vector& u) requires requires(P& p, const V& v) { p.setup(v); }
  {
    Traits::write(u, in_);
    p_.setup(std::as_const(in_));
  }

 private:
  P& p_;
  V in_;
  V out_;
};

}  // namespace detail

/// Finds u with F(u) = 0 for any vector type with VectorTraits: residual `f(const V&, V&)`,
/// preconditioner `apply(const V&, V&)`, optional members as in residual.hpp with V for Vector (but
/// `dot` takes two `jfnk::Vector`, the local parts).
///
/// In single precision `jacobian.noise`, unless chosen, becomes the root of its rounding unit.
/// @param[in,out] u  first guess and solution
template <ForeignVector V, class F, class P = Identity, Observer O = NoObserver>
[[nodiscard]] Report solve(F&& residual, V& u, Options options = {}, P&& preconditioner = {},
                           O&& observer = {}) {
  using Traits = VectorTraits<V>;
  if constexpr (std::same_as<typename Traits::Scalar, float>) {
    if (options.jacobian.noise == Jacobian{}.noise) {
      options.jacobian.noise =
          std::sqrt(static_cast<double>(std::numeric_limits<float>::epsilon()));
    }
  }
  Vector values(Traits::size(u));
  Traits::read(u, values);
  detail::ForeignResidual<V, std::remove_reference_t<F>> f(residual, u);
  Report report = [&] {
    if constexpr (std::same_as<std::remove_cvref_t<P>, Identity>) {
      return solve(f, values, options, Identity{}, observer);
    } else {
      detail::ForeignPreconditioner<V, std::remove_reference_t<P>> p(preconditioner, u);
      return solve(f, values, options, p, observer);
    }
  }();
  if (!report.history.empty()) Traits::write(values, u);
  return report;
}

}  // namespace jfnk
