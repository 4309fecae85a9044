#pragma once

#include "tables/diagnosis.hpp"

namespace scene {

struct Scene;
struct ElementBody;

/// The box around a body of elements, exactly, and the spacing of its finest ones. Others that the
/// scene gives are errors of the diagnosis.
void complete_box_of_elements(Scene& scene, const ElementBody& body, tables::Diagnosis& diagnosis);

/// The one footing of a solid body is where its drive acts: a level or upright part of the surface,
/// by contact of its faces.
void complete_drive_of_solid(Scene& scene, const ElementBody& body, tables::Diagnosis& diagnosis);

}  // namespace scene
