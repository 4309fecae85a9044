#include "shape/mesh_solids.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace shape {
namespace {

using Facets = std::vector<std::vector<int>>;

// By the number of nodes, in Gmsh's order (manual of gmsh 4.8, "Node ordering").
const Facets& local_facets_of_solid(std::size_t nodes) {
  static const Facets tetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  static const Facets pyramid{{0, 3, 2, 1}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  static const Facets prism{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  static const Facets hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  switch (nodes) {
    case 4:
      return tetrahedron;
    case 5:
      return pyramid;
    case 6:
      return prism;
    default:
      return hexahedron;
  }
}

void turn_inside_out(std::vector<int>& nodes) {
  switch (nodes.size()) {
    case 4:
      std::swap(nodes[2], nodes[3]);
      break;
    case 5:
      std::swap(nodes[1], nodes[3]);
      break;
    default: {
      const auto half = static_cast<std::ptrdiff_t>(nodes.size() / 2);
      std::rotate(nodes.begin(), nodes.begin() + half, nodes.end());
    }
  }
}

SpacePoint mean_of(const GmshMesh& mesh, const std::vector<int>& nodes) {
  SpacePoint sum = SpacePoint::Zero();
  for (const int node : nodes) sum += mesh.at(node);
  return sum / static_cast<double>(nodes.size());
}

FacetPiece triangle(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  return {(a + b + c) / 3.0, 0.5 * (b - a).cross(c - a)};
}

FacetPiece together(const std::vector<FacetPiece>& pieces) {
  FacetPiece whole;
  double weight = 0.0;
  for (const FacetPiece& piece : pieces) whole.area += piece.area;
  for (const FacetPiece& piece : pieces) {
    const double share = piece.area.dot(whole.area);
    whole.middle += share * piece.middle;
    weight += share;
  }
  whole.middle /= weight;
  return whole;
}

// The pyramids from a place to the pieces of a solid's surface, whose sum the solid is.
template <class Visitor>
void for_each_pyramid(const GmshMesh& mesh, const GmshMesh::Element& solid, const SpacePoint& tip,
                      Visitor&& visit) {
  for (const std::vector<int>& facet : facets_of(mesh, solid)) {
    for (const FacetPiece& piece : flat_pieces(mesh, facet)) {
      const double volume = piece.area.dot(piece.middle - tip) / 3.0;
      visit(volume, SpacePoint(0.75 * piece.middle + 0.25 * tip));
    }
  }
}

Content content_of_face(const GmshMesh& mesh, const std::vector<int>& nodes) {
  Content content;
  const SpacePoint& tip = mesh.at(nodes[0]);
  for (std::size_t k = 1; k + 1 < nodes.size(); ++k) {
    const FacetPiece part = triangle(tip, mesh.at(nodes[k]), mesh.at(nodes[k + 1]));
    content.volume += part.area.z();
    content.centroid += part.area.z() * part.middle;
  }
  content.centroid /= content.volume;
  return content;
}

}  // namespace

std::vector<std::vector<int>> facets_of(const GmshMesh& mesh, const GmshMesh::Element& element) {
  const std::vector<int>& nodes = element.nodes;
  Facets facets;
  if (mesh.dimension_of(element) == 2) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      facets.push_back({nodes[k], nodes[(k + 1) % nodes.size()]});
    }
    return facets;
  }
  for (const std::vector<int>& local : local_facets_of_solid(nodes.size())) {
    std::vector<int>& facet = facets.emplace_back();
    for (const int k : local) facet.push_back(nodes[static_cast<std::size_t>(k)]);
  }
  return facets;
}

std::vector<FacetPiece> flat_pieces(const GmshMesh& mesh, const std::vector<int>& facet) {
  if (facet.size() == 2) {
    const SpacePoint &from = mesh.at(facet[0]), &to = mesh.at(facet[1]);
    return {{0.5 * (from + to), {to.y() - from.y(), from.x() - to.x(), 0.0}}};
  }
  if (facet.size() == 3) return {triangle(mesh.at(facet[0]), mesh.at(facet[1]), mesh.at(facet[2]))};
  std::vector<FacetPiece> pieces;
  const SpacePoint middle = mean_of(mesh, facet);
  for (std::size_t k = 0; k < facet.size(); ++k) {
    pieces.push_back(triangle(middle, mesh.at(facet[k]), mesh.at(facet[(k + 1) % facet.size()])));
  }
  const FacetPiece whole = together(pieces);
  constexpr double flat = 1e-9;
  const double size = whole.area.norm();
  const bool is_flat = std::ranges::all_of(pieces, [&](const FacetPiece& piece) {
    return piece.area.dot(whole.area) > 0.0 &&
           piece.area.cross(whole.area).norm() <= flat * size * size;
  });
  return is_flat ? std::vector<FacetPiece>{whole} : pieces;
}

Content content_of(const GmshMesh& mesh, const GmshMesh::Element& element) {
  if (mesh.dimension_of(element) == 2) return content_of_face(mesh, element.nodes);
  Content content;
  for_each_pyramid(mesh, element, mean_of(mesh, element.nodes),
                   [&](double volume, const SpacePoint& centroid) {
                     content.volume += volume;
                     content.centroid += volume * centroid;
                   });
  content.centroid /= content.volume;
  return content;
}

SolidShape turn_outward(const GmshMesh& mesh, GmshMesh::Element& solid) {
  const SpacePoint tip = mean_of(mesh, solid.nodes);
  double largest = 0.0;
  for (const int node : solid.nodes) largest = std::max(largest, (mesh.at(node) - tip).norm());
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for_each_pyramid(mesh, solid, tip, [&](double volume, const SpacePoint& /*centroid*/) {
    least = std::min(least, volume);
    most = std::max(most, volume);
  });
  constexpr double nothing = 1e-12;
  const double round_off = nothing * std::pow(largest, 3);
  if (std::max(-least, most) <= round_off) return SolidShape::flat;
  if (least <= round_off && most >= -round_off) return SolidShape::folded;
  if (most < 0.0) turn_inside_out(solid.nodes);
  return SolidShape::good;
}

}  // namespace shape
