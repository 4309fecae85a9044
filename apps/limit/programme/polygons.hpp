#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"

namespace limit::programme {

/// A bound on the radius of Mohr's circle that is linear in its centre, tension positive:
/// radius <= strength - slope p, as that of Mohr and Coulomb.
struct Line {
  double strength = 0.0, slope = 0.0;
};

/// Whether a polygon stands for a curved envelope from within or around it.
enum class Polygon { chords, tangents };

/// Where in the envelopes the stresses of a solution lay, and by which polygons the next one is to
/// be found: fine ones there, coarse ones away from there.
class Polygons {
 public:
  /// The lines of a soil at a place, the one for where its stress is expected first.
  /// @param guess  the pressure there, if none is known, compression positive
  [[nodiscard]] std::vector<Line> lines(const problem::Soil& soil, const CurvedPoint& point,
                                        double guess, Polygon kind) const;

  /// Learns the stresses of a program's solution; polygons become finer.
  void take(const std::vector<CurvedPoint>& points, const Eigen::VectorXd& variables);

 private:
  struct Known {
    mesh::Point place;
    double pressure;
  };
  [[nodiscard]] std::optional<double> pressure_near(const CurvedPoint& point) const;

  std::map<std::pair<int, bool>, std::vector<Known>> known_;  // of a region's kind, each by x
  double ratio_ = 12.0;  // of one corner's distance from the apex to the next one's
};

/// A tenth of the way from one place to another.
[[nodiscard]] mesh::Point towards(const mesh::Point& from, const mesh::Point& to);

}  // namespace limit::programme
