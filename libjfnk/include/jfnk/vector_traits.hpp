#pragma once

#include <Eigen/Core>
#include <cmath>
#include <concepts>
#include <limits>
#include <vector>

#include "jfnk/preconditioner.hpp"
#include "jfnk/residual.hpp"

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

/// Vectors of Eigen's, of fixed or dynamic size.
template <class T, int Rows, int Options, int MaxRows>
requires std::floating_point<T>
struct VectorTraits<Eigen::Matrix<T, Rows, 1, Options, MaxRows, 1>> {
  using Scalar = T;
  using V = Eigen::Matrix<T, Rows, 1, Options, MaxRows, 1>;
  static Eigen::Index size(const V& v) { return v.size(); }
  static V like(const V& v) { return V(v.size()); }
  static void read(const V& v, Eigen::VectorXd& out) { out = v.template cast<double>(); }
  static void write(const Eigen::VectorXd& in, V& v) { v = in.template cast<T>(); }
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

/// A residual or preconditioner on another type than Vector: V's, of doubles or not.
template <class V>
inline constexpr double rounding_of =
    std::numeric_limits<typename VectorTraits<V>::Scalar>::epsilon();

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
  void dots(Vectors columns, const Vector& w, std::span<double> sums) const requires HasDots<F> {
    f_.dots(columns, w, sums);
  }
  void dots(SingleVectors columns, const Vector& w,
            std::span<double> sums) const requires HasSingleDots<F> {
    f_.dots(columns, w, sums);
  }
  void share_out(Eigen::Index n, Eigen::Index numbers,
                 BlockWork work) const requires HasShareOut<F> {
    f_.share_out(n, numbers, work);
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
    apply_preconditioner(p_, std::as_const(in_), out_);
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

}  // namespace jfnk
