#pragma once

#include <string>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace run {

/// A plane scene as an SVG picture: its particles, each as large as what it stands for, in the
/// colour of its material; its surface and interfaces; what holds, loads and moves it, by name.
std::string drawing_of(const scene::Scene& scene, const model::Model<2>& model);

}  // namespace run
