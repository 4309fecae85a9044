#pragma once

#include <string>

namespace verification {

/// A column of 1 m by 1 m between smooth walls, the upper 2 m of its 6 m a region of their own,
/// settled under its weight.
namespace solid_column {

inline constexpr double weight = 20e3;  // [N/m3]
inline constexpr double oedometric =
    1e7 * 0.75 / (1.25 * 0.5);  // E (1 - nu) / ((1 + nu)(1 - 2 nu))
inline const std::string scene = R"(
[geometry]
dimension = 3
depth = [0, 1]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.25
unit_weight = 20e3
[[region]]
name = "low"
material = "m"
outline = [[0, 0], [1, 0], [1, 4], [0, 4]]
[[region]]
name = "high"
material = "m"
outline = [[0, 4], [1, 4], [1, 6], [0, 6]]
[[side]]
name = "top"
kind = "free"
along = [[1, 6], [0, 6]]
[[side]]
name = "left"
kind = "roller"
along = [[0, 6], [0, 0]]
[[side]]
name = "base"
kind = "roller"
along = [[0, 0], [1, 0]]
[[side]]
name = "right"
kind = "roller"
along = [[1, 0], [1, 6]]
[[support]]
name = "front"
side = "front"
directions = ["z"]
[[support]]
name = "back"
side = "back"
directions = ["z"]
[initial_stress]
kind = "gravity"
)";

}  // namespace solid_column
}  // namespace verification
