#include "limit/mesh/bisection.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace limit::mesh {

namespace {

using Side = std::pair<int, int>;  // as it runs counterclockwise in its triangle

class Bisector {
 public:
  /// @param indicators  of the triangles; divided as these are
  Bisector(const Mesh& mesh, std::vector<double> indicators)
      : mesh_(mesh), indicators_(std::move(indicators)), alive_(mesh.triangles.size(), true) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) enter(static_cast<int>(t));
    for (const BoundaryEdge& edge : mesh.boundary) {
      outline_[{edge.first, edge.second}] = edge.boundary;
    }
  }

  // Follows the longest sides until two triangles share one (or it is on the outline), splits
  // those, and goes on until the triangle itself is gone.
  void bisect(int triangle) {
    while (alive_[static_cast<std::size_t>(triangle)]) {
      int last = triangle;
      for (;;) {
        const Side side = longest(last);
        const int next = across(side);
        if (next < 0 || longest(next) == Side(side.second, side.first)) {
          split(side);
          break;
        }
        last = next;
      }
    }
  }

  /// Of the triangles of the result.
  std::vector<double> indicators() const {
    std::vector<double> left;
    for (std::size_t t = 0; t < indicators_.size(); ++t) {
      if (alive_[t]) left.push_back(indicators_[t]);
    }
    return left;
  }

  Mesh result() const {
    Mesh mesh;
    mesh.nodes = mesh_.nodes;
    mesh.stretch = mesh_.stretch;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      if (alive_[t]) mesh.triangles.push_back(mesh_.triangles[t]);
    }
    for (const auto& [side, boundary] : outline_) {
      mesh.boundary.push_back({side.first, side.second, boundary});
    }
    return mesh;
  }

 private:
  const Triangle& at(int triangle) const {
    return mesh_.triangles[static_cast<std::size_t>(triangle)];
  }

  void enter(int triangle) {
    const auto& nodes = at(triangle).nodes;
    for (std::size_t i = 0; i < 3; ++i) owner_[{nodes[i], nodes[(i + 1) % 3]}] = triangle;
  }

  int across(const Side& side) const {
    const auto found = owner_.find({side.second, side.first});
    return found == owner_.end() ? -1 : found->second;
  }

  // Of sides of equal length the one of the lower nodes, so that both neighbours choose alike.
  Side longest(int triangle) const {
    const auto& nodes = at(triangle).nodes;
    Side best;
    double most = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Side side(nodes[i], nodes[(i + 1) % 3]);
      const auto [low, high] = std::minmax(side.first, side.second);
      // From the lower node to the higher one, so that both neighbours round alike.
      const Point way = node(high) - node(low);
      const double length = Point(way.x() / mesh_.stretch, way.y()).squaredNorm();
      if (length > most || (length == most && std::minmax(side.first, side.second) <
                                                  std::minmax(best.first, best.second))) {
        most = length;
        best = side;
      }
    }
    return best;
  }

  [[nodiscard]] const Point& node(int index) const {
    return mesh_.nodes[static_cast<std::size_t>(index)];
  }

  [[nodiscard]] Point middle_of(const Side& side) const {
    return (node(side.first) + node(side.second)) / 2.0;
  }

  // Four sides meet in the new node. Where they are nearly two straight lines, equilibrium across
  // them is nearly the same equation twice, and Newton systems lose the digits that tell them
  // apart; where they are two, it is, and nothing is lost. So the node goes to where the line
  // between the opposite nodes crosses the side, if that is next to its middle.
  [[nodiscard]] Point crossing_of(const Side& side, int left, int right) const {
    const Point along = node(side.second) - node(side.first), across = node(right) - node(left);
    const Point way = node(left) - node(side.first);
    const double share = (way.x() * across.y() - way.y() * across.x()) /
                         (along.x() * across.y() - along.y() * across.x());
    constexpr double next_to = 0.02;
    return std::abs(share - 0.5) < next_to ? Point(node(side.first) + share * along)
                                           : middle_of(side);
  }

  [[nodiscard]] int opposite(int triangle, const Side& side) const {
    const auto& nodes = at(triangle).nodes;
    return *std::find_if(nodes.begin(), nodes.end(),
                         [&](int corner) { return corner != side.first && corner != side.second; });
  }

  void split(const Side& side) {
    const int right = across(side);
    const int left = owner_.at(side);
    const auto middle = static_cast<int>(mesh_.nodes.size());
    mesh_.nodes.push_back(right < 0
                              ? middle_of(side)
                              : crossing_of(side, opposite(left, side), opposite(right, side)));
    halve(left, side, middle);
    if (right >= 0) {
      halve(right, {side.second, side.first}, middle);
    } else if (const auto outer = outline_.find(side); outer != outline_.end()) {
      const int boundary = outer->second;
      outline_.erase(outer);
      outline_[{side.first, middle}] = boundary;
      outline_[{middle, side.second}] = boundary;
    } else {
      throw std::invalid_argument("bisection: a side of one triangle that is not on the outline");
    }
  }

  void halve(int triangle, const Side& side, int middle) {
    const Triangle old = at(triangle);
    const int corner = opposite(triangle, side);
    alive_[static_cast<std::size_t>(triangle)] = false;
    owner_.erase(side);
    for (const Triangle& half : {Triangle{{side.first, middle, corner}, old.region},
                                 Triangle{{middle, side.second, corner}, old.region}}) {
      mesh_.triangles.push_back(half);
      indicators_.push_back(indicators_[static_cast<std::size_t>(triangle)] / 2.0);
      alive_.push_back(true);
      enter(static_cast<int>(mesh_.triangles.size()) - 1);
    }
  }

  Mesh mesh_;
  std::vector<double> indicators_;
  std::vector<bool> alive_;
  std::map<Side, int> owner_;
  std::map<Side, int> outline_;
};

std::pair<Mesh, std::vector<double>> bisected_with(const Mesh& mesh, std::vector<double> indicators,
                                                   const std::vector<bool>& marked) {
  if (marked.size() != mesh.triangles.size()) {
    throw std::invalid_argument("bisection: one mark per triangle is wanted");
  }
  Bisector bisector(mesh, std::move(indicators));
  for (std::size_t t = 0; t < marked.size(); ++t) {
    if (marked[t]) bisector.bisect(static_cast<int>(t));
  }
  return {bisector.result(), bisector.indicators()};
}

}  // namespace

Mesh bisected(const Mesh& mesh, const std::vector<bool>& marked) {
  return bisected_with(mesh, std::vector<double>(marked.size(), 0.0), marked).first;
}

Mesh refined(Mesh mesh, std::vector<double> indicators, double share, double growth) {
  const double wanted = growth * static_cast<double>(mesh.triangles.size());
  const auto is_positive = [](double indicator) { return indicator > 0.0; };
  if (std::none_of(indicators.begin(), indicators.end(), is_positive)) return mesh;
  do {
    const std::vector<bool> marked = largest(indicators, share);
    std::tie(mesh, indicators) = bisected_with(mesh, std::move(indicators), marked);
  } while (static_cast<double>(mesh.triangles.size()) < wanted);
  return mesh;
}

std::vector<bool> largest(const std::vector<double>& indicators, double share) {
  std::vector<std::size_t> order(indicators.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return indicators[a] > indicators[b]; });
  const double wanted = share * std::accumulate(indicators.begin(), indicators.end(), 0.0);
  std::vector<bool> marked(indicators.size(), false);
  double sum = 0.0;
  for (const std::size_t i : order) {
    if (sum >= wanted || !(indicators[i] > 0.0)) break;
    marked[i] = true;
    sum += indicators[i];
  }
  return marked;
}

}  // namespace limit::mesh
