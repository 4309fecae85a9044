#include "model/measures.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "model/build.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using ::testing::DoubleEq;
using ::testing::DoubleNear;
using ::testing::ElementsAre;

// A box 2 m wide and 1 m high whose tractions grow.
const std::string supported_right = R"(
[[support]]
name = "springs"
side = "right"
directions = ["x"]
method = "penalty"
)";
const std::string mirrored_right = R"(
[[symmetry]]
axis = "x"
position = 2.0
)";
const std::string box = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [2.0, 1.0]
spacing = 0.25
[[material]]
name = "soil"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 1e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
method = "direct"
[[support]]
name = "a wall, left"
side = "left"
directions = ["x"]
method = "direct"
[[traction]]
name = "load"
side = "top"
range_min = [0.5]
range_max = [1.5]
value = [10.0, -1000.0]
[[traction]]
name = "suction"
side = "top"
value = [0.0, 100.0]
follower = true
[drive]
kind = "load"
scales = ["traction"]
[programme]
steps = 4
)";

/// The box with measures, and its state at rest.
struct Box {
  explicit Box(const std::string& measures, const std::string& right = supported_right)
      : scene(read(box + right + measures)),
        model(build_model<2>(scene)),
        state(initial_state(model)),
        measures(scene, model) {}

  static scene::Scene read(const std::string& text) {
    const auto reading = scene::parse_scene(text, "box");
    if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
    return *reading.scene;
  }

  scene::Scene scene;
  Model<2> model;
  State<2> state;
  Measures<2> measures;
};

TEST(Measures, InterpolateDisplacementsSoThatALinearOneIsExact) {
  Box box("[[measure]]\nname = \"p\"\nkind = \"displacement\"\nat = [1.03, 1.0]\n");
  const auto& x = box.model.particles.position;
  box.state.displacement.col(0) = (0.1 + 0.2 * x.col(0).array() - 0.3 * x.col(1).array()).matrix();
  box.state.displacement.col(1) = (0.4 * x.col(0).array() + 0.5 * x.col(1).array()).matrix();
  EXPECT_THAT(box.measures.columns(), ElementsAre("p_ux_m", "p_uy_m"));
  constexpr double round_off = 1e-13;  // of a sum of a few dozen terms of size 1
  EXPECT_THAT(box.measures.of(box.state), ElementsAre(DoubleNear(0.1 + 0.2 * 1.03 - 0.3, round_off),
                                                      DoubleNear(0.4 * 1.03 + 0.5, round_off)));
}

// Of the particle itself, whose law is integrated: nothing is smoothed.
TEST(Measures, TakeStressAndPlasticStrainOfTheNearestParticle) {
  Box box(
      "[[measure]]\nname = \"s\"\nkind = \"particle_stress\"\nat = [0.6, 0.4]\n"
      "[[measure]]\nname = \"e\"\nkind = \"plastic_strain\"\nat = [0.6, 0.4]\n");
  Eigen::Index nearest = -1;
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    const auto place = box.model.particles.position.row(a);
    if (std::abs(place[0] - 0.625) < 1e-9 && std::abs(place[1] - 0.375) < 1e-9) nearest = a;
  }
  ASSERT_GE(nearest, 0);
  box.state.stress.col(nearest) << -1.0, -2.0, -3.0, 0.5;
  box.state.plastic_strain[nearest] = 0.25;
  EXPECT_THAT(box.measures.columns(),
              ElementsAre("s_sxx_Pa", "s_syy_Pa", "s_szz_Pa", "s_sxy_Pa", "e_plastic_strain"));
  EXPECT_THAT(box.measures.of(box.state), ElementsAre(-1.0, -2.0, -3.0, 0.5, 0.25));
}

// On a face as well, where particles are on one side only.
TEST(Measures, InterpolateStressSoThatALinearOneIsExact) {
  Box box("[[measure]]\nname = \"s\"\nkind = \"stress\"\nat = [1.03, 1.0]\n");
  const auto& x = box.model.particles.position;
  for (int k = 0; k < 4; ++k) {
    box.state.stress.row(k) =
        ((k + 1.0) + 0.2 * x.col(0).array() - k * x.col(1).array()).matrix().transpose();
  }
  constexpr double round_off = 1e-12;  // of a sum of a few dozen terms of size 10
  const auto exact = [&](int k) { return DoubleNear((k + 1.0) + 0.2 * 1.03 - k, round_off); };
  EXPECT_THAT(box.measures.of(box.state), ElementsAre(exact(0), exact(1), exact(2), exact(3)));
}

// On a mirror there is no shear stress, whatever the particles beside it have; normal stresses even
// out across it.
TEST(Measures, SeeStressInAMirror) {
  Box box("[[measure]]\nname = \"s\"\nkind = \"stress\"\nat = [2.0, 0.5]\n", mirrored_right);
  const auto& x = box.model.particles.position;
  for (const int k : {0, 3})
    box.state.stress.row(k) = (7.0 - x.col(0).array()).matrix().transpose();
  const auto values = box.measures.of(box.state);
  constexpr double round_off = 1e-12;
  EXPECT_NEAR(values[3], 0.0, round_off);
  EXPECT_GT(values[0], 5.0);
  EXPECT_LT(values[0], 5.0 + 2.0 * box.model.spacing);
}

// Of one of two bodies that adjoin there nothing is taken from the other.
TEST(Measures, InterpolateStressWithinABody) {
  Box box(
      "[[material]]\nname = \"rock\"\nmodel = \"elastic\"\nyoungs_modulus = 1e9\n"
      "poissons_ratio = 0.3\nregion_min = [1.0, 0.0]\nregion_max = [2.0, 1.0]\n"
      "[[measure]]\nname = \"s\"\nkind = \"stress\"\nat = [1.01, 0.5]\n");
  const auto& x = box.model.particles.position;
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    box.state.stress.col(a).setConstant(x(a, 0) > 1.0 ? 100.0 : -1.0);
  }
  constexpr double round_off = 1e-10;
  for (const double value : box.measures.of(box.state)) EXPECT_NEAR(value, 100.0, round_off);
}

// A point on the boundary of two materials is of that of the particle named for it, whatever
// round-off says.
TEST(Measures, OnABoundaryOfMaterialsAgreeWithTheParticle) {
  for (const std::string at : {"[1.0, 0.5]", "[1.0000000001, 0.4]", "[0.9999999999, 0.6]"}) {
    Box box(
        "[[material]]\nname = \"rock\"\nmodel = \"elastic\"\nyoungs_modulus = 1e9\n"
        "poissons_ratio = 0.3\nregion_min = [1.0, 0.0]\nregion_max = [2.0, 1.0]\n"
        "[[measure]]\nname = \"s\"\nkind = \"stress\"\nat = " +
        at + "\n[[measure]]\nname = \"p\"\nkind = \"particle_stress\"\nat = " + at + "\n");
    const auto& x = box.model.particles.position;
    for (Eigen::Index a = 0; a < box.model.size(); ++a) {
      box.state.stress.col(a).setConstant(x(a, 0) > 1.0 ? 100.0 : -1.0);
    }
    const auto values = box.measures.of(box.state);
    EXPECT_NEAR(values[0], values[4], 1e-10) << at;
  }
}

// A seam of one row has no gradient across it.
TEST(Measures, TakeStressOfTheNearestParticleWhereABodyIsTooThin) {
  Box box(
      "[[material]]\nname = \"seam\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
      "poissons_ratio = 0.3\nregion_min = [1.0, 0.0]\nregion_max = [1.25, 1.0]\n"
      "[[measure]]\nname = \"s\"\nkind = \"stress\"\nat = [1.1, 0.6]\n");
  const auto& x = box.model.particles.position;
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    box.state.stress.col(a).setConstant(std::abs(x(a, 0) - 1.125) < 0.1 ? x(a, 1) : -1.0);
  }
  for (const double value : box.measures.of(box.state)) EXPECT_EQ(value, 0.625);
}

TEST(Measures, HalfwayBetweenParticlesAreOfTheFirst) {
  Box box("[[measure]]\nname = \"e\"\nkind = \"plastic_strain\"\nat = [0.75, 0.5]\n");
  const auto place = [&](Eigen::Index a) { return box.model.particles.position.row(a); };
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    if (place(a)[0] < 0.75 && place(a)[1] < 0.5) box.state.plastic_strain[a] = place(a)[0];
  }
  EXPECT_THAT(box.measures.of(box.state), ElementsAre(0.625));
}

// Eight particles of a force of 1 each along x and 10 along y; the one in the corner is held along
// x by the wall, too, which lies across: it is the wall's.
TEST(Measures, SumTheReactionsOfASupportInItsDirectionsOnly) {
  Box box(
      "[[measure]]\nname = \"b\"\nkind = \"reaction\"\nsupport = \"base\"\n"
      "[[measure]]\nname = \"w\"\nkind = \"reaction\"\nsupport = \"a wall, left\"\n");
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    if (box.model.particles.position(a, 1) > 0.25) continue;
    box.state.reaction.row(a) << 1.0, 10.0;
  }
  EXPECT_THAT(box.measures.columns(),
              ElementsAre("b_Rx_N_per_m", "b_Ry_N_per_m", "w_Rx_N_per_m", "w_Ry_N_per_m"));
  EXPECT_THAT(box.measures.of(box.state), ElementsAre(7.0, 80.0, 1.0, 0.0));
}

// Springs of stiffness 100 E / spacing over a side of 1 m that is moved by 1 mm along x.
TEST(Measures, KnowTheReactionOfAPenalty) {
  Box box("[[measure]]\nname = \"s\"\nkind = \"reaction\"\nsupport = \"springs\"\n");
  box.state.displacement.col(0).setConstant(1e-3);
  box.state.displacement.col(1).setConstant(1e-3);
  const double stiffness = 100.0 * 1e6 / 0.25;  // [Pa/m]
  const auto values = box.measures.of(box.state);
  EXPECT_NEAR(std::abs(values[0]), stiffness * 1e-3, 1e-9 * stiffness);
  EXPECT_EQ(values[1], 0.0);
}

// The dead load of 1 m and the suction of 2 m, half grown, and a support's reaction.
TEST(Measures, AddReactionsAndTractionsUpToTheResultantOnASide) {
  Box box(
      "[[measure]]\nname = \"top\"\nkind = \"resultant\"\nside = \"top\"\n"
      "[[measure]]\nname = \"bottom\"\nkind = \"resultant\"\nside = \"bottom\"\n");
  box.state.programme.load = 0.5;
  for (Eigen::Index a = 0; a < box.model.size(); ++a) {
    if (box.model.particles.position(a, 1) < 0.25) box.state.reaction(a, 1) = 50.0;
  }
  constexpr double round_off = 1e-9;  // of 1000 N/m
  EXPECT_THAT(box.measures.of(box.state),
              ElementsAre(DoubleNear(5.0, round_off), DoubleNear(-500.0 + 100.0, round_off),
                          DoubleEq(0.0), DoubleEq(400.0)));
}

TEST(Measures, OfADriveThatIsNoDisplacementAreReactionsAndTheLargestDisplacementByDefault) {
  Box box("");
  box.state.displacement.row(3) << 3.0, -4.0;
  EXPECT_THAT(box.measures.columns(),
              ElementsAre("body_max_displacement_m", "base_Rx_N_per_m", "base_Ry_N_per_m",
                          "a_wall__left_Rx_N_per_m", "a_wall__left_Ry_N_per_m",
                          "springs_Rx_N_per_m", "springs_Ry_N_per_m"));
  EXPECT_EQ(box.measures.of(box.state)[0], 5.0);
}

}  // namespace
}  // namespace model
