#pragma once

#include <vector>

#include "shape/mesh.hpp"

namespace shape {

/// An element that is of a body.
struct MeshPart {
  int element = 0;  // of the mesh
  int region = 0;
};

/// Where a part ends.
struct MeshFacet {
  std::vector<int> nodes;  // as `facets_of` the part gives them
  int part = 0;
  int beyond = -1;  // the part on the other side; -1: none, it is surface
};

/// The elements of a body and where they meet.
struct MeshBody {
  std::vector<MeshPart> parts;
  std::vector<MeshFacet> facets;  // each once
};

/// @param region  of each element; -1: it is not of the body. One that is there twice, in two
/// groups,
///   counts once.
/// @throws GmshError where an element is of two regions, or a facet of more than two elements
[[nodiscard]] MeshBody join_elements(const GmshMesh& mesh, const std::vector<int>& region);

/// [m] How far apart the middles of the parts around each are: the width of a cube (square) of the
/// mean volume of those that share a corner with it.
/// @param volume  [m^3, or m^2] of each part
[[nodiscard]] std::vector<double> spacings(const GmshMesh& mesh, const MeshBody& body,
                                           const std::vector<double>& volume);

}  // namespace shape
