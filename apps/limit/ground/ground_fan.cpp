#include "limit/ground/ground_fan.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace limit::ground {

namespace {

constexpr double pi = std::numbers::pi;

// Direction of a vector in [0, 2 pi), counterclockwise from another one.
double angle_from(const mesh::Point& from, const mesh::Point& to) {
  const double angle = std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
  return angle < 0.0 ? angle + 2.0 * pi : angle;
}

// A corner of the outline, and where the outline comes from and goes to.
struct Corner {
  const GroundSegment* before = nullptr;
  const GroundSegment* after = nullptr;

  [[nodiscard]] bool is_there() const { return before != nullptr && after != nullptr; }
  [[nodiscard]] double angle(const GroundOutline& outline) const {
    const mesh::Point& here = outline.at(after->first);
    return angle_from(outline.at(after->second) - here, outline.at(before->first) - here);
  }
};

Corner corner_at(const GroundOutline& outline, int point) {
  Corner corner;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    if (segment.second == point) corner.before = &segment;
    if (segment.first == point) corner.after = &segment;
  }
  return corner;
}

// What a side says of the stress (xx, yy, xy) in each of its ends: its normal and its shear
// component, where these are given; columns of the values: given, and per unit of the multiplier.
struct GivenTraction {
  GivenTraction(const GroundScene& scene, const GroundOutline& outline,
                const GroundSegment& segment) {
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    if (side.kind == SideKind::fixed) return;
    const mesh::Point t = (outline.at(segment.second) - outline.at(segment.first)).normalized();
    const mesh::Point n(t.y(), -t.x());
    const bool is_live = scene.load.sought == Sought::traction;
    if (side.kind == SideKind::free || side.kind == SideKind::loaded) {
      forms.row(0) << n.x() * n.x(), n.y() * n.y(), 2.0 * n.x() * n.y();
      values.row(0) << -side.pressure, is_live ? -side.live_pressure : 0.0;
    }
    if (side.kind == SideKind::footing && side.base == BaseKind::rough) return;
    forms.row(1) << n.x() * t.x(), n.y() * t.y(), n.x() * t.y() + n.y() * t.x();
    values.row(1) << side.shear, is_live ? side.live_shear : 0.0;
  }
  Eigen::Matrix<double, 2, 3> forms = Eigen::Matrix<double, 2, 3>::Zero();
  Eigen::Matrix2d values = Eigen::Matrix2d::Zero();
};

// Whether one stress cannot have the tractions of both sides, as a shear that meets a shear-free
// side at a right angle, or only a large one can. Stress may jump within a fan.
bool needs_two_stresses(const GroundScene& scene, const GroundOutline& outline,
                        const Corner& corner) {
  const GivenTraction before(scene, outline, *corner.before);
  const GivenTraction after(scene, outline, *corner.after);
  Eigen::Matrix<double, 4, 3> forms;
  Eigen::Matrix<double, 4, 2> values;
  forms << before.forms, after.forms;
  values << before.values, after.values;
  const Eigen::Matrix<double, 3, 2> least = forms.completeOrthogonalDecomposition().solve(values);
  constexpr double rounding = 1e-9, large = 2.0;
  return (forms * least - values).norm() > rounding * values.norm() ||
         least.norm() > large * values.norm();
}

// Whether soil there is held by hardly more than friction. Its stress grows with the distance from
// a corner of free faces, and from where another soil crops out, and turns around that point: only
// rays can follow it, down to a scale of cohesion / unit weight.
bool leans_on_friction(const GroundScene& scene, const GroundOutline& outline,
                       const GroundSegment& segment) {
  constexpr double hardly = 0.05;  // of the weight over the length of the face
  const std::size_t region = static_cast<std::size_t>(segment.left);
  const problem::Soil& soil = scene.materials[scene.regions[region].material].soil;
  const double length = (outline.at(segment.second) - outline.at(segment.first)).norm();
  return soil.friction_angle > 0.0 && soil.cohesion < hardly * soil.unit_weight * length;
}

bool is_corner_of_friction(const GroundScene& scene, const GroundOutline& outline,
                           const Corner& corner, double turn) {
  const auto is_face = [&](const GroundSegment& segment) {
    const SideKind kind = scene.sides[static_cast<std::size_t>(segment.side)].kind;
    return kind == SideKind::free || kind == SideKind::loaded;
  };
  if (!is_face(*corner.before) || !is_face(*corner.after)) return false;
  if (!leans_on_friction(scene, outline, *corner.before) &&
      !leans_on_friction(scene, outline, *corner.after)) {
    return false;
  }
  const auto material = [&](const GroundSegment& segment) {
    return scene.regions[static_cast<std::size_t>(segment.left)].material;
  };
  return std::abs(corner.angle(outline) - pi) > turn ||
         material(*corner.before) != material(*corner.after);
}

bool is_singular(const GroundScene& scene, const GroundOutline& outline, const Corner& corner) {
  // Less is a step of a polygon that stands for a curve.
  constexpr double turn = 10.0 * pi / 180.0;
  const double angle = corner.angle(outline);
  if (angle > pi + turn) return true;
  if (is_corner_of_friction(scene, outline, corner, turn)) return true;
  // Flatter corners have several triangles anyway.
  if (angle < pi - turn && needs_two_stresses(scene, outline, corner)) return true;
  const GroundSide& before = scene.sides[static_cast<std::size_t>(corner.before->side)];
  const GroundSide& after = scene.sides[static_cast<std::size_t>(corner.after->side)];
  if (before.kind == SideKind::roller || after.kind == SideKind::roller) return false;
  const bool one_footing = (before.kind == SideKind::footing) != (after.kind == SideKind::footing);
  if (one_footing) return true;
  const bool both_known = before.kind != SideKind::fixed && before.kind != SideKind::footing &&
                          after.kind != SideKind::fixed && after.kind != SideKind::footing;
  const bool grow_alike =
      scene.load.sought != Sought::traction ||
      (before.live_pressure == after.live_pressure && before.live_shear == after.live_shear);
  const bool same = before.pressure == after.pressure && before.shear == after.shear && grow_alike;
  return both_known && !same && angle > pi - turn;
}

// How far a fan may reach: not to what does not meet in its centre, not halfway to another centre.
double reach_of(const GroundOutline& outline, const std::vector<int>& centres, int centre) {
  constexpr double of_way = 0.8, of_way_to_centre = 0.45;
  const mesh::Point& here = outline.at(centre);
  double reach = std::numeric_limits<double>::infinity();
  for (const GroundSegment& segment : outline.segments) {
    if (segment.first == centre || segment.second == centre) {
      const int end = segment.first == centre ? segment.second : segment.first;
      reach = std::min(reach, of_way * (outline.at(end) - here).norm());
    } else {
      reach = std::min(
          reach, of_way * distance(here, outline.at(segment.first), outline.at(segment.second)));
    }
  }
  for (const int other : centres) {
    if (other != centre) {
      reach = std::min(reach, of_way_to_centre * (outline.at(other) - here).norm());
    }
  }
  return reach;
}

// A segment that meets in a corner, and the region that follows it counterclockwise.
struct Spoke {
  double angle = 0.0;  // from the outline that leaves the corner
  mesh::Point direction;
  int region = 0;
};

// All of them, counterclockwise.
std::vector<Spoke> spokes_at(const GroundOutline& outline, const Corner& corner) {
  const int centre = corner.after->first;
  const mesh::Point& here = outline.at(centre);
  const mesh::Point begin = (outline.at(corner.after->second) - here).normalized();
  std::vector<Spoke> spokes;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.first != centre && segment.second != centre) continue;
    const bool leaves = segment.first == centre;
    const mesh::Point to =
        (outline.at(leaves ? segment.second : segment.first) - here).normalized();
    const double angle = &segment == corner.after ? 0.0 : angle_from(begin, to);
    spokes.push_back({angle, to, leaves ? segment.left : segment.right});
  }
  std::sort(spokes.begin(), spokes.end(),
            [](const Spoke& a, const Spoke& b) { return a.angle < b.angle; });
  return spokes;
}

// The rays from one of them until just before the next, at least two.
void add_sector(GroundFan& fan, const Spoke& spoke, double end, double rays_per_radian) {
  const double opening = end - spoke.angle;
  const int rays = std::max(2, static_cast<int>(std::lround(rays_per_radian * opening)));
  const mesh::Point& u = spoke.direction;
  fan.directions.push_back(u);
  fan.regions.push_back(spoke.region);
  for (int k = 1; k < rays; ++k) {
    const double cosine = std::cos(opening * k / rays), sine = std::sin(opening * k / rays);
    fan.directions.emplace_back(cosine * u.x() - sine * u.y(), sine * u.x() + cosine * u.y());
    fan.regions.push_back(spoke.region);
  }
}

}  // namespace

std::vector<int> singular_points(const GroundScene& scene, const GroundOutline& outline) {
  std::vector<int> singular;
  for (int point = 0; point < static_cast<int>(outline.points.size()); ++point) {
    const Corner corner = corner_at(outline, point);
    if (corner.is_there() && is_singular(scene, outline, corner)) singular.push_back(point);
  }
  return singular;
}

std::vector<GroundFan> ground_fans(const GroundScene& scene, const GroundOutline& outline,
                                   const GroundFineness& fineness) {
  const std::vector<int> centres = singular_points(scene, outline);
  std::vector<GroundFan> fans;
  for (const int centre : centres) {
    const Corner corner = corner_at(outline, centre);
    GroundFan fan;
    fan.centre = centre;
    fan.side_before = corner.before->side;
    fan.side_after = corner.after->side;
    const double reach = reach_of(outline, centres, centre);
    for (int k = 1; k <= fineness.rings; ++k) {
      fan.radii.push_back(reach *
                          std::pow(static_cast<double>(k) / fineness.rings, fineness.grading));
    }
    const std::vector<Spoke> spokes = spokes_at(outline, corner);
    for (std::size_t i = 0; i + 1 < spokes.size(); ++i) {
      add_sector(fan, spokes[i], spokes[i + 1].angle, fineness.rays_per_radian);
    }
    fan.directions.push_back(spokes.back().direction);
    fans.push_back(std::move(fan));
  }
  return fans;
}

}  // namespace limit::ground
