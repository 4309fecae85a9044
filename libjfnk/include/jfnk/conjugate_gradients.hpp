#pragma once

#include "jfnk/gmres.hpp"

namespace jfnk {

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) with a workspace that is allocated
/// once: four vectors however many iterations, one application of A and of P in each.
///
/// For A and P that are symmetric and positive definite, as the tangent of an energy at rest is. A
/// need only be semidefinite where b is in its range. That A is not symmetric goes unnoticed, but
/// for the tolerance that is not met.
class ConjugateGradients {
 public:
  /// Allocates for n unknowns; does nothing if that was the size of the last call.
  void resize(Eigen::Index n, bool preconditioned);

  /// Reduces ||b - A x|| from x = 0; `options.restart`, `options.flexible` and
  /// `options.single_precision` have no meaning here. The end is `indefinite`, x being of the
  /// iterations before, where a direction p is met with <p, A p> <= 0 or a residual with
  /// <r, P r> <= 0.
  /// @param b  right-hand side, n; must be finite
  /// @param[out] x  result, n
  /// @throws std::invalid_argument if sizes disagree or `options` are not valid
  GmresResult solve(const OperatorRef& A, const Vector& b, Vector& x, const GmresOptions& options,
                    const PreconditionerRef& P = {}, const InnerProductRef& product = {});

  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const {
    const Eigen::Index numbers = r_.size() + p_.size() + product_.size() + image_.size();
    return static_cast<std::size_t>(numbers) * sizeof(double);
  }

 private:
  KrylovStatus advance(const OperatorRef& A, const PreconditionerRef& P,
                       const InnerProductRef& product, double& rho, double& norm, Vector& x,
                       int& iterations);

  Vector r_;
  Vector p_;
  Vector product_;  // A p
  Vector image_;    // P r
};

/// Solves A x = b once by conjugate gradients; allocates its own workspace.
template <class Op, class P = Identity>
GmresResult conjugate_gradients(Op&& A, const Vector& b, Vector& x,
                                const GmresOptions& options = {}, P&& preconditioner = {}) {
  ConjugateGradients solver;
  return solver.solve(OperatorRef(A), b, x, options, PreconditionerRef(preconditioner));
}

}  // namespace jfnk
