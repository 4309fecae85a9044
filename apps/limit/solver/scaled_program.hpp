#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "limit/programme/cone_program.hpp"

namespace limit::solver {

/// A cone program with the variables of each cone in units of its scale and a largest coefficient
/// of one in every equation: minimise cost' x subject to equations x = right_side.
struct ScaledProgram {
  explicit ScaledProgram(const programme::ConeProgram& program);

  std::vector<programme::YieldCone> cones;  // of scale 1
  Eigen::SparseMatrix<double, Eigen::RowMajor> equations;
  Eigen::VectorXd right_side, cost, start;
  Eigen::VectorXd column_scale, row_scale;

  /// In the units of the program.
  [[nodiscard]] Eigen::VectorXd variables(const Eigen::VectorXd& scaled) const {
    return column_scale.cwiseProduct(scaled);
  }
  [[nodiscard]] Eigen::VectorXd multipliers(const Eigen::VectorXd& scaled) const {
    return row_scale.cwiseProduct(scaled);
  }
};

}  // namespace limit::solver
