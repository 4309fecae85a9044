// Faces at which bodies meet, as a scene makes them.
#include "model/interfaces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
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
    weaken.push_back(face.weakens_at(0));
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

// Of a side that two materials share each point has its own.
TEST(Interfaces, WeakenPointByPointWhereASideIsOfTwoMaterials) {
  std::string text = layers(
      "[programme]\nsteps = 4\n[drive]\nkind = \"strength\"\ntarget = 2.0\n"
      "weakened = [\"1\"]\n");
  const std::string above = "region_min = [0.0, 1]\nregion_max = [1.0, 2]";
  text.replace(text.find(above), above.size(), "region_min = [0.5, 0]\nregion_max = [1.0, 3]");
  const scene::SceneReading reading =
      scene::parse_scene(text, "scene", std::vector<std::string>{"geometry.spacing=0.125"});
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  const Model<2> model = build_model<2>(*reading.scene);
  const Interface<2>& base = model.interfaces.back();
  ASSERT_EQ(base.support, "base");
  for (fpm::Index c = 0; c < base.faces.points.size(); ++c) {
    EXPECT_EQ(base.weakens_at(c), base.faces.points.position(c, 0) > 0.5);
  }
}

// Tied clays slide at the lesser of both cohesions, of which that which is weakened is divided.
TEST(Interfaces, OfTiedClaysDivideTheCohesionThatIsWeakened) {
  const auto face_of = [](const std::string& weakened) {
    std::string text =
        "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 2.0]\nspacing = 0.25\n[approximation]\n"
        "kinematics = \"small_strain\"\n[[support]]\nname = \"base\"\nside = \"bottom\"\n"
        "directions = [\"x\", \"y\"]\n[programme]\nsteps = 4\n[drive]\nkind = \"strength\"\n"
        "target = 2.0\nweakened = " +
        weakened + "\n";
    for (const auto& [name, cohesion, region] :
         {std::tuple("soft", "10e3", ""),
          std::tuple("hard", "100e3", "region_min = [0.0, 1.0]\nregion_max = [1.0, 2.0]\n")}) {
      text += fmt::format(
          "[[material]]\nname = \"{}\"\nmodel = \"von_mises\"\nyoungs_modulus = 1e7\n"
          "poissons_ratio = 0.3\ncohesion = {}\n{}",
          name, cohesion, region);
    }
    const scene::SceneReading reading = scene::parse_scene(text, "scene");
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return build_model<2>(*reading.scene).interfaces.at(0);
  };
  constexpr double none = std::numeric_limits<double>::infinity();
  for (const auto& [weakened, divided, kept] :
       {std::tuple("[\"soft\"]", 10e3, 100e3), std::tuple("[\"hard\"]", 100e3, 10e3),
        std::tuple("[\"soft\", \"hard\"]", 10e3, none)}) {
    const Interface<2> face = face_of(weakened);
    EXPECT_EQ(face.law.adhesion, 10e3);
    EXPECT_TRUE(face.weakens_at(0));
    EXPECT_EQ(face.divided_adhesion, divided) << weakened;
    EXPECT_EQ(face.kept_adhesion, kept) << weakened;
  }
}

}  // namespace
}  // namespace model
