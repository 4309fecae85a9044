#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/choices.hpp"
#include "shape/outline.hpp"
#include "tables/diagnosis.hpp"

namespace scene {

struct Scene;

/// The regions of a scene, joined, with its sides; what is no ground is an error of the diagnosis.
[[nodiscard]] shape::Outline join_regions(const Scene& scene, tables::Diagnosis& diagnosis);

/// The regions of a completed scene, joined, with its sides.
[[nodiscard]] shape::Outline outline_of(const Scene& scene);

/// Index of the side that is a footing.
[[nodiscard]] std::optional<std::size_t> footing_of(const Scene& scene);

/// Whether a side holds the body: particles are tied to it, where no support or mirror holds it.
[[nodiscard]] bool holds(OutlineKind kind);

/// Index of a region's material.
[[nodiscard]] std::size_t material_of(const Scene& scene, std::size_t region);

/// Index of the material of the region that holds a place, or is nearest to it.
[[nodiscard]] std::size_t material_of_region_at(const Scene& scene, const shape::Outline& outline,
                                                std::span<const double> place);

/// Materials of the regions, of plane bodies and prisms, that a place is in or within `slack` of.
[[nodiscard]] std::vector<std::size_t> materials_of_regions_at(const Scene& scene,
                                                               const shape::Outline& outline,
                                                               std::span<const double> place,
                                                               double slack);

/// Whether a support or a mirror holds a face of the box.
[[nodiscard]] bool is_held(const Scene& scene, Side face);

/// Corners of the outline where stress is singular: re-entrant ones, and ends of pressures.
[[nodiscard]] std::vector<shape::Point> singular_corners(const Scene& scene);

}  // namespace scene
