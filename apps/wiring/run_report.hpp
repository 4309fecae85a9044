#pragma once

#include <cstddef>
#include <string>

#include "wiring/recorder.hpp"
#include "wiring/scene.hpp"

namespace wiring {

/// Particles, ghosts, memory and steps of a run that is not made, for --check.
/// @param bytes  of the state and of all that works on it
std::string check_report(const Scene& scene, std::size_t particles, std::size_t ghosts,
                         std::size_t bytes, std::size_t state_bytes);

/// What a run came to, and where its files are.
std::string end_report(const Scene& scene, const std::vector<CurveRow>& history, double elapsed,
                       const RunFolder& folder, const std::filesystem::path& checkpoint);

}  // namespace wiring
