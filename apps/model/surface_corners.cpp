#include "model/surface_corners.hpp"

#include <cmath>
#include <cstddef>

#include "scene/element_body.hpp"
#include "scene/scene.hpp"
#include "shape/mesh_solids.hpp"

namespace model {

std::vector<std::vector<fpm::Vector<3>>> surface_corners(const scene::Scene& scene,
                                                         const Model<3>& model) {
  const scene::ElementBody body = scene::elements_of(scene);
  std::vector<std::vector<fpm::Vector<3>>> corners(model.surface.size());
  std::size_t next = 0;  // the pieces are in the order of the facets
  const auto found = [&](const std::vector<int>& nodes) {
    const std::size_t first = next;
    fpm::Vector<3> middle = fpm::Vector<3>::Zero();
    for (const int node : nodes) middle += body.mesh.at(node) / static_cast<double>(nodes.size());
    const auto pieces = shape::flat_pieces(body.mesh, nodes);
    for (std::size_t k = 0; k < pieces.size() && next < corners.size(); ++k, ++next) {
      const SurfacePiece<3>& piece = model.surface[next];
      constexpr double same = 1e-9;
      if ((pieces[k].middle - piece.middle).norm() > same * std::sqrt(piece.area)) break;
      if (pieces.size() == 1) {
        for (const int node : nodes) corners[next].emplace_back(body.mesh.at(node));
      } else {  // a triangle about the middle
        corners[next] = {middle, body.mesh.at(nodes[k]),
                         body.mesh.at(nodes[(k + 1) % nodes.size()])};
      }
    }
    return next > first;
  };
  for (const shape::MeshFacet& facet : body.joined.facets) {
    // Of what is exposed, the other way around.
    if (!found(facet.nodes)) found({facet.nodes.rbegin(), facet.nodes.rend()});
  }
  return corners;
}

}  // namespace model
