#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limit/ground/ground_case.hpp"

namespace limit {

// A footing on two layers; the lower one carries a name.
inline constexpr const char* layered = R"([load]
sought = "footing"
[[material]]
name = "crust"
cohesion = 2.0
[[material]]
name = "soft"
cohesion = 1.0
[[region]]
name = "crust"
material = "crust"
outline = [[0, -1], [4, -1], [4, 0], [0, 0]]
[[region]]
name = "soft"
material = "soft"
outline = [[0, -2], [4, -2], [4, -1], [0, -1]]
[[side]]
name = "footing"
kind = "footing"
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [4, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, -2], [4, -2], [4, 0]]
)";

inline constexpr const char* cut = R"([load]
sought = "gravity"
[[material]]
name = "clay"
cohesion = 1.0
unit_weight = 1.0
[[region]]
material = "clay"
outline = [[-2, -1], [2, -1], [2, 1], [0, 1], [0, 0], [-2, 0]]
[[side]]
name = "cut"
kind = "free"
along = [[-2, 0], [0, 0], [0, 1], [2, 1]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[-2, 0], [-2, -1], [2, -1], [2, 1]]
)";

// A block whose top is sheared, between free sides.
inline constexpr const char* sheared = R"([load]
sought = "traction"
[[material]]
name = "clay"
cohesion = 1.0
[[region]]
material = "clay"
outline = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[side]]
name = "top"
kind = "loaded"
live_shear = 1
along = [[0, 1], [4, 1]]
[[side]]
name = "left"
kind = "free"
along = [[0, 0], [0, 1]]
[[side]]
name = "right"
kind = "free"
along = [[4, 0], [4, 1]]
[[side]]
name = "floor"
kind = "fixed"
along = [[0, 0], [4, 0]]
)";

// The case, or every error said, a line each.
struct Read {
  std::optional<ground::GroundScene> scene;
  std::optional<problem::Cases> found;
  std::string errors;
};

inline Read read(std::string_view text, const std::vector<std::string>& settings = {}) {
  Read result;
  tables::Diagnosis diagnosis("ground.toml");
  std::optional<tables::Complaint> unreadable;
  result.scene = ground::read_ground_scene(text, settings, diagnosis, unreadable);
  if (unreadable) result.errors += unreadable->text() + '\n';
  if (result.scene) result.found = ground::ground_case(*result.scene, diagnosis);
  for (const tables::Complaint& one : diagnosis.errors()) result.errors += one.text() + '\n';
  return result;
}

}  // namespace limit
