#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "record/curve.hpp"
#include "record/run_folder.hpp"

namespace scene {
struct Scene;
}

namespace run {

/// Particles, ghosts, memory and steps of a run that is not made, for --check.
/// @param bytes  of the state and of all that works on it
std::string check_report(const scene::Scene& scene, std::size_t particles, std::size_t ghosts,
                         std::size_t bytes, std::size_t state_bytes);

/// What a run came to, and where its files are.
/// @param measures  columns of the curve that the scene asks for
std::string end_report(const scene::Scene& scene, const std::vector<std::string>& measures,
                       const std::vector<record::CurveRow>& history, double elapsed,
                       const record::RunFolder& folder, const std::filesystem::path& checkpoint);

}  // namespace run
