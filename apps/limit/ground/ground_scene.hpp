#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "limit/ground/ground_types.hpp"
#include "tables/diagnosis.hpp"

namespace limit::ground {

/// Reads such a scene from TOML text, settings (`--set`) applied. Only what can be judged key by
/// key is judged here. Nothing, if the diagnosis or `unreadable` has an error.
[[nodiscard]] std::optional<GroundScene> read_ground_scene(
    std::string_view text, std::span<const std::string> settings, tables::Diagnosis& diagnosis,
    std::optional<tables::Complaint>& unreadable);

/// Whether TOML text is such a scene, not one of fpm-run: it has regions.
[[nodiscard]] bool is_ground_scene(std::string_view text);

/// Every table and key of such a scene, for --help.
[[nodiscard]] std::string ground_scene_keys();

}  // namespace limit::ground
