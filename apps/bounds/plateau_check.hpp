#pragma once

#include <optional>
#include <string>
#include <vector>

#include "record/curve.hpp"

namespace scene {
struct Scene;
}

namespace bounds {

/// Where the curve of a particle run lies against a bracket of its collapse load.
struct PlateauCheck {
  enum class Place { below, inside, above };

  double plateau = 0.0;     // [Pa] mean over the last fifth of the settlement
  double settlement = 0.0;  // [m] reached
  Place place = Place::inside;
  double distance = 0.0;               // of the plateau from the bracket, over the bound passed
  std::optional<double> passed_lower;  // [m] settlement at which the pressure first exceeds it
  std::optional<double> passed_upper;
  std::vector<std::string> reasons;  // why it may lie where it does
};

/// Compares a curve with the bounds [Pa].
/// @throws std::invalid_argument for a curve without settlement, or a scene without drive.width,
/// whose curve has no mean pressure.
[[nodiscard]] PlateauCheck check_plateau(const std::vector<record::CurveRow>& curve,
                                         const scene::Scene& scene, double lower, double upper);

/// The comparison in some lines of text.
[[nodiscard]] std::string text_of(const PlateauCheck& check);

}  // namespace bounds
