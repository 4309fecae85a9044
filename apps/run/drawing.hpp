#pragma once

#include <string>
#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace run {

/// A plane scene as an SVG picture: its particles, each as large as what it stands for, in the
/// colour of its material; its surface and interfaces; what holds, loads and moves it, by name.
/// @param notes  lines of the legend besides
std::string drawing_of(const scene::Scene& scene, const model::Model<2>& model,
                       const std::vector<std::string>& notes = {});

/// A body in space, likewise, seen from two opposite corners of its box, so that each of its faces
/// is seen once: a tile for each particle's part of the surface.
std::string drawing_of(const scene::Scene& scene, const model::Model<3>& model,
                       const std::vector<std::string>& notes = {});

}  // namespace run
