#pragma once

#include <cstddef>
#include <vector>

#include "fpm/ghosts.hpp"
#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// The planes behind which a scene's body has images: the driven side (first, as it may be a part
/// of one), the supports by ghosts, and the mirrors. Supports of one side share a plane.
template <int Dim>
std::vector<fpm::GhostPlane<Dim>> ghost_planes(const scene::Scene& scene);

/// Where in a field over unknowns stand the reactions of the planes on a side, in the directions
/// they hold. Where two sides meet, a direction across one of them counts for that one alone.
template <int Dim>
std::vector<Eigen::Index> borne_by_planes(const Model<Dim>& model, int axis, double position);

/// Place of the driven side among them, if it is driven by ghosts.
inline constexpr std::size_t driven_plane = 0;

}  // namespace model
