#pragma once

#include "model/model.hpp"

namespace model {

/// Cells of a tree behind particles that have none around them, for a grid: once to twice as wide
/// as particles are apart there, and wide where there are none; narrower ones hold no particle here
/// and there, and solves take up to twice the evaluations. The box holds a whole number of the
/// widest: what is left over would be filled by narrower ones, whatever particles are there.
/// @param model  with its box, spacing and particles
template <int Dim>
fpm::Cells<Dim> cells_behind(const Model<Dim>& model);

}  // namespace model
