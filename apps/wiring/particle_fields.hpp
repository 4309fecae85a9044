#pragma once

#include <span>
#include <string>
#include <vector>

#include "wiring/model.hpp"
#include "wiring/state.hpp"
#include "wiring/vtkhdf.hpp"

namespace wiring {

/// Current positions for write_vtkhdf [m], 3 per particle.
template <int Dim>
std::vector<double> current_points(const Model<Dim>& model, const State<Dim>& state);

/// The particle fields that a scene's [output] fields can name, of one converged state; those the
/// scene does not have (plastic strains of an elastic body) are left out.
/// @param reaction  residual over all unknowns, component-major; shown where displacement is given
/// @param names  the fields wanted; empty: all
template <int Dim>
std::vector<PointField> particle_fields(const Model<Dim>& model, const State<Dim>& state,
                                        const Eigen::VectorXd& reaction,
                                        std::span<const std::string> names);

}  // namespace wiring
