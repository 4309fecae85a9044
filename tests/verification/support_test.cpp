// Whom supports and materials hold, and how stiffly.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "model/build.hpp"
#include "test_scene.hpp"

namespace verification {
namespace {

std::string body(const std::string& more) {
  return "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [1.0, 2.0]\nspacing = 0.1\n"
         "[[material]]\nname = \"soft\"\nmodel = \"elastic\"\nyoungs_modulus = 1e4\n"
         "poissons_ratio = 0.3\n" +
         more;
}

std::string layer(int number, double youngs_modulus) {
  return fmt::format(
      "[[material]]\nname = \"m{}\"\nmodel = \"elastic\"\nyoungs_modulus = {:.1f}\n"
      "poissons_ratio = 0.3\nregion_min = [0.0, 0.0]\nregion_max = [1.0, 1.0]\n",
      number, youngs_modulus);
}

TEST(PenaltySupport, HoldsWhomItsRegionChooses) {
  const auto model = model::build_model<2>(
      scene_of(body("[[support]]\nname = \"base\"\nregion_min = [0.0, 0.0]\nregion_max = [1.0, "
                    "0.05]\ndirections = [\"x\", \"y\"]\nmethod = \"penalty\"\n")));
  ASSERT_EQ(model.penalty_supports.size(), 1U);
  const auto& points = model.penalty_supports[0].points;
  ASSERT_EQ(points.size(), 10);
  EXPECT_LE(points.position.col(1).maxCoeff(), 0.05 + 1e-9);
  EXPECT_NEAR(points.weight.sum(), 1.0, 1e-12);  // a spacing each: the width
}

TEST(PenaltySupport, IsAsStiffAsTheMaterialThatItHolds) {
  // The bottom is of the stiff layer, which is not the first material.
  const std::string support =
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\nmethod = "
      "\"penalty\"\npenalty_factor = 100.0\n";
  const auto model = model::build_model<2>(scene_of(body(layer(1, 1e10) + support)));
  ASSERT_EQ(model.penalty_supports.size(), 1U);
  const auto& held = model.penalty_supports[0];
  EXPECT_NEAR(held.options.penalty * held.points.weight.sum() / (100.0 * 1e10 / 0.1), 1.0, 1e-9);
}

TEST(Materials, AreToldApartBeyondEightBits) {
  std::string layers;
  constexpr int last = 256;
  for (int number = 1; number <= last; ++number) layers += layer(number, 1e6);
  const auto model = model::build_model<2>(
      scene_of(body(layers + "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = "
                             "[\"x\", \"y\"]\n")));
  EXPECT_EQ(model.material[0], last);
}

}  // namespace
}  // namespace verification
