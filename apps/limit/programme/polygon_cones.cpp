#include "limit/programme/polygon_cones.hpp"

#include <algorithm>

namespace limit::programme {

void PolygonCones::add(const std::vector<Line>& lines, const CurvedPoint& point, double overburden,
                       double reserve) {
  std::vector<Line> held = lines;
  for (Line& line : held) line.strength -= reserve * (lines[0].strength + line.slope * overburden);
  const double radius = held[0].strength + held[0].slope * overburden;
  Stress stress{point, {held.begin() + 1, held.end()}};
  stress.point.variable = 3 * static_cast<Eigen::Index>(cones_.size());
  stresses_.push_back(std::move(stress));
  constexpr double least = 1e-6;
  cones_.push_back({held[0].strength, held[0].slope, std::max(radius, least)});
  starts_.push_back(inner_point(cones_.back(), overburden));
}

void PolygonCones::add_others() {
  const auto next = [&] { return 3 * static_cast<Eigen::Index>(cones_.size()); };
  for (Stress& stress : stresses_) {
    const double scale = cones_[static_cast<std::size_t>(stress.point.variable / 3)].scale;
    stress.radius = next();
    for (std::size_t i = 0; i <= stress.others.size(); ++i) {
      cones_.push_back(half_line_cone(scale));
      starts_.push_back(inner_point(cones_.back(), 0.0));
    }
  }
}

void PolygonCones::equations(const std::function<void(double)>& begin,
                             const std::function<void(Eigen::Index, double)>& add) const {
  for (const Stress& stress : stresses_) {
    const Eigen::Index own = stress.point.variable;
    for (const Eigen::Index i : {1, 2}) {
      begin(0.0);
      add(own + i, 1.0);
      add(stress.radius + i, -1.0);
    }
    // The first variable of the radius' cone is -r, that of a half-line r + slope p - strength.
    Eigen::Index variable = stress.radius;
    for (const Line& line : stress.others) {
      begin(-line.strength);
      add(variable += 3, 1.0);
      add(stress.radius, 1.0);
      add(own, -line.slope);
    }
  }
}

void PolygonCones::tell(ConeProgram& program) const {
  for (const Stress& stress : stresses_) {
    program.curved.push_back(stress.point);
    program.twins.emplace_back(static_cast<std::size_t>(stress.point.variable / 3),
                               static_cast<std::size_t>(stress.radius / 3));
  }
}

}  // namespace limit::programme
