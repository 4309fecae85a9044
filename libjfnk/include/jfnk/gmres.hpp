#pragma once

#include <limits>
#include <string>
#include <vector>

#include "jfnk/column_store.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/residual.hpp"

namespace jfnk {

/// How a linear solve ended. In every case x holds the best iterate of the Krylov space.
enum class KrylovStatus {
  converged,        ///< ||b - A x|| met the tolerance
  max_iterations,   ///< the iteration cap was met first
  stagnated,        ///< a whole restart cycle reduced the residual by less than 0.1 %
  breakdown,        ///< the Krylov space is exhausted (singular A) above the tolerance
  indefinite,       ///< A or P is not positive definite (conjugate gradients)
  operator_failed,  ///< A could not be applied, or gave NaN; x is of the iterations before
  stopped           ///< A asked to stop; x is of the iterations before
};

/// Size and end of a linear solve.
struct GmresOptions {
  /// Columns kept before a restart; memory is restart + 1 vectors (twice that if flexible).
  /// Range [1, inf); Saad & Schultz 1986.
  int restart = 60;
  /// Upper bound on applications of A. Range [1, inf).
  int max_iterations = 60;
  /// Stop when ||b - A x|| <= relative_tolerance ||b||. Range [0, 1).
  double relative_tolerance = 1e-8;
  /// Stop when ||b - A x|| <= absolute_tolerance. Unit of b, range [0, inf).
  double absolute_tolerance = 0.0;
  /// Store the preconditioned vectors so that P may vary from call to call (Saad 1993); otherwise
  /// P is applied once more at the end of each cycle.
  bool flexible = false;
  /// Keep the columns in single precision, in half the memory; x, b and what is orthogonalised are
  /// in double precision. For relative tolerances of 1e-5 and looser.
  bool single_precision = false;
  /// Unknowns on all processes together, for a distributed A; 0: those of b.
  Eigen::Index global_size = 0;
};

/// All that is wrong with `options`, one sentence each; empty if usable.
[[nodiscard]] std::vector<std::string> validate(const GmresOptions& options);

/// Result of a linear solve.
struct GmresResult {
  KrylovStatus status = KrylovStatus::converged;
  int iterations = 0;              ///< columns built, over all cycles
  double residual_norm = 0.0;      ///< ||b - A x|| by the Arnoldi recurrence
  double relative_residual = 0.0;  ///< the same over ||b||; 0 if b = 0
};

/// Non-owning view of a linear operator `op(v, Av)` that returns void, bool or Evaluation.
class OperatorRef {
 public:
  template <class Op>
  requires(!std::same_as<std::remove_cv_t<Op>, OperatorRef> &&
           Residual<Op>) explicit OperatorRef(Op& op)
      : object_(detail::erase(op)), apply_([](void* o, const Vector& v, Vector& Av) {
          return detail::outcome_of([&] { return detail::restore<Op>(o)(v, Av); });
        }) {}

  /// A v into Av.
  Evaluation operator()(const Vector& v, Vector& Av) const { return apply_(object_, v, Av); }

 private:
  void* object_;
  Evaluation (*apply_)(void*, const Vector&, Vector&);
};

/// Right-preconditioned restarted GMRES with a workspace that grows as columns are built.
///
/// Arnoldi by classical Gram-Schmidt, repeated where cancellation asks for it, so that the inner
/// products of an iteration are one sum, mostly; least squares by Givens rotations. The residual
/// after a restart comes from the Arnoldi relation, so A is applied `iterations` times and never
/// more (once more if the first guess is not zero).
class Gmres {
 public:
  /// For n unknowns; what the last call left is kept if the sizes are the same.
  void resize(Eigen::Index n, const GmresOptions& options, bool preconditioned);

  /// Reduces ||b - A x|| from the given x. Allocates a vector for each column never reached before.
  /// @param b  right-hand side, n; must be finite
  /// @param[in,out] x  first guess and result, n
  /// @throws std::invalid_argument if sizes disagree or `options` are not valid
  GmresResult solve(const OperatorRef& A, const Vector& b, Vector& x, const GmresOptions& options,
                    const PreconditionerRef& P = {}, const InnerProductRef& product = {});

  /// Whether the last `solve` was a single cycle from x = 0, so that `shorten` knows its space.
  [[nodiscard]] bool can_shorten() const { return can_shorten_; }
  /// Length of the last solution in the Krylov space, ||P^-1 x||; only if `can_shorten()`.
  [[nodiscard]] double length() const { return length_; }
  /// x on the dogleg path of the last solve at ||P^-1 x|| = length: from the steepest descent of
  /// ||b - A x|| to its solution, both in the Krylov space (Powell 1970). Applies P once unless it
  /// is stored, never A. No allocation.
  /// @return ||b - A x|| there, by the Arnoldi relation
  double shorten(double length, const PreconditionerRef& P, Vector& x,
                 const InnerProductRef& product = {});

  /// Hands out the space of the last solve as A Z = Q R: `take(z, q, r)` is called for each column,
  /// q being the columns of Q up to this one and r that of R down to its diagonal, until it returns
  /// false. Applies P to every column unless that is stored. The space is used up. Only if
  /// `can_shorten()`.
  template <class Take>
  void hand_out_space(const PreconditionerRef& P, Take&& take) {
    can_shorten_ = false;
    basis_.copy_to(0, work_);
    for (int j = 0; j < columns_; ++j) {
      rotate_basis(j);
      const Vector& z = column_of_space(j, P);
      if (!take(z, first_of(basis_, j + 1), triangle_.col(j).head(j + 1))) break;
      work_.swap(next_);
    }
  }

  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const;

  /// Applications of the preconditioner by the last `solve`.
  [[nodiscard]] int preconditioner_applications() const { return preconditioner_applications_; }

 private:
  struct Cycle {
    int columns = 0;
    bool ended = false;
    KrylovStatus status = KrylovStatus::max_iterations;
  };

  Cycle run_cycle(const OperatorRef& A, const PreconditionerRef& P, const InnerProductRef& product,
                  const GmresOptions& options, int allowed, double target);
  double orthogonalise(int k, const InnerProductRef& product, double& before);
  const detail::ColumnList& first_of(const detail::ColumnStore& store, int count);
  void rotate_column(int k, double subdiagonal);
  const Vector& column_of_space(int j, const PreconditionerRef& P);
  void rotate_basis(int j);
  void solve_triangle(int columns);
  void add_combination(int columns, const Eigen::VectorXd& coefficients, const PreconditionerRef& P,
                       const InnerProductRef& product, Vector& x);
  void residual_from_recurrence(int columns, const InnerProductRef& product);

  detail::ColumnStore basis_;
  detail::ColumnStore preconditioned_;
  Vector work_;
  Vector direction_;
  Vector next_;  // the residual before a cycle, the next column within
  Eigen::MatrixXd triangle_;
  Eigen::VectorXd cosines_;
  Eigen::VectorXd sines_;
  Eigen::VectorXd rhs_;
  Eigen::VectorXd coefficients_;
  Eigen::VectorXd descent_;
  Eigen::VectorXd path_;
  Eigen::VectorXd sums_;
  detail::ColumnList list_;  // the columns that an operation is about
  int columns_ = 0;          // of the last cycle
  bool flexible_ = false;
  bool can_shorten_ = false;
  double length_ = 0.0;
  double residual_norm_ = 0.0;
  int preconditioner_applications_ = 0;
};

/// Solves A x = b once; allocates its own workspace. See `Gmres::solve`.
template <class Op, class P = Identity>
GmresResult gmres(Op&& A, const Vector& b, Vector& x, const GmresOptions& options = {},
                  P&& preconditioner = {}) {
  Gmres solver;
  return solver.solve(OperatorRef(A), b, x, options, PreconditionerRef(preconditioner));
}

}  // namespace jfnk
