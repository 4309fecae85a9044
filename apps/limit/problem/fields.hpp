#pragma once

#include <Eigen/Core>
#include <vector>

namespace limit::problem {

/// Stress (rows xx, yy, xy; tension positive) at the three corners of each triangle, linear between
/// them; neighbours have corners of their own.
using StressField = std::vector<Eigen::Matrix3d>;

/// Velocities of each triangle's corners and middles of the sides 01 12 20 (columns), quadratic
/// within it; neighbours, supports and the footing have velocities of their own. And the footing's
/// three motions.
struct VelocityField {
  std::vector<Eigen::Matrix<double, 2, 6>> triangles;
  Eigen::Vector3d footing;
};

}  // namespace limit::problem
