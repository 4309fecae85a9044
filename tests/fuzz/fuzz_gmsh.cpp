// A mesh of Gmsh: what is read has outlines and parts, or is refused by a GmshError.
#include <cstdint>
#include <string_view>
#include <vector>

#include "shape/gmsh.hpp"
#include "shape/mesh_outline.hpp"
#include "shape/mesh_parts.hpp"
#include "shape/mesh_solids.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const shape::GmshMesh mesh = shape::read_gmsh({reinterpret_cast<const char*>(data), size});
    for (std::size_t g = 0; g < mesh.groups.size(); ++g) {
      const int group = static_cast<int>(g);
      if (mesh.groups[g].dimension == 2) (void)shape::pieces_of(mesh, group);
      if (mesh.groups[g].dimension == 1) (void)shape::polylines_of(mesh, group);
    }
    std::vector<int> region;
    for (const auto& element : mesh.elements) {
      region.push_back(mesh.dimension_of(element) == mesh.dimension ? element.group : -1);
    }
    const shape::MeshBody body = shape::join_elements(mesh, region);
    std::vector<double> volume;
    for (const auto& part : body.parts) {
      volume.push_back(
          shape::content_of(mesh, mesh.elements[static_cast<std::size_t>(part.element)]).volume);
    }
    (void)shape::spacings(mesh, body, volume);
  } catch (const shape::GmshError&) {
  }
  return 0;
}
