#pragma once

#include "limit/ground/ground_scene.hpp"
#include "shape/outline.hpp"

namespace limit::ground {

using GroundSegment = shape::OutlineSegment;
using GroundOutline = shape::Outline;
using shape::distance;
using shape::is_inside;

/// The ground's polygons joined, with their sides; what is no ground is an error of the diagnosis.
[[nodiscard]] GroundOutline ground_outline(const GroundScene& scene, tables::Diagnosis& diagnosis);

}  // namespace limit::ground
