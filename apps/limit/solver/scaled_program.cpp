#include "limit/solver/scaled_program.hpp"

#include <algorithm>
#include <cmath>

namespace limit::solver {

ScaledProgram::ScaledProgram(const programme::ConeProgram& program)
    : cones(program.cones),
      equations(program.equations),
      column_scale(Eigen::VectorXd::Ones(program.objective.size())),
      row_scale(Eigen::VectorXd::Ones(program.equations.rows())) {
  for (std::size_t k = 0; k < cones.size(); ++k) {
    column_scale.segment<3>(3 * static_cast<Eigen::Index>(k)).setConstant(cones[k].scale);
    // The mean stress of soil without friction is in no cone: it is of the size of the loads,
    // however soft the soil.
    if (cones[k].slope == 0.0) column_scale[3 * static_cast<Eigen::Index>(k)] = 1.0;
    cones[k].strength /= cones[k].scale;
    cones[k].scale = 1.0;
  }
  equations = equations * column_scale.asDiagonal();
  equations.makeCompressed();
  for (Eigen::Index i = 0; i < equations.rows(); ++i) {
    double largest = 0.0;
    for (decltype(equations)::InnerIterator entry(equations, i); entry; ++entry) {
      largest = std::max(largest, std::abs(entry.value()));
    }
    if (largest > 0.0) row_scale[i] = 1.0 / largest;
  }
  equations = row_scale.asDiagonal() * equations;
  right_side = row_scale.cwiseProduct(program.right_side);
  cost = -column_scale.cwiseProduct(program.objective);
  start = program.start.cwiseQuotient(column_scale);
}

}  // namespace limit::solver
