#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <utility>
#include <vector>

#include "limit/mesh/mesh.hpp"

namespace limit::programme {

/// Mohr-Coulomb in plane strain for the mean stress p, half the difference d of the normal stresses
/// and the shear stress t: d^2 + t^2 <= (strength - slope p)^2, strength >= slope p.
struct YieldCone {
  double strength = 0.0;  // c cos(phi)
  double slope = 0.0;     // sin(phi)
  double scale = 1.0;     // a stress typical of the place, > 0
};

/// A stress in a soil of a curved envelope, for which a parabola stands, and where it is.
struct CurvedPoint {
  Eigen::Index variable = 0;  // the first of its cone
  int region = 0;
  bool is_jump = false;
  mesh::Point place{0.0, 0.0};  // a little within its triangle or side, where no other one is
};

/// Maximise objective' x subject to equations x = right_side, variables (3k, 3k+1, 3k+2) = (p, d,
/// t) in cone k, and the remaining variables free. Both bounds are of this form.
struct ConeProgram {
  std::vector<YieldCone> cones;
  Eigen::SparseMatrix<double, Eigen::RowMajor> equations;
  Eigen::VectorXd right_side;
  Eigen::VectorXd objective;
  Eigen::VectorXd start;  // strictly inside every cone
  std::vector<CurvedPoint> curved;
  std::vector<std::pair<std::size_t, std::size_t>> twins;  // a curved point's cone, its deviator's
};

}  // namespace limit::programme
