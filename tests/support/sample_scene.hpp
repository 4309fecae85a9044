#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace support {

// A small scene without a fault; the line numbers matter to the tests of messages.
inline constexpr std::string_view sample_scene = R"(title = "sample"
[geometry]
dimension = 2
min = [0.0, -1.0]
max = [2.0, 0.0]
spacing = 0.1
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 50e6
poissons_ratio = 0.4
cohesion = 2.5e3
friction_angle = 20.0
dilation_angle = 10.0
density = 1850.0
[[symmetry]]
axis = "x"
position = 0.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[gravity]
acceleration = [0.0, -9.81]
[initial_stress]
kind = "geostatic"
[drive]
kind = "displacement"
range_min = 0.0
range_max = 0.5
direction = [0.0, -1.0]
target = 0.05
width = 0.5
)";

// A block of clay that is pressed upon more and more, in as many steps as one more line says.
inline constexpr std::string_view pressed_block = R"([geometry]
min = [0, 0]
max = [2, 1]
spacing = 0.25
[[material]]
name = "m"
model = "von_mises"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 1e4
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[traction]]
name = "q"
side = "top"
value = [0.0, -1e3]
[drive]
kind = "load"
scales = ["traction"]
[programme]
)";

/// The sample with the only occurrence of `what` replaced; a test whose place is gone must fail.
inline std::string sample_with(std::string_view what, std::string_view instead) {
  std::string text(sample_scene);
  const std::size_t at = text.find(what);
  if (at == std::string::npos || text.find(what, at + 1) != std::string::npos) {
    throw std::logic_error("not exactly once in the sample scene: " + std::string(what));
  }
  return text.replace(at, what.size(), instead);
}

}  // namespace support
