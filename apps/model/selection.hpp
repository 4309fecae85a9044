#pragma once

#include <vector>

#include "model/model.hpp"

namespace scene {
struct Drive;
struct Scene;
struct Support;
}  // namespace scene

namespace model {

/// Whether a particle belongs to the layer next to a side of the box.
template <int Dim>
bool on_side(const scene::Scene& scene, const Model<Dim>& model, scene::Side side, Eigen::Index a);

/// Whether a particle lies in a part of a side (Dim - 1 entries each); empty: the whole side.
template <int Dim>
bool in_side_range(const scene::Scene& scene, const Model<Dim>& model, scene::Side side,
                   const std::vector<double>& min, const std::vector<double>& max, Eigen::Index a);

/// The particle nearest to a place; of several as near, the first of the lattice.
template <int Dim>
Eigen::Index nearest_particle(const scene::Scene& scene, const std::vector<double>& at,
                              const Model<Dim>& model);

/// The particles next to the part of a side that a drive moves.
template <int Dim>
std::vector<Eigen::Index> driven_particles(const scene::Scene& scene, const scene::Drive& drive,
                                           const Model<Dim>& model);

/// The particles that a support holds.
template <int Dim>
std::vector<Eigen::Index> supported_particles(const scene::Scene& scene,
                                              const scene::Support& support,
                                              const Model<Dim>& model);

}  // namespace model
