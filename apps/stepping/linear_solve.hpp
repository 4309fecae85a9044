#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>

#include "jfnk/conjugate_gradients.hpp"

namespace equilibrium {
template <int Dim>
class Equilibrium;
}

namespace stepping {

/// What a linear solve is to reach, and what it may cost.
struct LinearSolveOptions {
  double tolerance = 1e-3;  // of the residual, times the equilibrium's reference norm
  double rounding = 0.0;    // [N/m or N] residuals that count as none
  int max_actions = 200;    // of the tangent, in all
};

/// What it came to.
struct LinearSolveResult {
  bool converged = false;
  bool stopped = false;    // as asked to be
  int actions = 0;         // of the tangent
  int evaluations = 0;     // of the residual
  double norm = 0.0;       // [N/m or N] of the last residual
  double reference = 0.0;  // [N/m or N] of its equilibrium
};

/// The increment of a step whose equilibrium is linear: by conjugate gradients, as tangents of
/// elastic bodies are symmetric, and without the vectors that others learn from. Tangents are in
/// single precision: what they leave of the true residual is solved for again.
template <int Dim>
class LinearSolve {
 public:
  /// @param P  of the tangent, symmetric; the identity by default
  /// @param[in,out] u  first guess, its prescribed unknowns being those of the increment; the
  ///                   increment, or the nearest that was come to. If the result has converged,
  ///                   the equilibrium's last evaluation is the one at it
  /// @param go_on  asked before each action
  LinearSolveResult operator()(equilibrium::Equilibrium<Dim>& equilibrium,
                               const jfnk::PreconditionerRef& P, const LinearSolveOptions& options,
                               Eigen::VectorXd& u, const std::function<bool()>& go_on);

  /// Memory of the vectors held [bytes].
  [[nodiscard]] std::size_t bytes() const;
  /// The same once n unknowns have been solved for.
  [[nodiscard]] static std::size_t bytes_to_come(Eigen::Index n, bool preconditioned);

 private:
  jfnk::ConjugateGradients krylov_;
  Eigen::VectorXd rest_;        // the residual, or what is solved for
  Eigen::VectorXd correction_;  // of the increment
};

}  // namespace stepping
