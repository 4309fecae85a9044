#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "limit/mesh/mesh.hpp"
#include "limit/problem/local_soil.hpp"
#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"

namespace limit::programme {

/// A bound on the radius of Mohr's circle in its centre p, tension positive: (radius + shift)^2 <=
/// (touching + shift)^2 - 2 (touching + shift) sine (p + centre), that of a curved envelope at the
/// pressure `centre`, and of its slope there.
struct Parabola {
  double shift = 0.0, centre = 0.0, touching = 0.0, sine = 0.0;
};

/// Where in the envelopes the stresses of a solution lay: what stands for them the next time is
/// true there, and less so away from there.
class Parabolas {
 public:
  /// Of a soil at a place. The lower bound's lies within the envelope: the square of the envelope's
  /// radius, with the shift, is convex in its centre. The upper bound's is as close as a parabola
  /// can be.
  /// @param guess  the pressure there, if none is known, compression positive
  [[nodiscard]] Parabola at(const problem::Soil& soil, const CurvedPoint& point, double guess,
                            problem::Bound bound) const;

  /// Learns the stresses of a program's solution.
  void take(const std::vector<CurvedPoint>& points, const Eigen::VectorXd& variables);

 private:
  struct Known {
    mesh::Point place;
    double pressure;
  };
  [[nodiscard]] std::optional<double> pressure_near(const CurvedPoint& point) const;

  std::map<std::pair<int, bool>, std::vector<Known>> known_;  // of a region's kind, each by x
};

/// The shift with which the square of an envelope's radius is as near to straight at u as can be,
/// d(R sin(phi)) / -d(sin(phi)).
[[nodiscard]] double straightening_shift(const problem::Envelope& envelope, double u);

/// The least of these, as far as slopes are steeper than 80 degrees on one end, and next to nothing
/// on the other: with it, and with any less, that square is convex.
[[nodiscard]] double convex_shift(const problem::Envelope& envelope);

/// A tenth of the way from one place to another.
[[nodiscard]] mesh::Point towards(const mesh::Point& from, const mesh::Point& to);

}  // namespace limit::programme
