#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "limit/programme/polygons.hpp"
#include "limit/programme/yield_cones.hpp"

namespace limit::programme {

/// The cones of the stresses in soil of curved envelopes: Mohr and Coulomb's of the polygon's first
/// line for (p, d, t); once for all of its other lines, (d, t) again in the cone of a radius r,
/// |(d, t)| <= r, and a half-line for each of them, r <= strength - slope p.
class PolygonCones {
 public:
  /// Half-lines and radii go to the end of these, which must outlive this.
  PolygonCones(std::vector<YieldCone>& cones, std::vector<Eigen::Vector3d>& starts)
      : cones_(cones), starts_(starts) {}

  /// The cone of the first line, the last one of all.
  void add(const std::vector<Line>& lines, const CurvedPoint& point, double overburden,
           double reserve);
  /// Those of the other lines, once all stresses have theirs.
  void add_others();
  /// Their equations, by what begins one with a right side and adds a coefficient to it.
  void equations(const std::function<void(double)>& begin,
                 const std::function<void(Eigen::Index, double)>& add) const;
  void tell(ConeProgram& program) const;

 private:
  struct Stress {
    CurvedPoint point;
    std::vector<Line> others;
    Eigen::Index radius = 0;  // first variable of its cone
  };
  std::vector<YieldCone>& cones_;
  std::vector<Eigen::Vector3d>& starts_;
  std::vector<Stress> stresses_;
};

}  // namespace limit::programme
