#pragma once

#include <sstream>
#include <string>

#include "measure.hpp"

namespace verification {

/// A number with all its digits, as a spacing needs that is to divide an extent.
inline std::string in_full(double value) {
  std::ostringstream text;
  text.precision(17);
  text << value;
  return text.str();
}

/// A plate pressed into clay in three dimensions: small strain, E / c = 1000 as in the strips, a
/// half width of 1 m, cohesion 1 kPa; held and driven by particles, which a test may choose among.
inline std::string clay_in_3d(const std::string& extent, const std::string& plate,
                              const std::string& sides) {
  return "[geometry]\ndimension = 3\nmin = [0.0, -2.0, 0.0]\nmax = " + extent +
         "\nspacing = 0.25\n[approximation]\nkinematics = \"small_strain\"\n"
         "[[material]]\nname = \"clay\"\nmodel = \"von_mises\"\nyoungs_modulus = 1e6\n"
         "poissons_ratio = 0.4\ncohesion = 1e3\n[hourglass]\ncontrol = \"mixed\"\n"
         "[[symmetry]]\naxis = \"x\"\nposition = 0.0\n"
         "[[symmetry]]\naxis = \"z\"\nposition = 0.0\n" +
         sides +
         "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\", \"z\"]\n"
         "method = \"direct\"\n"
         "[[support]]\nname = \"far side\"\nside = \"right\"\ndirections = [\"x\"]\n"
         "method = \"direct\"\n"
         "[drive]\nkind = \"displacement\"\nmethod = \"direct\"\nside = \"top\"\nrange_min = [0.0, "
         "0.0]\n"
         "direction = [0.0, -1.0, 0.0]\nlateral = \"fixed\"\nreference_length = 1.0\n" +
         plate + "[programme]\nsteps = 40\n";
}

}  // namespace verification
