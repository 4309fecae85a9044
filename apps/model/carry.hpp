#pragma once

#include <vector>

#include "model/model.hpp"
#include "model/state.hpp"

namespace model {

/// Of each particle of a model the same one, by its cell, in another model of the same box; -1 for
/// none.
template <int Dim>
std::vector<fpm::Index> same_particles(const Model<Dim>& of, const Model<Dim>& in);

/// Gives faces that were there before, by their places, the traction that they had at first.
template <int Dim>
void carry_initial_tractions(const Model<Dim>& before, Model<Dim>& after);

/// Gives Cam clay that was there at first the preconsolidation it had: whatever lies on it or
/// stands in it now, that is history.
template <int Dim>
void keep_consolidation(const Model<Dim>& first, Model<Dim>& after);

/// The state of a run that goes on with another body, or other values or supports: of particles
/// that stay all that they had; of new ones no stress, and the displacement of the ground they are
/// put on, with which they and those around remember no shape. Faces that stay keep slip and
/// traction; new ones bear nothing where they are.
/// @param keeps_rows  no particle and no support is another one
/// @param load  load parameter at which it goes on: rigid bodies are where they are then
template <int Dim>
State<Dim> carry_state(const Model<Dim>& before, State<Dim>& state, const Model<Dim>& after,
                       bool keeps_rows, double load);

}  // namespace model
