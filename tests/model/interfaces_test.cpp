// Faces at which bodies meet, as a scene makes them.
#include "model/interfaces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Three layers of a box, the lowest on a rigid base, by contact everywhere.
std::string layers(const std::string& drive) {
  std::string text =
      "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 3.0]\nspacing = 0.25\n[approximation]\n"
      "interfaces = \"contact\"\n[gravity]\nacceleration = [0.0, -10.0]\n[[support]]\n"
      "name = \"base\"\nside = \"bottom\"\ndirections = [\"y\"]\nmethod = \"contact\"\n"
      "friction_angle = 20\n";
  for (const int k : {0, 1, 2}) {
    text += fmt::format(
        "[[material]]\nname = \"{}\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
        "poissons_ratio = 0.3\ndensity = 2e3\n",
        k);
    if (k == 0) continue;  // the first fills what the others leave
    text += fmt::format("region_min = [0.0, {}]\nregion_max = [1.0, {}]\n", k, k + 1);
  }
  return text + drive;
}

// Of the faces 0 to 1, 1 to 2 and 0 to the base, in this order.
std::vector<bool> that_weaken(const std::string& drive) {
  const scene::SceneReading reading = scene::parse_scene(layers(drive), "scene");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  std::vector<bool> weaken;
  for (const Interface<2>& face : build_model<2>(*reading.scene).interfaces) {
    weaken.push_back(face.weakens);
  }
  return weaken;
}

TEST(Interfaces, WeakenWithAMaterialBesideThem) {
  const std::string divides =
      "[programme]\nsteps = 4\n[drive]\nkind = \"strength\"\ntarget = 2.0\n";
  EXPECT_EQ(that_weaken(""), (std::vector<bool>{false, false, false}));
  EXPECT_EQ(that_weaken(divides), (std::vector<bool>{true, true, true}));
  EXPECT_EQ(that_weaken(divides + "weakened = [\"2\"]\n"), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(that_weaken(divides + "weakened = [\"0\"]\n"), (std::vector<bool>{true, false, true}));
}

}  // namespace
}  // namespace model
