#include "limit/problem/pore_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace limit::problem {
namespace {

bool is_known(const Problem& problem, const mesh::BoundaryEdge& edge) {
  return problem.boundaries[static_cast<std::size_t>(edge.boundary)].normal != Known::support;
}

std::vector<bool> nodes_on_known_outline(const Problem& problem) {
  std::vector<bool> known(problem.mesh.nodes.size(), false);
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    if (!is_known(problem, edge)) continue;
    for (const int node : {edge.first, edge.second}) known[static_cast<std::size_t>(node)] = true;
  }
  return known;
}

std::array<mesh::Point, 3> places_of(const mesh::Mesh& mesh, const mesh::Triangle& triangle) {
  const auto place = [&](std::size_t i) {
    return mesh.nodes[static_cast<std::size_t>(triangle.nodes[i])];
  };
  return {place(0), place(1), place(2)};
}

double cross(const mesh::Point& a, const mesh::Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// What is one in a corner and nothing in the others.
std::array<double, 3> shares_at(const std::array<mesh::Point, 3>& corners,
                                const mesh::Point& place) {
  const double all = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double second = cross(place - corners[0], corners[2] - corners[0]) / all;
  const double third = cross(corners[1] - corners[0], place - corners[0]) / all;
  return {1.0 - second - third, second, third};
}

}  // namespace

MeshPressure pressure_on_mesh(const Problem& problem, Bound bound) {
  MeshPressure result;
  if (!problem.pore_pressure) return result;
  const PorePressure& told = *problem.pore_pressure;
  const mesh::Mesh& mesh = problem.mesh;
  const double sign = bound == Bound::lower ? 1.0 : -1.0;
  // What points are told to, and what is linear along a side is linear to.
  constexpr double rounding = 2e-6, of_place = 1e-12;
  const double slack = rounding * told.largest();
  for (const mesh::Point& node : mesh.nodes) {
    result.nodes.push_back(told.at(problem.pressure_length * node));
  }
  const std::vector<bool> known = nodes_on_known_outline(problem);
  std::vector<double> more(mesh.nodes.size(), 0.0);
  for (const mesh::Triangle& triangle : mesh.triangles) {
    std::array<mesh::Point, 3> corners = places_of(mesh, triangle);
    for (mesh::Point& corner : corners) corner *= problem.pressure_length;
    for (const PorePressure::Corner& corner : told.corners_in(corners)) {
      const std::array<double, 3> shares = shares_at(corners, corner.place);
      double linear = 0.0, free = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto node = static_cast<std::size_t>(triangle.nodes[i]);
        linear += shares[i] * result.nodes[node];
        if (!known[node]) free += shares[i];
      }
      const double missing = sign * (corner.pressure - linear);
      if (missing <= slack) continue;
      if (free <= of_place) throw std::logic_error("pore pressure: no node off the outline");
      for (const int node : triangle.nodes) {
        const auto i = static_cast<std::size_t>(node);
        if (!known[i]) more[i] = std::max(more[i], missing / free);
      }
    }
  }
  for (std::size_t i = 0; i < more.size(); ++i) {
    result.nodes[i] = (result.nodes[i] + sign * more[i]) / problem.pressure_stress;
  }
  for (const mesh::Triangle& triangle : mesh.triangles) {
    const std::array<mesh::Point, 3> corners = places_of(mesh, triangle);
    const mesh::Point first = corners[1] - corners[0], second = corners[2] - corners[0];
    const auto value = [&](std::size_t i) {
      return result.nodes[static_cast<std::size_t>(triangle.nodes[i])];
    };
    const double up_first = value(1) - value(0), up_second = value(2) - value(0);
    result.forces.emplace_back(-mesh::Point(up_first * second.y() - up_second * first.y(),
                                            up_second * first.x() - up_first * second.x()) /
                               cross(first, second));
  }
  return result;
}

mesh::Mesh with_inner_nodes(const Problem& problem) {
  const std::vector<bool> known = nodes_on_known_outline(problem);
  const auto ordered = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  mesh::Mesh cut = problem.mesh;
  std::map<std::pair<int, int>, int> middles;  // of the sides that get one
  for (const mesh::Triangle& triangle : problem.mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int first = triangle.nodes[i], second = triangle.nodes[(i + 1) % 3];
      if (known[static_cast<std::size_t>(first)] && known[static_cast<std::size_t>(second)]) {
        middles[ordered(first, second)] = -1;
      }
    }
  }
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    if (is_known(problem, edge)) middles.erase(ordered(edge.first, edge.second));
  }
  for (auto& [side, middle] : middles) {
    middle = static_cast<int>(cut.nodes.size());
    cut.nodes.emplace_back((problem.mesh.nodes[static_cast<std::size_t>(side.first)] +
                            problem.mesh.nodes[static_cast<std::size_t>(side.second)]) /
                           2.0);
  }
  const auto middle_of = [&](int first, int second) {
    const auto found = middles.find(ordered(first, second));
    return found == middles.end() ? -1 : found->second;
  };
  cut.triangles.clear();
  for (const mesh::Triangle& triangle : problem.mesh.triangles) {
    // Halved across one side after the other: a half has all of a side, or half of a halved one.
    std::vector<mesh::Triangle> parts{triangle};
    for (std::size_t k = 0; k < parts.size();) {
      const std::array<int, 3> nodes = parts[k].nodes;
      std::size_t i = 0;
      while (i < 3 && middle_of(nodes[i], nodes[(i + 1) % 3]) < 0) ++i;
      if (i == 3) {
        ++k;
        continue;
      }
      const int first = nodes[i], second = nodes[(i + 1) % 3], third = nodes[(i + 2) % 3];
      const int middle = middle_of(first, second);
      parts[k].nodes = {first, middle, third};
      parts.push_back({{middle, second, third}, triangle.region});
    }
    cut.triangles.insert(cut.triangles.end(), parts.begin(), parts.end());
  }
  cut.boundary.clear();
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    const int middle = middle_of(edge.first, edge.second);
    if (middle < 0) {
      cut.boundary.push_back(edge);
      continue;
    }
    cut.boundary.push_back({edge.first, middle, edge.boundary});
    cut.boundary.push_back({middle, edge.second, edge.boundary});
  }
  return cut;
}

}  // namespace limit::problem
