#pragma once

#include <vector>

#include "shape/mesh.hpp"

namespace shape {

/// The faces of a tetrahedron, pyramid, prism or hexahedron by their nodes, counterclockwise seen
/// from outside; of a plane face its edges, with it to their left.
[[nodiscard]] std::vector<std::vector<int>> facets_of(const GmshMesh& mesh,
                                                      const GmshMesh::Element& element);

/// A flat piece of a facet.
struct FacetPiece {
  SpacePoint middle = SpacePoint::Zero();  // [m] centroid
  SpacePoint area = SpacePoint::Zero();    // [m^2, or m of an edge] times the outward normal
};

/// A facet as one flat piece, or as triangles about its middle if it has four corners that are in
/// no plane, so that the elements on both sides see the same surface.
[[nodiscard]] std::vector<FacetPiece> flat_pieces(const GmshMesh& mesh,
                                                  const std::vector<int>& facet);

/// What an element stands for.
struct Content {
  double volume = 0.0;                       // [m^3, or m^2]
  SpacePoint centroid = SpacePoint::Zero();  // [m]
};

/// Exact within the surface that `flat_pieces` gives it.
[[nodiscard]] Content content_of(const GmshMesh& mesh, const GmshMesh::Element& element);

enum class SolidShape { good, flat, folded };

/// Orders the nodes of a solid so that its volume is positive, and judges it: a good one is seen
/// whole from the mean of its corners.
[[nodiscard]] SolidShape turn_outward(const GmshMesh& mesh, GmshMesh::Element& solid);

}  // namespace shape
