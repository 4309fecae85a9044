#include "limit/problem/at_rest.hpp"

#include <algorithm>
#include <utility>

namespace limit::problem {

Problem with_soils_at_rest(Problem problem, const std::vector<bool>& rests) {
  mesh::Mesh& mesh = problem.mesh;
  const auto is_at_rest = [&](int triangle) {
    return rests[static_cast<std::size_t>(
        mesh.triangles[static_cast<std::size_t>(triangle)].region)];
  };
  const int rigid = static_cast<int>(problem.boundaries.size());
  std::vector<mesh::BoundaryEdge> outline;
  for (const mesh::Edge& edge : mesh::edges_of(mesh)) {
    const bool left = !is_at_rest(edge.left), right = edge.right >= 0 && !is_at_rest(edge.right);
    if (left && edge.right < 0) outline.push_back({edge.first, edge.second, edge.boundary});
    if (left && edge.right >= 0 && !right) outline.push_back({edge.first, edge.second, rigid});
    if (right && !left) outline.push_back({edge.second, edge.first, rigid});
  }
  Boundary ground{"ground at rest"};
  ground.normal = ground.tangential = Known::support;
  problem.boundaries.push_back(std::move(ground));
  mesh.boundary = std::move(outline);
  std::erase_if(mesh.triangles, [&](const mesh::Triangle& triangle) {
    return rests[static_cast<std::size_t>(triangle.region)];
  });
  return problem;
}

}  // namespace limit::problem
