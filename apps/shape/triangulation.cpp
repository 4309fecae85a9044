#include "shape/triangulation.hpp"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

#include "shape/ring.hpp"

namespace shape {
namespace {

using GridPoint = boost::polygon::point_data<std::int32_t>;
using Diagram = boost::polygon::voronoi_diagram<double>;

// Points on a grid as fine as Boost's integers, on which nothing is rounded.
std::vector<GridPoint> on_grid(std::span<const Point> points) {
  Point low = points.front(), high = low;
  for (const Point& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  constexpr double widest = 1 << 30;
  const double extent = (high - low).maxCoeff();
  const double scale = extent > 0.0 ? widest / extent : 0.0;
  std::vector<GridPoint> placed;
  placed.reserve(points.size());
  for (const Point& point : points) {
    const Point at = scale * (point - low);
    placed.emplace_back(static_cast<std::int32_t>(std::lround(at.x())),
                        static_cast<std::int32_t>(std::lround(at.y())));
  }
  return placed;
}

// Of several points in one place of the grid the first, by their numbers.
std::vector<int> different(const std::vector<GridPoint>& placed) {
  std::vector<int> order(placed.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const auto key = [&](int i) {
    const GridPoint& point = placed[static_cast<std::size_t>(i)];
    return std::pair(point.x(), point.y());
  };
  std::ranges::stable_sort(order, {}, key);
  order.erase(
      std::unique(order.begin(), order.end(), [&](int a, int b) { return key(a) == key(b); }),
      order.end());
  return order;
}

}  // namespace

std::vector<std::array<int, 3>> triangles_between(std::span<const Point> points) {
  std::vector<std::array<int, 3>> triangles;
  if (points.size() < 3) return triangles;
  const std::vector<GridPoint> placed = on_grid(points);
  const std::vector<int> numbers = different(placed);
  std::vector<GridPoint> sites;
  for (const int i : numbers) sites.push_back(placed[static_cast<std::size_t>(i)]);
  Diagram diagram;
  boost::polygon::construct_voronoi(sites.begin(), sites.end(), &diagram);
  const auto at = [&](int i) -> const Point& { return points[static_cast<std::size_t>(i)]; };
  for (const Diagram::vertex_type& vertex : diagram.vertices()) {
    // The points whose cells meet in a vertex of Voronoi's diagram are on a circle around it.
    std::vector<int> around;
    const Diagram::edge_type* edge = vertex.incident_edge();
    do {
      around.push_back(numbers[edge->cell()->source_index()]);
      edge = edge->rot_next();
    } while (edge != vertex.incident_edge());
    for (std::size_t k = 1; k + 1 < around.size(); ++k) {
      std::array<int, 3> corners{around[0], around[k], around[k + 1]};
      const Point first = at(corners[1]) - at(corners[0]), second = at(corners[2]) - at(corners[0]);
      const double twice_area = cross(first, second);
      constexpr double flat = 1e-7;
      const double longest =
          std::max({first.squaredNorm(), second.squaredNorm(), (second - first).squaredNorm()});
      if (std::abs(twice_area) <= flat * longest) continue;
      if (twice_area < 0.0) std::swap(corners[1], corners[2]);
      triangles.push_back(corners);
    }
  }
  return triangles;
}

}  // namespace shape
