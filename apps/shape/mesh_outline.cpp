#include "shape/mesh_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "shape/ring.hpp"

namespace shape {
namespace {

constexpr double straight = 1e-9;  // of the length of the pieces

// Whether a corner lies on the straight line between its neighbours.
bool is_on_the_way(const Point& before, const Point& here, const Point& after) {
  const Point in = here - before, out = after - here;
  return in.dot(out) > 0.0 && std::abs(cross(in, out)) <= straight * in.norm() * out.norm();
}

std::vector<Point> places(const GmshMesh& mesh, const std::vector<int>& nodes) {
  std::vector<Point> all;
  for (const int node : nodes) all.push_back(mesh.plane_at(node));
  return all;
}

// Judged by the line from the last corner that stays, so that a curve keeps its shape.
Ring without_corners_on_lines(const Ring& ring) {
  const std::size_t n = ring.size();
  std::size_t first = 0;
  while (first < n && is_on_the_way(ring[(first + n - 1) % n], ring[first], ring[(first + 1) % n]))
    ++first;
  if (first == n) return ring;
  Ring kept{ring[first]};
  for (std::size_t k = 1; k < n; ++k) {
    const Point &here = ring[(first + k) % n], &after = ring[(first + k + 1) % n];
    if (!is_on_the_way(kept.back(), here, after)) kept.push_back(here);
  }
  return kept;
}

std::vector<Point> line_without_corners_on_lines(const std::vector<Point>& line) {
  std::vector<Point> kept{line.front()};
  for (std::size_t k = 1; k + 1 < line.size(); ++k) {
    if (!is_on_the_way(kept.back(), line[k], line[k + 1])) kept.push_back(line[k]);
  }
  kept.push_back(line.back());
  return kept;
}

// The edges of a group's faces that have no other face of it beyond them, the faces to the left.
std::multimap<int, int> rim_of(const GmshMesh& mesh, int group) {
  std::set<std::pair<int, int>> edges;
  for (const GmshMesh::Element& face : mesh.elements) {
    if (face.group != group) continue;
    for (std::size_t k = 0; k < face.nodes.size(); ++k) {
      const int from = face.nodes[k], to = face.nodes[(k + 1) % face.nodes.size()];
      if (edges.emplace(from, to).second) continue;
      const Point at = mesh.plane_at(from);
      throw GmshError(0, fmt::format("faces overlap at ({:g}, {:g})", at.x(), at.y()));
    }
  }
  std::multimap<int, int> rim;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) == 0) rim.emplace(from, to);
  }
  return rim;
}

}  // namespace

std::optional<int> find_group(const GmshMesh& mesh, int dimension, std::string_view name) {
  for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
    if (mesh.groups[g].dimension == dimension && mesh.groups[g].name == name) {
      return static_cast<int>(g);
    }
  }
  return std::nullopt;
}

std::vector<Piece> pieces_of(const GmshMesh& mesh, int group) {
  std::multimap<int, int> rim = rim_of(mesh, group);
  std::vector<Piece> pieces;
  std::vector<Ring> holes;
  while (!rim.empty()) {
    // As many edges leave a node as come to it, so that every way ends where it began.
    std::vector<int> loop{rim.begin()->first};
    for (auto at = rim.begin(); at != rim.end(); at = rim.find(loop.back())) {
      const int to = at->second;
      rim.erase(at);
      if (to == loop.front()) break;
      loop.push_back(to);
    }
    const Ring ring = without_corners_on_lines(places(mesh, loop));
    if (signed_area(ring) > 0.0) {
      pieces.push_back({ring, {}});
    } else {
      holes.push_back(ring);
    }
  }
  for (const Ring& hole : holes) {
    // The smallest outline around it: there may be an island in a hole of another.
    Piece* owner = nullptr;
    const Point middle = 0.5 * (hole[0] + hole[1]);
    for (Piece& piece : pieces) {
      if (!is_inside(piece.outline, middle)) continue;
      if (owner == nullptr || signed_area(piece.outline) < signed_area(owner->outline))
        owner = &piece;
    }
    if (owner != nullptr) owner->holes.push_back(hole);
  }
  return pieces;
}

std::vector<std::vector<Point>> polylines_of(const GmshMesh& mesh, int group) {
  std::map<int, std::vector<int>> beside;
  for (const GmshMesh::Element& line : mesh.elements) {
    if (line.group != group) continue;
    beside[line.nodes[0]].push_back(line.nodes[1]);
    beside[line.nodes[1]].push_back(line.nodes[0]);
  }
  const auto leave = [&](int from, int to) {
    std::vector<int>& there = beside[from];
    there.erase(std::ranges::find(there, to));
  };
  std::vector<std::vector<Point>> lines;
  const auto follow = [&](int node) {
    std::vector<int> line{node};
    while (!beside[line.back()].empty()) {
      const int from = line.back(), to = beside[from].front();
      leave(from, to);
      leave(to, from);
      line.push_back(to);
    }
    lines.push_back(line_without_corners_on_lines(places(mesh, line)));
  };
  // From ends and branches first, then what is closed.
  for (const auto& [node, there] : beside) {
    while (there.size() % 2 == 1) follow(node);
  }
  for (const auto& [node, there] : beside) {
    while (!there.empty()) follow(node);
  }
  return lines;
}

}  // namespace shape
