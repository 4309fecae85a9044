#pragma once

#include <fmt/format.h>

#include <string>

namespace extremes {

// What the scenes of the sweeps are put together of.

inline const std::string small_strain = "[approximation]\nkinematics = \"small_strain\"\n";
inline const std::string tightly =
    "[programme]\nsteps = 1\n[solver]\ntolerance = 1e-10\nmax_evaluations_per_step = 5000\n";

inline std::string elastic(double youngs_modulus, double poissons_ratio) {
  return fmt::format(
      "[[material]]\nname = \"elastic\"\nmodel = \"elastic\"\nyoungs_modulus = {}\n"
      "poissons_ratio = {}\n",
      youngs_modulus, poissons_ratio);
}

inline std::string box(double x, double y, double width, double height, double spacing) {
  return fmt::format("[geometry]\nmin = [{}, {}]\nmax = [{}, {}]\nspacing = {}\n", x, y, x + width,
                     y + height, spacing);
}

inline const std::string on_rollers =
    "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\n"
    "[[support]]\nname = \"wall\"\nside = \"left\"\ndirections = [\"x\"]\n";

inline std::string pressed_by(double pressure) {
  return fmt::format(
      "[[traction]]\nname = \"load\"\nside = \"top\"\nvalue = [0.0, {}]\n"
      "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n",
      -pressure);
}

}  // namespace extremes
