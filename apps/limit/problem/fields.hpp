#pragma once

#include <Eigen/Core>
#include <vector>

namespace limit::problem {

/// Stress (rows xx, yy, xy; tension positive) at the three corners of a triangle, linear between
/// them; where the weight is linear and the stress quadratic, its Bezier points: the corners' and
/// those of the middles of the sides 01 12 20, which lie on no stress but bound them all.
using StressTriangle = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 6>;

/// Of each triangle; neighbours have corners of their own.
using StressField = std::vector<StressTriangle>;

/// Velocities of each triangle's corners and middles of the sides 01 12 20 (columns), quadratic
/// within it; neighbours, supports and the footing have velocities of their own. And the footing's
/// three motions.
struct VelocityField {
  std::vector<Eigen::Matrix<double, 2, 6>> triangles;
  Eigen::Vector3d footing;
};

}  // namespace limit::problem
