#pragma once

#include <string>

#include "fpm/particles.hpp"
#include "fpm/points.hpp"
#include "model/model.hpp"
#include "model/surface.hpp"
#include "scene/choices.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// A part of a side as points: lumped to the particles of a vertex lattice, which lie on it, or
/// true boundary points that the particles are interpolated to.
/// @param range_min, range_max  [m] Dim - 1 entries each, or empty: the whole side
template <int Dim>
SurfacePoints<Dim> side_points(const scene::Scene& scene, const Model<Dim>& model, scene::Side side,
                               const std::vector<double>& range_min,
                               const std::vector<double>& range_max);

/// Whether a place on a side is in such a range along it.
template <int Dim>
bool is_within_range(const scene::Scene& scene, scene::Side side, const fpm::Vector<Dim>& place,
                     const std::vector<double>& range_min, const std::vector<double>& range_max);

/// What a piece of the surface is called, `the side "face"`; -1 stands for none.
/// @param cut, side, face  as a SurfacePiece has them
std::string name_of_surface(const scene::Scene& scene, int cut, int side, int face);

/// Whether a uniform initial stress loads such a piece, as the ground goes on beyond it.
bool is_loaded_by_stress(const scene::Scene& scene, int cut, int side, int face);

/// Whether the particles are the vertices of a lattice without jitter.
bool is_plain_vertex_lattice(const scene::Scene& scene);

}  // namespace model
