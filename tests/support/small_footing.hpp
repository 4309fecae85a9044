#pragma once

#include <string>

namespace support {

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

}  // namespace support
