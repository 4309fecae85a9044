#pragma once

#include <string_view>

#include "shape/mesh.hpp"

namespace shape {

/// Reads the text of a mesh in Gmsh's formats MSH 2.2 and 4.1, as of gmsh 4.8's manual.
/// @param unit  [m] what a unit of the file's coordinates is
/// @throws GmshError if it is binary, of another version or broken off; if an element is curved; if
///   a solid has no volume or is folded; without solids, if nodes are not in one plane z = const,
///   or a face has no area, is not convex or is folded
[[nodiscard]] GmshMesh read_gmsh(std::string_view text, double unit = 1.0);

}  // namespace shape
