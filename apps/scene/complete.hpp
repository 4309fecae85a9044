#pragma once

#include "tables/diagnosis.hpp"

namespace scene {

struct Scene;

/// Completes a scene that has been read by what its other keys say: densities and gravity by unit
/// weights; the box of a body of regions; supports, mirrors and the drive's place by its sides. A
/// scene that was completed stays as it is.
void complete(Scene& scene, tables::Diagnosis& diagnosis);

}  // namespace scene
