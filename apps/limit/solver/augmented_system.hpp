#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "limit/solver/refinement.hpp"
#include "limit/solver/scaled_program.hpp"
#include "limit/solver/second_order_cone.hpp"
#include "limit/solver/sparse_factors.hpp"

namespace limit::solver {

/// The equations of one cone's variables (or of one free variable), dense.
struct ConeBlock {
  Eigen::Index first = 0;
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd coefficients;
  std::vector<std::size_t> entries;  // where their products go, lower triangle row by row
};

/// Diagonal of G, where (strength, 0, 0) - G (p, d, t) must lie in the second-order cone.
[[nodiscard]] inline Eigen::Vector3d slack_form(const programme::YieldCone& cone) {
  return {cone.slope, 1.0, 1.0};
}

/// The Newton systems of a ConeSystem as they are, not condensed to A H^-1 A', which squares what
/// range the stiffnesses have: with x = T v and T T' = H^-1,
///   v + T' A' y = T' first,  A T v = second,
/// and what is free as it is. Keeps its digits where soils differ by a million in strength; costs
/// some times as much.
class AugmentedSystem {
 public:
  /// @param blocks  of the cones, in their order, and of those free variables that are in it
  AugmentedSystem(const ScaledProgram& program, const std::vector<ConeBlock>& blocks);

  [[nodiscard]] bool factorise(const std::vector<second_order_cone::Scaling>& scalings);
  /// Zero for the free variables that are not in it.
  [[nodiscard]] NewtonSolution solve(const Eigen::VectorXd& first,
                                     const Eigen::VectorXd& second) const;
  [[nodiscard]] double work() const { return factors_->work(); }

 private:
  const ScaledProgram& program_;
  const std::vector<ConeBlock>& blocks_;
  std::vector<Eigen::Matrix3d> roots_;  // T
  std::vector<double> values_;
  std::unique_ptr<SparseFactors> factors_;
};

}  // namespace limit::solver
