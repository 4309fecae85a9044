#pragma once

#include <Eigen/LU>
#include <memory>
#include <vector>

#include "limit/solver/augmented_system.hpp"
#include "limit/solver/refinement.hpp"
#include "limit/solver/scaled_program.hpp"
#include "limit/solver/second_order_cone.hpp"
#include "limit/solver/sparse_factors.hpp"

namespace limit::solver {

/// The Newton systems of an interior-point method on a cone program,
///   H x + A' y = first,  A x = second,
/// where A are the equations and H, one 3 x 3 block per cone, its curvature (none in free
/// variables, nor in the mean stress of frictionless soil). H is eliminated, and A H^-1 A', sparse
/// and positive definite, factorised: a fraction of the size of what Ipopt factorises, without
/// pivoting. The free variables, and the mean stress of soil of little friction, whose curvature
/// falls with the friction squared, get a little curvature, which iterative refinement takes out
/// again. A free variable in very many equations, such as the multiplier of a weight, would fill
/// that matrix: it stays outside, as a border. Once that matrix has lost the digits that the
/// equations need, the system is factorised as it is (AugmentedSystem).
class ConeSystem {
 public:
  explicit ConeSystem(const ScaledProgram& program);

  /// One scaling per cone, which must live as long as the factors are used. False if there are no
  /// factors.
  [[nodiscard]] bool factorise(const std::vector<second_order_cone::Scaling>& scalings);

  using Solution = NewtonSolution;
  /// @param must_hold  the equations, to rounding, whatever it costs
  [[nodiscard]] Solution solve(const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                               bool must_hold);
  /// Of its factors, so far (SparseFactors).
  [[nodiscard]] double work() const {
    return factors_->work() + (augmented_ ? augmented_->work() : 0.0);
  }

 private:
  [[nodiscard]] bool condense(const std::vector<second_order_cone::Scaling>& scalings);
  [[nodiscard]] bool switch_to_augmented();
  void solve_border();
  void gather_blocks();
  void set_border_apart();
  void find_entries();
  [[nodiscard]] Solution solve_refined(const Eigen::VectorXd& first,
                                       const Eigen::VectorXd& second) const;
  // Without the border.
  [[nodiscard]] Eigen::VectorXd multipliers(const Eigen::VectorXd& first,
                                            const Eigen::VectorXd& second) const;
  [[nodiscard]] Solution solve_once(const Eigen::VectorXd& first,
                                    const Eigen::VectorXd& second) const;
  [[nodiscard]] Solution left(const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                              const Solution& at) const;
  [[nodiscard]] Eigen::VectorXd curve(const Eigen::VectorXd& x) const;  // H x
  [[nodiscard]] Eigen::VectorXd stiffness() const;                      // 1 + the diagonal of H
  // (H + little)^-1 x, 0 in the border.
  [[nodiscard]] Eigen::VectorXd uncurve(const Eigen::VectorXd& x) const;

  const ScaledProgram& program_;
  std::vector<ConeBlock> blocks_;
  // The border: its variables, their columns D, M^-1 D with the matrix M within, and D' M^-1 D.
  std::vector<Eigen::Index> border_;
  Eigen::MatrixXd border_columns_, border_solved_;
  Eigen::PartialPivLU<Eigen::MatrixXd> border_part_;
  std::vector<Eigen::Matrix3d> curvature_, inverse_;
  std::vector<std::size_t> diagonal_;
  std::vector<double> values_;
  std::unique_ptr<SparseFactors> factors_;
  const std::vector<second_order_cone::Scaling>* scalings_ = nullptr;
  std::unique_ptr<AugmentedSystem> augmented_;
};

}  // namespace limit::solver
