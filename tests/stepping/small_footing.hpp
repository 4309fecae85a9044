#pragma once

#include <omp.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "stepping/stepper.hpp"

namespace stepping {

/// A plane footing of 96 particles, which yields from its first steps on.
inline const std::string small_footing = R"(
[geometry]
dimension = 2
min = [0.0, -2.0]
max = [3.0, 0.0]
spacing = 0.25
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 1e3
friction_angle = 20.0
dilation_angle = 5.0
density = 1800.0
[[symmetry]]
axis = "x"
position = 0.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "far side"
side = "right"
directions = ["x"]
[gravity]
acceleration = [0.0, -9.81]
[initial_stress]
kind = "geostatic"
[drive]
kind = "displacement"
side = "top"
range_min = 0.0
range_max = 1.0
direction = [0.0, -1.0]
target = 0.15
reference_length = 1.0
width = 1.0
[programme]
steps = 20
)";

/// The small footing with settings as --set takes them, and what advances it.
struct SmallFooting {
  explicit SmallFooting(const std::vector<std::string>& settings = {},
                        const std::string& tables = "")
      : scene(read(settings, tables)),
        model(model::build_model<2>(scene)),
        state(model::initial_state(model, scene)),
        stepper(scene, model, state) {
    omp_set_num_threads(1);  // so few particles keep no more of them busy
  }
  SmallFooting(const SmallFooting&) = delete;
  SmallFooting& operator=(const SmallFooting&) = delete;

  static scene::Scene read(const std::vector<std::string>& settings, const std::string& tables) {
    const auto reading = scene::parse_scene(small_footing + tables, "small footing", settings);
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return *reading.scene;
  }

  scene::Scene scene;
  model::Model<2> model;
  model::State<2> state;
  LoadStepper<2> stepper;
  double load = 0.0;  // of the plate, for a test to note [N/m]
};

}  // namespace stepping
