#pragma once

#include "model/model.hpp"

namespace model {

/// What a plane body's surface, joints and area become between two heights along z, for `extrude`
/// and `cut_prisms`. Particles are those of the section: who calls says which they are in space.

/// A wall over a piece of the surface.
SurfacePiece<3> prism_wall(const SurfacePiece<2>& piece, double middle, double height);

/// A face over a piece of a joint.
JointPiece<3> prism_joint(const JointPiece<2>& joint, double middle, double height);

/// The end of a particle's prism: face 4, front, or 5, back.
SurfacePiece<3> prism_end(const Model<2>& section, fpm::Index particle, double z, int face);

}  // namespace model
