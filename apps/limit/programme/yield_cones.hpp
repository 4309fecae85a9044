#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "limit/problem/problem.hpp"
#include "limit/programme/cone_program.hpp"

namespace limit::programme {

/// A rough guess of the compressive vertical stress, for scales and starts: the weight up to the
/// surface above, and the largest compressive stress prescribed on the outline. A live weight is
/// taken to grow until a vertical cut as high as the body would fail, gamma H = 4 c tan(45 +
/// phi/2), or, if the multiplier ends somewhere, to a small part of that.
class Overburden {
 public:
  explicit Overburden(const problem::Problem& problem);
  [[nodiscard]] double at(const problem::Soil& soil, const mesh::Point& place) const;

 private:
  // The highest point of the outline over a place, its face where that is inclined.
  [[nodiscard]] double surface_above(const mesh::Point& place) const;

  std::vector<std::pair<mesh::Point, mesh::Point>> outline_;  // each piece from left to right
  double top_ = 0.0, bottom_ = 0.0;
  double load_ = 0.0;
  std::optional<double> multiplier_;  // of live loads
};

/// The soil's cone, scaled by its strength under the compressive stress `overburden`; it lies
/// inside the true one by at least the fraction `reserve` of the local strength, or of the
/// cohesion's.
[[nodiscard]] YieldCone yield_cone(const problem::Soil& soil, double overburden, double reserve);

/// Rankine's cone, no principal stress above the soil's tension, for a second copy of a stress that
/// is in the soil's own cone; p + sqrt(d^2 + t^2) <= tension less `reserve`, as above.
[[nodiscard]] YieldCone tension_cone(const problem::Soil& soil, double overburden, double reserve);

/// The cone whose variable p is a normal stress across a contact that bears no tension, p <= 0 less
/// the fraction `reserve` of the scale, a stress typical of the place. Nothing else may name its d
/// and t: what remains of it is one-dimensional.
[[nodiscard]] YieldCone contact_cone(double scale, double reserve);

/// The cone whose variable p is not positive; the others stay out of it, too.
/// @param scale  typical of the variable, > 0
[[nodiscard]] YieldCone half_line_cone(double scale);

/// (p, d, t) of an isotropic stress strictly inside the cone.
[[nodiscard]] Eigen::Vector3d inner_point(const YieldCone& cone, double overburden);

}  // namespace limit::programme
