#include "shape/mesh_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "shape/mesh_solids.hpp"

namespace shape {
namespace {

std::vector<int> sorted(std::vector<int> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

std::string place_of(const GmshMesh& mesh, const std::vector<int>& nodes) {
  SpacePoint mean = SpacePoint::Zero();
  for (const int node : nodes) mean += mesh.at(node) / static_cast<double>(nodes.size());
  return mesh.dimension == 2 ? fmt::format("({:g}, {:g})", mean.x(), mean.y())
                             : fmt::format("({:g}, {:g}, {:g})", mean.x(), mean.y(), mean.z());
}

std::vector<MeshPart> parts_of(const GmshMesh& mesh, const std::vector<int>& region) {
  std::vector<MeshPart> parts;
  std::map<std::vector<int>, int> known;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (region[e] < 0) continue;
    const auto [at, is_new] = known.emplace(sorted(mesh.elements[e].nodes), region[e]);
    if (is_new) {
      parts.push_back({static_cast<int>(e), region[e]});
    } else if (at->second != region[e]) {
      throw GmshError(0, fmt::format("the element at {} is of two regions",
                                     place_of(mesh, mesh.elements[e].nodes)));
    }
  }
  return parts;
}

}  // namespace

MeshBody join_elements(const GmshMesh& mesh, const std::vector<int>& region) {
  MeshBody body;
  body.parts = parts_of(mesh, region);
  std::map<std::vector<int>, std::size_t> known;
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    const auto& element = mesh.elements[static_cast<std::size_t>(body.parts[p].element)];
    for (const std::vector<int>& nodes : facets_of(mesh, element)) {
      const auto [at, is_new] = known.emplace(sorted(nodes), body.facets.size());
      if (is_new) {
        body.facets.push_back({nodes, static_cast<int>(p)});
        continue;
      }
      MeshFacet& facet = body.facets[at->second];
      if (facet.beyond >= 0) {
        throw GmshError(0, fmt::format("more than two elements meet at {}", place_of(mesh, nodes)));
      }
      facet.beyond = static_cast<int>(p);
    }
  }
  return body;
}

std::vector<double> spacings(const GmshMesh& mesh, const MeshBody& body,
                             const std::vector<double>& volume) {
  const auto nodes_of = [&](const MeshPart& part) -> const std::vector<int>& {
    return mesh.elements[static_cast<std::size_t>(part.element)].nodes;
  };
  std::vector<double> sum(mesh.nodes.size(), 0.0), count(mesh.nodes.size(), 0.0);
  for (std::size_t p = 0; p < body.parts.size(); ++p) {
    for (const int node : nodes_of(body.parts[p])) {
      sum[static_cast<std::size_t>(node)] += volume[p];
      count[static_cast<std::size_t>(node)] += 1.0;
    }
  }
  std::vector<double> spacing;
  for (const MeshPart& part : body.parts) {
    double volumes = 0.0, parts = 0.0;
    for (const int node : nodes_of(part)) {
      volumes += sum[static_cast<std::size_t>(node)];
      parts += count[static_cast<std::size_t>(node)];
    }
    spacing.push_back(std::pow(volumes / parts, 1.0 / mesh.dimension));
  }
  return spacing;
}

}  // namespace shape
