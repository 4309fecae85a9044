// A mesh of Gmsh: what is read has outlines, or is refused by a GmshError.
#include <cstdint>
#include <string_view>

#include "shape/gmsh.hpp"
#include "shape/mesh_outline.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const shape::GmshMesh mesh = shape::read_gmsh({reinterpret_cast<const char*>(data), size});
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      const int group = static_cast<int>(g);
      if (mesh.groups[g].dimension == 2) (void)shape::pieces_of(mesh, group);
      if (mesh.groups[g].dimension == 1) (void)shape::polylines_of(mesh, group);
    }
  } catch (const shape::GmshError&) {
  }
  return 0;
}
