#pragma once

#include <optional>

#include "tables/diagnosis.hpp"

namespace scene {
struct Scene;
}

namespace limit::ground {

/// A plane scene whose body is a box, in regions and sides: rectangles of its materials, and the
/// faces of the box by what holds, loads or presses them. What sides cannot say is an error of the
/// diagnosis.
/// @param tension  whether a footing holds on to the ground
[[nodiscard]] std::optional<scene::Scene> regions_of_box(const scene::Scene& box, bool tension,
                                                         tables::Diagnosis& diagnosis);

}  // namespace limit::ground
