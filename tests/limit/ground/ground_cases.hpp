#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <variant>
#include <vector>

#include "limit/bracket/solve.hpp"
#include "limit/ground/ground_case.hpp"
#include "scene/reader.hpp"

namespace limit {

/// What is known of a scene of share/scenes/limit, and from where: its collapse lies in between.
struct KnownGround {
  const char* scene;
  double low, high;
  const char* source;
};

inline void PrintTo(const KnownGround& known, std::ostream* out) {
  *out << known.scene;
}

inline std::vector<KnownGround> known_grounds() {
  constexpr double pi = std::numbers::pi;
  constexpr double prandtl = 1e3 * (2.0 + pi);
  // Polygons of 2.5 degrees lie between circles of radii that differ by this factor.
  const double chord = std::cos(1.25 * pi / 180.0);
  const auto tresca = [](double ratio) { return 2e3 * std::log(ratio); };
  const auto frictional = [](double ratio) {
    const double phi = 20.0 * pi / 180.0, sine = std::sin(phi);
    return 1e3 / std::tan(phi) * (std::pow(ratio, 2.0 * sine / (1.0 + sine)) - 1.0);
  };
  const double green = 1e3 * (1.0 + pi / 2 + std::acos(0.5) + std::sqrt(0.75));
  const double unconfined = 2.0 * 15e3 * std::tan(55.0 * pi / 180.0);
  // The angle in the scene has six decimals.
  const double digits = 1e-6;
  return {
      {"vertical_cut", 3.776, 3.778, "Lyamin & Sloan 2002 below, Pastor et al. 2000 above"},
      {"vertical_cut_cracked", 2.0, 3.778, "columns by themselves; the same with all its tension"},
      {"slope", 0.0, 10.3907, "the best logarithmic spiral through the toe (Chen 1975)"},
      {"slope_safety", 1.0, 1.25189, "the same spiral with the strength divided"},
      {"slope_gentle", 1.0, 1.3540, "the best logarithmic spiral with the strength divided"},
      {"acads_layers", 1.357, 1.405, "methods of slices, Janbu to Bishop (ACADS 1c, 1.39)"},
      {"earthquake", 0.425, 0.435, "critical kh to two digits (Loukidis et al. 2003)"},
      // Circle about (1.2067, 0.2917) B off the edge: 2 R^2 (c1 t1 + c2 t2) / (B (x - B/2)), t the
      // half angles in crust and clay.
      {"two_layers", prandtl, 7.79860e3, "the soft clay alone; the best slip circle (Button 1953)"},
      {"strength_with_depth", (2.0 + pi) * 10e3 + 20e3 * 2.0 / 4.0, 12.4942 * 10e3,
       "F >= 1 in F ((2 + pi) c + k B / 4), Davis & Booker 1973; the best slip circle"},
      {"inclined", green * (1.0 - digits), green * (1.0 + digits), "Green 1954"},
      {"eccentric", 0.75 * prandtl, prandtl, "Meyerhof's effective width; centric load"},
      {"eccentric_lift_off", 0.5 * prandtl, 0.5 * 5.52e3,
       "Meyerhof's effective width; the best slip circle, 5.52 c over the same width"},
      {"flexible", prandtl, prandtl, "Prandtl 1920"},
      {"smooth_platens", unconfined, unconfined, "2 c tan(45 + phi/2)"},
      {"rough_platens", 2e3, 2e3, "2 c for a width up to the height"},
      {"cylinder", tresca(2.0 * chord), tresca(2.0 / chord), "2 c ln(b/a)"},
      {"cylinder_friction", frictional(2.0 * chord), frictional(2.0 / chord),
       "c cot(phi) ((b/a)^(2 sin(phi) / (1 + sin(phi))) - 1)"},
  };
}

/// The case of a scene's text, with settings.
inline std::optional<problem::Cases> case_of(const std::string& text,
                                             const std::vector<std::string>& settings = {},
                                             const std::string& source = "scene") {
  tables::Diagnosis diagnosis(source);
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, settings, diagnosis, unreadable);
  std::optional<problem::Cases> found;
  if (scene) found = ground::ground_case(*scene, diagnosis);
  for (const tables::Complaint& one : diagnosis.errors()) ADD_FAILURE() << one.text();
  return found;
}

/// The case of a shipped scene, with settings.
inline std::optional<problem::Cases> shipped(const char* name,
                                             const std::vector<std::string>& settings = {}) {
  const auto file =
      std::filesystem::path(FPM_SHARE_DIR) / "scenes" / "limit" / (std::string(name) + ".toml");
  return case_of(std::get<std::string>(scene::text_of(file)), settings, file.string());
}

}  // namespace limit
