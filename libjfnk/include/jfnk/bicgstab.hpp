#pragma once

#include "jfnk/gmres.hpp"

namespace jfnk {

/// Right-preconditioned BiCGStab (van der Vorst 1992) with a workspace that is allocated once:
/// seven vectors however many iterations, two applications of A and of P in each.
///
/// For systems whose Krylov space does not fit into memory. Its residual may jump; the iterate of
/// the lowest one met is returned.
class BiCGStab {
 public:
  /// Allocates for n unknowns; does nothing if that was the size of the last call.
  void resize(Eigen::Index n, bool preconditioned);

  /// Reduces ||b - A x|| from x = 0; `options.restart` and `options.flexible` have no meaning here,
  /// `options.max_iterations` bounds the applications of A.
  /// @param b  right-hand side, n; must be finite
  /// @param[out] x  result, n
  /// @throws std::invalid_argument if sizes disagree or `options` are not valid
  GmresResult solve(const OperatorRef& A, const Vector& b, Vector& x, const GmresOptions& options,
                    const PreconditionerRef& P = {}, const InnerProductRef& product = {});

  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const {
    const Eigen::Index numbers = r_.size() + shadow_.size() + p_.size() + v_.size() + t_.size() +
                                 image_.size() + best_.size();
    return static_cast<std::size_t>(numbers) * sizeof(double);
  }

 private:
  KrylovStatus iterate(const OperatorRef& A, const PreconditionerRef& P,
                       const InnerProductRef& product, double target, double rho, double& alpha,
                       double& omega, Vector& x, GmresResult& result);

  Vector r_;
  Vector shadow_;
  Vector p_;
  Vector v_;
  Vector t_;
  Vector image_;
  Vector best_;
  double lowest_ = 0.0;
};

/// Solves A x = b once by BiCGStab; allocates its own workspace.
template <class Op, class P = Identity>
GmresResult bicgstab(Op&& A, const Vector& b, Vector& x, const GmresOptions& options = {},
                     P&& preconditioner = {}) {
  BiCGStab solver;
  return solver.solve(OperatorRef(A), b, x, options, PreconditionerRef(preconditioner));
}

}  // namespace jfnk
