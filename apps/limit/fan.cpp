#include "limit/fan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

namespace limit {

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

// Knots of `count` intervals that hold equal parts of a piecewise constant density.
std::vector<double> equal_parts(const std::vector<double>& knots,
                                const std::vector<double>& density, int count) {
  std::vector<double> sum{0.0};
  for (std::size_t i = 0; i < density.size(); ++i) {
    sum.push_back(sum.back() + density[i] * (knots[i + 1] - knots[i]));
  }
  std::vector<double> parts{knots.front()};
  std::size_t i = 0;
  for (int k = 1; k < count; ++k) {
    const double wanted = sum.back() * k / count;
    while (i + 2 < sum.size() && sum[i + 1] < wanted) ++i;
    parts.push_back(knots[i] + (wanted - sum[i]) / density[i]);
  }
  parts.push_back(knots.back());
  return parts;
}

// The root of the density, never less than a part of its mean, mixed with its neighbours'.
std::vector<double> monitor(std::vector<double> integrals, const std::vector<double>& knots) {
  double sum = 0.0;
  std::vector<double> root(integrals.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    const double size = knots[i + 1] - knots[i];
    root[i] = std::sqrt(integrals[i] / size);
    sum += root[i] * size;
  }
  const double mean = sum / (knots.back() - knots.front());
  constexpr double least = 0.25;
  std::vector<double> smooth(root.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    const double before = root[i > 0 ? i - 1 : i], after = root[std::min(i + 1, root.size() - 1)];
    smooth[i] = (before + 2 * root[i] + after) / 4 + (mean > 0.0 ? least * mean : 1.0);
  }
  return smooth;
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

Fan crowded(const Fan& fan, const std::vector<double>& indicators, int rays, int rings) {
  const std::size_t sectors = fan.angles.size() - 1;
  const std::size_t cells = fan.fractions.front().size();
  std::vector<double> of_sector(sectors, 0.0);
  std::vector<std::vector<double>> of_cell(sectors, std::vector<double>(cells, 0.0));
  std::size_t triangle = 0;
  for (std::size_t i = 0; i < sectors; ++i) {
    for (std::size_t k = 0; k < cells; ++k) {
      for (int n = k == 0 ? 1 : 2; n > 0; --n) of_cell[i][k] += indicators.at(triangle++);
      of_sector[i] += of_cell[i][k];
    }
  }
  Fan next{fan.width, fan.depth, {}, {}};
  next.angles = equal_parts(fan.angles, monitor(of_sector, fan.angles), rays);
  hit_corners(next);
  for (const double angle : next.angles) {
    // The old rays about this one, and the sectors about it.
    const auto above = std::lower_bound(fan.angles.begin(), fan.angles.end(), angle);
    const auto right = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
        above - fan.angles.begin(), 1, static_cast<std::ptrdiff_t>(sectors)));
    const double part =
        (angle - fan.angles[right - 1]) / (fan.angles[right] - fan.angles[right - 1]);
    std::vector<double> knots{0.0};
    std::vector<double> integrals(cells);
    for (std::size_t k = 0; k < cells; ++k) {
      knots.push_back((1 - part) * fan.fractions[right - 1][k] + part * fan.fractions[right][k]);
      // Per radius and angle; a sector's density near its apex is that of little area.
      const std::size_t before = part < 0.5 && right >= 2 ? right - 2 : right - 1;
      const std::size_t after = part > 0.5 && right < sectors ? right : right - 1;
      const double middle = (knots[k] + knots[k + 1]) / 2;
      integrals[k] = (of_cell[before][k] / (fan.angles[before + 1] - fan.angles[before]) +
                      of_cell[after][k] / (fan.angles[after + 1] - fan.angles[after])) /
                     middle;
    }
    std::vector<double> parts = equal_parts(knots, monitor(integrals, knots), rings);
    parts.erase(parts.begin());
    parts.back() = 1.0;
    next.fractions.push_back(parts);
  }
  return next;
}

}  // namespace limit
