#include "limit/mesh/fan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace limit::mesh {

namespace {

constexpr double pi = std::numbers::pi;

const Point edge_of_footing(1, 0);

// Directions of the two lower corners of the box, seen from the footing's edge.
std::array<double, 2> corner_angles(const Fan& fan) {
  const auto angle = [](double x, double y) { return std::atan2(y, x) + 2 * pi; };
  return {angle(-1.0, -fan.depth), angle(fan.width - 1.0, -fan.depth)};
}

// Where the ray in this direction leaves the box; exactly on its outline.
Point end_of_ray(const Fan& fan, double angle) {
  const auto [left, right] = corner_angles(fan);
  const double w = fan.width, d = fan.depth;
  if (angle == pi) return {0, 0};
  if (angle == 2 * pi) return {w, 0};
  if (angle == left) return {0, -d};
  if (angle == right) return {w, -d};
  const double slope = std::tan(angle);
  if (angle < left) return {0, -slope};
  if (angle > right) return {w, slope * (w - 1.0)};
  return {1.0 - d / slope, -d};
}

// Moves the nearest inner angle onto each corner of the box.
void hit_corners(Fan& fan) {
  auto first = fan.angles.begin() + 1;
  for (const double corner : corner_angles(fan)) {
    const auto nearest = std::min_element(first, fan.angles.end() - 1, [&](double a, double b) {
      return std::abs(a - corner) < std::abs(b - corner);
    });
    *nearest = corner;
    first = nearest + 1;
  }
}

FanBoundary boundary_of(const Point& a, const Point& b, double depth) {
  if (a.y() == 0.0 && b.y() == 0.0) {
    return std::max(a.x(), b.x()) <= 1.0 ? FanBoundary::base : FanBoundary::surface;
  }
  if (a.x() == 0.0 && b.x() == 0.0) return FanBoundary::axis;
  return a.y() == -depth && b.y() == -depth ? FanBoundary::floor : FanBoundary::wall;
}

}  // namespace

Fan even_fan(double width, double depth, int rays, int rings, double grading) {
  if (!(width > 1.0) || !(depth > 0.0)) {
    throw std::invalid_argument("the box must be wider than the footing and have a depth");
  }
  Fan fan{width, depth, {}, {}};
  for (int i = 0; i <= rays; ++i) fan.angles.push_back(i == rays ? 2 * pi : pi + pi * i / rays);
  hit_corners(fan);
  std::vector<double> fractions;
  for (int k = 1; k <= rings; ++k) {
    fractions.push_back(std::pow(static_cast<double>(k) / rings, grading));
  }
  fan.fractions.assign(fan.angles.size(), fractions);
  return fan;
}

Mesh fan_mesh(const Fan& fan) {
  const auto rays = static_cast<int>(fan.angles.size());
  const auto rings = static_cast<int>(fan.fractions.front().size());
  Mesh mesh;
  mesh.nodes.push_back(edge_of_footing);
  for (std::size_t i = 0; i < fan.angles.size(); ++i) {
    const Point end = end_of_ray(fan, fan.angles[i]);
    for (const double fraction : fan.fractions[i]) {
      mesh.nodes.push_back(
          fraction == 1.0 ? end : Point(edge_of_footing + fraction * (end - edge_of_footing)));
    }
  }
  const auto node = [&](int ray, int ring) { return ring == 0 ? 0 : ray * rings + ring; };
  for (int ray = 0; ray + 1 < rays; ++ray) {
    mesh.triangles.push_back({{0, node(ray, 1), node(ray + 1, 1)}, 0});
    for (int k = 1; k < rings; ++k) {
      const int a = node(ray, k), b = node(ray, k + 1);
      const int c = node(ray + 1, k + 1), d = node(ray + 1, k);
      mesh.triangles.push_back({{a, b, c}, 0});
      mesh.triangles.push_back({{a, c, d}, 0});
    }
  }
  const auto outline = [&](int a, int b) {
    const auto& at = mesh.nodes;
    mesh.boundary.push_back(
        {a, b,
         static_cast<int>(boundary_of(at[static_cast<std::size_t>(a)],
                                      at[static_cast<std::size_t>(b)], fan.depth))});
  };
  for (int k = 0; k < rings; ++k) outline(node(0, k), node(0, k + 1));
  for (int ray = 0; ray + 1 < rays; ++ray) outline(node(ray, rings), node(ray + 1, rings));
  for (int k = rings; k > 0; --k) outline(node(rays - 1, k), node(rays - 1, k - 1));
  return mesh;
}

}  // namespace limit::mesh
