// Layers too thin for rows of their own: said, and refused where the scene asks for their faces.
#include "model/thin_layers.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <stdexcept>

#include "model/build.hpp"
#include "model/given_interface.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string two_materials = [] {
  std::string text;
  for (const char* name : {"block", "seam"}) {
    text += fmt::format(
        "[[material]]\nname = \"{}\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
        "poissons_ratio = 0.3\n",
        name);
  }
  return text;
}();

// A block on a seam of so many particles across, as regions.
std::string on_a_seam(int across, const std::string& more = "") {
  return two_materials + fmt::format(R"(
[geometry]
spacing = 0.1
[[region]]
material = "seam"
outline = [[0, 0], [2, 0], [2, {0}], [0, {0}]]
[[region]]
material = "block"
outline = [[0, {0}], [2, {0}], [2, 2], [0, 2]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [2, 0]]
[[side]]
name = "rest"
kind = "free"
along = [[2, 0], [2, 2], [0, 2], [0, 0]]
{1})",
                                     0.1 * across, more);
}

template <int Dim = 2>
Model<Dim> model_of(const std::string& text) {
  const scene::SceneReading reading = scene::parse_scene(text, "scene");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  return build_model<Dim>(*reading.scene);
}

TEST(ThinLayers, AreOfOneBodyWithTheirNeighbourAndSaidToBe) {
  for (const int across : {1, 2}) {
    const Model<2> model = model_of(on_a_seam(across));
    EXPECT_TRUE(model.particles.body.empty());
    ASSERT_EQ(model.thin_layers.size(), 1U);
    EXPECT_EQ(model.thin_layers[0].layer, 1);
    EXPECT_EQ(model.thin_layers[0].beside, 0);
    EXPECT_LT(model.thin_layers[0].place.y(), 0.1 * across);
  }
  EXPECT_TRUE(model_of(on_a_seam(3)).thin_layers.empty());
  EXPECT_FALSE(model_of(on_a_seam(3)).particles.body.empty());
}

TEST(ThinLayers, AreNotSpokenOfWhereRowsGoThrough) {
  const std::string through =
      "[[interface]]\nbetween = [\"seam\", \"block\"]\nkind = \"through\"\n";
  EXPECT_TRUE(model_of(on_a_seam(1, through)).thin_layers.empty());
  EXPECT_TRUE(
      model_of(on_a_seam(1, "[approximation]\ninterfaces = \"through\"\n")).thin_layers.empty());
}

TEST(ThinLayers, HaveNoFaceThatTheSceneCouldAskFor) {
  for (const char* kind : {"tied", "contact"}) {
    const std::string face =
        fmt::format("[[interface]]\nbetween = [\"seam\", \"block\"]\nkind = \"{}\"\n", kind);
    try {
      static_cast<void>(model_of(on_a_seam(1, face)));
      ADD_FAILURE() << kind << " is not refused";
    } catch (const InterfaceRefused& refusal) {
      EXPECT_EQ(refusal.key, "interface.0.kind");
      EXPECT_THAT(refusal.found, AllOf(HasSubstr("\"seam\" is less than three particles thick"),
                                       HasSubstr("beside \"block\"")));
    }
  }
}

// Two thick bodies beside a thin layer that meets both are one through it: it is what is thin.
TEST(ThinLayers, AreNamedAndNotTheThickThatTheyJoin) {
  const auto ground = [](const std::string& more) {
    return two_materials +
           "[[material]]\nname = \"other\"\nmodel = \"elastic\"\n"
           "youngs_modulus = 1e6\npoissons_ratio = 0.3\n" +
           R"(
[geometry]
spacing = 0.1
[[region]]
material = "other"
outline = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[region]]
material = "seam"
outline = [[0, 1], [1, 1], [1, 1.1], [0, 1.1]]
[[region]]
material = "block"
outline = [[0, 1.1], [1, 1.1], [1, 1], [2, 1], [2, 2], [0, 2]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [2, 0]]
[[side]]
name = "rest"
kind = "free"
along = [[2, 0], [2, 2], [0, 2], [0, 0]]
)" + more;
  };
  const Model<2> model = model_of(ground(""));
  EXPECT_TRUE(model.particles.body.empty());
  ASSERT_EQ(model.thin_layers.size(), 2U);
  for (const ThinLayer<2>& thin : model.thin_layers) EXPECT_EQ(thin.layer, 1);
  try {
    static_cast<void>(
        model_of(ground("[[interface]]\nbetween = [\"block\", \"other\"]\nkind = \"contact\"\n")));
    ADD_FAILURE() << "it is not refused";
  } catch (const InterfaceRefused& refusal) {
    EXPECT_THAT(refusal.found, AllOf(HasSubstr("are of one body with a layer less than three"),
                                     HasSubstr("\"block\""), HasSubstr("\"other\"")));
  }
}

TEST(ThinLayers, OfABoxAndOfPrismsAreSaidAsWell) {
  const std::string box = "[geometry]\nmin = [0.0, 0.0]\nmax = [1.0, 1.0]\nspacing = 0.1\n" +
                          two_materials + "region_min = [0.0, 0.0]\nregion_max = [1.0, 0.1]\n" +
                          "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", "
                          "\"y\"]\n";
  EXPECT_EQ(model_of(box).thin_layers.size(), 1U);
  std::string prism = on_a_seam(1);
  prism.replace(prism.find("spacing = 0.1"), 13,
                "dimension = 3\ndepth = [0.0, 0.5]\nspacing = 0.1");
  const Model<3> model = model_of<3>(prism);
  ASSERT_EQ(model.thin_layers.size(), 1U);
  EXPECT_EQ(model.thin_layers[0].layer, 1);
}

}  // namespace
}  // namespace model
