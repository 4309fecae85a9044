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

/// Indices of the regions whose surface a side is.
[[nodiscard]] std::vector<std::size_t> regions_at(const Scene& scene, std::size_t side);

/// Index of a region's material.
[[nodiscard]] std::size_t material_of(const Scene& scene, std::size_t region);

/// Index of the material of the region that holds a place, or is nearest to it.
[[nodiscard]] std::size_t material_of_region_at(const Scene& scene, const shape::Outline& outline,
                                                std::span<const double> place);

/// Whether a support or a mirror holds a face of the box.
[[nodiscard]] bool is_held(const Scene& scene, Side face);

/// Names of the surfaces that particles are tied to: cutouts and sides that hold the body where no
/// support or mirror does.
[[nodiscard]] std::vector<std::string> tied_surfaces(const Scene& scene);

/// Corners of the outline where stress is singular: re-entrant ones, and ends of pressures.
[[nodiscard]] std::vector<shape::Point> singular_corners(const Scene& scene);

}  // namespace scene
