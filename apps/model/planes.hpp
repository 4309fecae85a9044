#pragma once

#include <cstddef>
#include <vector>

#include "fpm/ghosts.hpp"
#include "model/model.hpp"
#include "scene/choices.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The planes behind which a scene's body has images: the driven side (first, as it may be a part
/// of one), the supports by ghosts, and the mirrors. Supports of one side share a plane.
template <int Dim>
std::vector<fpm::GhostPlane<Dim>> ghost_planes(const scene::Scene& scene);

/// The particles that have images by the planes at a place which are no mirrors, ascending.
template <int Dim>
std::vector<Eigen::Index> sources_of_planes(const Model<Dim>& model, int axis, double position);

/// The side of the box that each plane of a model lies on, or is parallel to.
template <int Dim>
std::vector<scene::Side> sides_of_planes(const scene::Scene& scene, const Model<Dim>& model);

/// Place of the driven side among them, if it is driven by ghosts.
inline constexpr std::size_t driven_plane = 0;

/// For each plane, whether the body goes on behind it as its images do, from the beginning on: of
/// symmetry, or one along which it slides freely, that does not move and that no weight presses on.
template <int Dim>
[[nodiscard]] std::vector<char> mirrors(const scene::Scene& scene, const Model<Dim>& model);

}  // namespace model
