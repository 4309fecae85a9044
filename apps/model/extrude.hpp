#pragma once

#include "model/model.hpp"

namespace model {

/// Layers of a plane body's particles along z, one spacing apart, as those of prisms, with their
/// materials, bodies, surface and joints; the prisms' ends are surface on the faces front and back.
/// @param section  with particles, materials, surface and joints
/// @param model  with its box and spacing
void extrude(const Model<2>& section, Model<3>& model);

}  // namespace model
