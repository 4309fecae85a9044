#pragma once

#include <span>
#include <string>
#include <vector>

#include "files/vtkhdf.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace model {

/// Current positions for write_vtkhdf [m], 3 per particle.
template <int Dim>
std::vector<double> current_points(const Model<Dim>& model, const State<Dim>& state);

/// The particle fields that a scene's [output] fields can name, of one converged state; those the
/// scene does not have (plastic strains of an elastic body) are left out.
/// @param names  the fields wanted; empty: all
template <int Dim>
std::vector<files::PointField> particle_fields(const Model<Dim>& model, const State<Dim>& state,
                                               std::span<const std::string> names);

}  // namespace model
