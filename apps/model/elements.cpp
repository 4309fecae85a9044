#include "model/elements.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "fpm/bodies.hpp"
#include "fpm/neighbour_search.hpp"
#include "fpm/rows.hpp"
#include "model/grid_cells.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"
#include "shape/mesh_solids.hpp"

namespace model {
namespace {

template <int Dim>
fpm::Vector<Dim> place_of(const shape::SpacePoint& place) {
  return place.head<Dim>();
}

// Particle of each part of the body; -1 of a region that is not there.
std::vector<fpm::Index> number_particles(const scene::Scene& scene,
                                         const scene::ElementBody& body) {
  std::vector<fpm::Index> particle;
  fpm::Index next = 0;
  for (const shape::MeshPart& part : body.joined.parts) {
    const bool present = scene.region[static_cast<std::size_t>(part.region)].present;
    particle.push_back(present ? next++ : -1);
  }
  return particle;
}

template <int Dim>
void add_particles(const scene::Scene& scene, const scene::ElementBody& body,
                   const std::vector<fpm::Index>& particle, Model<Dim>& model) {
  const auto& parts = body.joined.parts;
  std::vector<shape::Content> content;
  std::vector<double> volume;
  for (const shape::MeshPart& part : parts) {
    content.push_back(
        shape::content_of(body.mesh, body.mesh.elements[static_cast<std::size_t>(part.element)]));
    volume.push_back(content.back().volume);
  }
  // Of the whole body, so that regions come and go without a change to the others.
  const std::vector<double> spacing = shape::spacings(body.mesh, body.joined, volume);
  const auto count = std::ranges::count_if(particle, [](fpm::Index a) { return a >= 0; });
  model.particles.position.resize(count, Dim);
  model.particles.volume.resize(count);
  model.particles.spacing.resize(count);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const fpm::Index a = particle[p];
    if (a < 0) continue;
    model.particles.position.row(a) = place_of<Dim>(content[p].centroid).transpose();
    model.particles.volume[a] = content[p].volume;
    model.particles.spacing[a] = spacing[p];
    model.material.push_back(static_cast<MaterialIndex>(
        scene::material_of(scene, static_cast<std::size_t>(parts[p].region))));
  }
}

// Where elements of very different widths meet, or at slivers, their own widths do not reach the
// neighbours that a row needs: as many of its body as the corner of a lattice has.
template <int Dim>
void widen_spacings(const fpm::RowOptions& options, Model<Dim>& model) {
  constexpr std::size_t fewest = Dim == 2 ? 7 : 16;
  constexpr double widening = 1.1, most = 8.0;
  const double reach = options.support_radius / options.spacing;
  fpm::ParticleSet<Dim>& particles = model.particles;
  const fpm::NeighbourSearch<Dim> search(particles.position);
  std::vector<fpm::Index> near;
  for (fpm::Index a = 0; a < particles.size(); ++a) {
    const auto enough = [&](double spacing) {
      search.within(particles.position.row(a).transpose(), reach * spacing, near);
      if (!particles.body.empty()) {
        std::erase_if(near, [&](fpm::Index b) {
          return particles.body[static_cast<std::size_t>(a)] !=
                 particles.body[static_cast<std::size_t>(b)];
        });
      }
      return near.size() > fewest;  // itself included
    };
    double spacing = particles.spacing[a];
    while (!enough(spacing) && spacing < most * particles.spacing[a]) spacing *= widening;
    particles.spacing[a] = spacing;
  }
}

template <int Dim>
SurfacePiece<Dim> piece_of(const shape::GmshMesh& mesh, const std::vector<int>& facet,
                           const shape::FacetPiece& piece, fpm::Index particle) {
  if constexpr (Dim == 2) {
    return {mesh.plane_at(facet[0]), mesh.plane_at(facet[1]), particle};
  } else {
    return {piece.middle, piece.area.normalized(), piece.area.norm(), particle};
  }
}

JointPiece<2> joint_of(const SurfacePiece<2>& piece, fpm::Index beyond) {
  return {piece.from, piece.to, piece.particle, beyond};
}

JointPiece<3> joint_of(const SurfacePiece<3>& piece, fpm::Index beyond) {
  return {piece.middle, piece.outward, piece.area, piece.particle, beyond};
}

template <int Dim>
void add_facets(const scene::Scene& scene, const scene::ElementBody& body,
                const std::vector<fpm::Index>& particle, Model<Dim>& model) {
  for (std::size_t f = 0; f < body.joined.facets.size(); ++f) {
    const shape::MeshFacet& facet = body.joined.facets[f];
    fpm::Index own = particle[static_cast<std::size_t>(facet.part)];
    fpm::Index beyond = facet.beyond < 0 ? -1 : particle[static_cast<std::size_t>(facet.beyond)];
    if (own < 0 && beyond < 0) continue;
    std::vector<int> nodes = facet.nodes;
    if (own < 0) {
      std::swap(own, beyond);
      std::ranges::reverse(nodes);
    }
    if (beyond >= 0 && model.material[static_cast<std::size_t>(own)] ==
                           model.material[static_cast<std::size_t>(beyond)]) {
      continue;
    }
    const auto face = facet.beyond < 0 ? scene::face_of(scene, body.mesh, nodes) : std::nullopt;
    for (const shape::FacetPiece& flat : shape::flat_pieces(body.mesh, nodes)) {
      SurfacePiece<Dim> piece = piece_of<Dim>(body.mesh, nodes, flat, own);
      if (beyond >= 0) {
        model.joints.push_back(joint_of(piece, beyond));
        continue;
      }
      piece.side = facet.beyond < 0 ? body.side[f] : exposed_side;
      if (face) piece.face = static_cast<int>(*face);
      model.surface.push_back(piece);
    }
  }
}

template <int Dim>
void part_elements(const scene::Scene& scene, const scene::ElementBody& body,
                   const std::vector<fpm::Index>& particle, Model<Dim>& model) {
  std::vector<std::pair<fpm::Index, fpm::Index>> meeting;
  for (const shape::MeshFacet& facet : body.joined.facets) {
    if (facet.beyond < 0) continue;
    const fpm::Index a = particle[static_cast<std::size_t>(facet.part)];
    const fpm::Index b = particle[static_cast<std::size_t>(facet.beyond)];
    if (a >= 0 && b >= 0) meeting.emplace_back(a, b);
  }
  const std::vector<fpm::Index> label(model.material.begin(), model.material.end());
  auto bodies = fpm::bodies_of(label, meeting, [&](fpm::Index low, fpm::Index high) {
    return scene::interface_between(scene, static_cast<std::size_t>(low),
                                    static_cast<std::size_t>(high))
               .kind == scene::InterfaceKind::through;
  });
  if (std::ranges::max(bodies) > 0) model.particles.body = std::move(bodies);
}

}  // namespace

template <int Dim>
void place_elements(const scene::Scene& scene, Model<Dim>& model) {
  const scene::ElementBody body = scene::elements_of(scene);
  const std::vector<fpm::Index> particle = number_particles(scene, body);
  add_particles(scene, body, particle, model);
  add_facets(scene, body, particle, model);
  part_elements(scene, body, particle, model);
  widen_spacings(model.row_options, model);
  model.background = cells_behind(model);
}

template void place_elements<2>(const scene::Scene&, Model<2>&);
template void place_elements<3>(const scene::Scene&, Model<3>&);

}  // namespace model
