// Materials whose values change from place to place, as a model's laws.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <variant>

#include "model/build.hpp"
#include "model/particle_fields.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Two clays, 2 m by 0.5 m each.
const std::string two_clays = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [2.0, 1.0]
spacing = 0.1
[approximation]
kinematics = "small_strain"
[[material]]
name = "lower"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 1e3
[[material]]
name = "upper"
model = "von_mises"
youngs_modulus = 2e6
poissons_ratio = 0.3
cohesion = 2e3
region_min = [0.0, 0.5]
region_max = [2.0, 1.0]
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
)";

Model<2> model_of(const std::vector<std::string>& settings) {
  const auto reading = scene::parse_scene(two_clays, "two clays", settings);
  if (!reading.scene) throw std::invalid_argument(reading.errors.front().text());
  return build_model<2>(*reading.scene);
}

double strength_of(const Model<2>& model, Eigen::Index a) {
  return std::get<constitutive::VonMises>(model.laws[model.law[static_cast<std::size_t>(a)]])
      .strength;
}

TEST(Laws, AreThoseOfTheMaterialsWhereNothingVaries) {
  const Model<2> model = model_of({});
  ASSERT_EQ(model.laws.size(), 2U);
  for (std::size_t a = 0; a < model.law.size(); ++a) EXPECT_EQ(model.law[a], model.material[a]);
}

// Along a row of the lattice nothing changes, so that it goes on as one.
TEST(Laws, AreOneOfEachRowWhereValuesChangeWithDepth) {
  const Model<2> model =
      model_of({"material.0.cohesion={ at = [3, 0.5], value = 1e3, gradient = [0, -500] }",
                "material.0.youngs_modulus={ at = [0, 0.5], value = 1e6, gradient = [0, -2e6] }"});
  EXPECT_EQ(model.laws.size(), 1U + 5U);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double y = model.particles.position(a, 1);
    const bool lower = model.material[static_cast<std::size_t>(a)] == 0;
    EXPECT_NEAR(strength_of(model, a), lower ? 1e3 + 500 * (0.5 - y) : 2e3, 1e-9);
    EXPECT_NEAR(model.youngs_modulus_of(a), lower ? 1e6 + 2e6 * (0.5 - y) : 2e6, 1e-6);
  }
}

// Where two clays are tied the weaker's cohesion at the place is what their face bears.
TEST(Laws, OfFacesChangeFromPlaceToPlaceAsWell) {
  const Model<2> uniform = model_of({});
  ASSERT_EQ(uniform.interfaces.size(), 1U);
  EXPECT_EQ(uniform.interfaces[0].law.adhesion, 1e3);
  const Model<2> model =
      model_of({"material.0.cohesion={ at = [0, 0.5], value = 1e3, gradient = [1e3, 0] }"});
  Eigen::Index points = 0;
  for (const Interface<2>& interface : model.interfaces) {
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c, ++points) {
      const double x = interface.faces.points.position(c, 0);
      EXPECT_NEAR(interface.law.adhesion, std::min(1e3 + 1e3 * x, 2e3), 1e-9);
    }
  }
  EXPECT_EQ(points, uniform.interface_points());
}

// A face cannot harden: ground whose strength changes is not held to what it bears at first.
TEST(Laws, OfFacesDoNotSlideAtAStrengthThatChanges) {
  const std::vector<std::string> one{"material.0.residual_strain=0.1",
                                     "material.0.residual_cohesion=3e3"};
  EXPECT_EQ(model_of(one).interfaces[0].law.adhesion, 2e3) << "that of the other";
  std::vector<std::string> both = one;
  both.insert(both.end(), {"material.1.residual_strain=0.1", "material.1.residual_cohesion=3e3"});
  EXPECT_TRUE(model_of(both).interfaces[0].law.tied);
}

// Pure shear of 400 Pa, as a share of what each place bears.
TEST(Laws, SayHowMuchOfTheirStrengthIsUsed) {
  const Model<2> model =
      model_of({"material.0.cohesion={ at = [0, 0.5], value = 1e3, gradient = [0, -500] }"});
  State<2> state = initial_state(model);
  state.stress.row(3).setConstant(400.0);
  const std::vector<std::string> wanted{"utilisation"};
  const auto fields = particle_fields<2>(model, state, wanted);
  ASSERT_EQ(fields.size(), 1U);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    EXPECT_NEAR(fields[0].values[static_cast<std::size_t>(a)], 400.0 / strength_of(model, a),
                1e-12);
  }
}

}  // namespace
}  // namespace model
