// Level ground written as regions, at rest under its geostatic stress, and what is done with it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "measure.hpp"
#include "model/build.hpp"
#include "model/initial_equilibrium.hpp"
#include "model/refusal.hpp"
#include "staged_run.hpp"
#include "stepping/settle.hpp"
#include "support/box_mesh.hpp"

namespace verification {
namespace {

using ::testing::HasSubstr;

std::string material(const std::string& name, double modulus, double ratio, double dry,
                     double saturated) {
  return fmt::format(
      "[[material]]\nname = \"{}\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = {}\n"
      "poissons_ratio = {}\ncohesion = 5e3\nfriction_angle = 25\ndilation_angle = 0\n"
      "unit_weight = {}\nsaturated_unit_weight = {}\n",
      name, modulus, ratio, dry, saturated);
}

// 0.8 m of clay on 1.2 m of sand, as wide as the sides at the bottom and the top say.
struct Layers {
  double joint_left = -0.8, joint_right = -0.8;
  double right_below = 3.0;  // of the right side, at the bottom
  std::string walls = "roller";
  std::string top = "kind = \"free\"\n";
  double spacing = 0.1;
  std::string more{};
  std::string sand = material("sand", 3e7, 0.25, 19e3, 21e3);
};

std::string text_of(const Layers& layers) {
  const double share = -layers.joint_right / 2.0;
  const double at_joint = 3.0 + share * (layers.right_below - 3.0);
  return fmt::format(
             "[geometry]\nspacing = {0}\n[approximation]\nkinematics = \"small_strain\"\n"
             "[[region]]\nname = \"upper\"\nmaterial = \"clay\"\n"
             "outline = [[0, {1}], [{2}, {3}], [3, 0], [0, 0]]\n"
             "[[region]]\nname = \"lower\"\nmaterial = \"sand\"\n"
             "outline = [[0, -2], [{4}, -2], [{2}, {3}], [0, {1}]]\n"
             "[[side]]\nname = \"base\"\nkind = \"fixed\"\nalong = [[0, -2], [{4}, -2]]\n"
             "[[side]]\nname = \"far side\"\nkind = \"{5}\"\n"
             "along = [[{4}, -2], [{2}, {3}], [3, 0]]\n"
             "[[side]]\nname = \"axis\"\nkind = \"symmetry\"\nalong = [[0, 0], [0, -2]]\n"
             "[[side]]\nname = \"top\"\n{6}along = [[3, 0], [0, 0]]\n"
             "[solver]\ntolerance = 1e-9\n",
             layers.spacing, layers.joint_left, at_joint, layers.joint_right, layers.right_below,
             layers.walls, layers.top) +
         material("clay", 1e7, 0.3, 17e3, 19e3) + layers.sand +
         (layers.more.find("[initial_stress]") == std::string::npos
              ? "[initial_stress]\nkind = \"geostatic\"\n"
              : "") +
         layers.more;
}

const std::string water_within = "[water]\nunit_weight = 10e3\ntable = [[0, -0.53], [3, -0.53]]\n";

template <int Dim>
model::Model<Dim> at_rest(const scene::Scene& scene) {
  return stepping::model_at_rest<Dim>(scene);
}

// Nothing is loaded but what is at rest; the settlement of its weight would be
// gamma H^2 / (2 E), some 4 mm. The base bears all, where no other side is rough.
template <int Dim>
void expect_rest(const std::string& text, double surcharge = 0.0, bool on_base_alone = true) {
  const TestScene scene = scene_of(text);
  const auto model = at_rest<Dim>(scene);
  auto state = model::initial_state(model);
  stepping::LoadStepper<Dim> stepper(scene, model, state);
  ASSERT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged);
  constexpr double settlement = 18e3 * 4.0 / (2.0 * 1e7);
  EXPECT_LT(state.displacement.cwiseAbs().maxCoeff(), 1e-9 * settlement);
  EXPECT_EQ(state.plastic_strain.maxCoeff(), 0.0);
  if (!on_base_alone) return;
  const Eigen::Index n = model.size();
  const double lifted = model.water_load.size() > 0 ? model.water_load.segment(n, n).sum() : 0.0;
  const double weight = 9.81 * model.mass.sum() + surcharge - lifted;
  EXPECT_NEAR(state.reaction.col(1).sum() / weight, 1.0, 1e-9);
}

const std::string loaded = "kind = \"loaded\"\npressure = 5e3\n";
const std::string surcharged = "[initial_stress]\nkind = \"geostatic\"\nsurcharge = 5e3\n";

TEST(LayeredGround, IsAtRest) {
  expect_rest<2>(text_of({}));
  expect_rest<2>(text_of({.more = water_within}));
  expect_rest<2>(text_of({.top = loaded, .more = surcharged}), 3.0 * 5e3);
  // Of layers through cells, and of particles that are not equally fine.
  const Layers between{.joint_left = -0.83, .joint_right = -0.83, .more = water_within};
  expect_rest<2>(text_of(between));
  Layers graded = between;
  graded.more += "[grading]\nenabled = true\n[[refine]]\nat = [0, 0]\nspacing = 0.05\n";
  graded.spacing = 0.05;
  expect_rest<2>(text_of(graded));
  // What presses on sides aslant they bear, shear and all.
  expect_rest<2>(text_of({.right_below = 3.7, .walls = "fixed"}), 0.0, false);
}

// Regions of one weight and one K0 may meet as they like.
TEST(LayeredGround, MayBeOfOneWeightOnBothSidesOfAJointAslant) {
  expect_rest<2>(text_of({.joint_left = -0.4,
                          .joint_right = -1.1,
                          .more = "[initial_stress]\nkind = \"geostatic\"\nK0 = 0.6\n",
                          .sand = material("sand", 3e7, 0.25, 17e3, 19e3)}));
}

// Vertical: 17 kN/m3 down to the water at 0.53 m, 19 - 10 down to the joint, 21 - 10 below.
TEST(LayeredGround, BearsTheWeightAboveToTheLastDigit) {
  const TestScene scene =
      scene_of(text_of({.joint_left = -0.83, .joint_right = -0.83, .more = water_within}));
  const auto model = at_rest<2>(scene);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double depth = -model.particles.position(a, 1);
    const double vertical = 17e3 * std::min(depth, 0.53) +
                            9e3 * std::clamp(depth - 0.53, 0.0, 0.30) +
                            11e3 * std::max(0.0, depth - 0.83);
    const double ratio = depth < 0.83 ? 0.3 / 0.7 : 0.25 / 0.75;
    EXPECT_NEAR(model.initial_stress(1, a), -vertical, 1e-12 * 20e3);
    EXPECT_NEAR(model.initial_stress(0, a), -ratio * vertical, 1e-12 * 20e3);
    EXPECT_NEAR(model.initial_stress(2, a), -ratio * vertical, 1e-12 * 20e3);
  }
}

const std::string strip =
    "[drive]\nkind = \"displacement\"\nside = \"top\"\nrange_min = 0.0\nrange_max = 0.5\n"
    "direction = [0.0, -1.0]\ntarget = 0.01\nwidth = 0.5\n[programme]\nsteps = 5\n";

// The same ground as a box: the same particles under the same stress, and so the same pressures, to
// what the tolerance leaves of them.
TEST(LayeredGround, BearsAFootingAsTheBoxOfTheSameGround) {
  const auto pressures = [](const std::string& text) {
    const TestScene scene = scene_of(text, {"solver.tolerance=1e-6"});
    const auto model = at_rest<2>(scene);
    auto state = model::initial_state(model);
    stepping::LoadStepper<2> stepper(scene, model, state);
    std::vector<double> found;
    while (!stepper.finished()) {
      const auto result = stepper.advance();
      EXPECT_EQ(result.outcome, stepping::StepOutcome::converged) << result.reason;
      if (result.outcome != stepping::StepOutcome::converged) break;
      found.push_back(result.record.mean_pressure);
    }
    return found;
  };
  const std::string box =
      "[geometry]\nspacing = 0.1\nmin = [0, -2]\nmax = [3, 0]\n"
      "[approximation]\nkinematics = \"small_strain\"\n[[symmetry]]\naxis = \"x\"\n"
      "position = 0\n[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
      "[[support]]\nname = \"far side\"\nside = \"right\"\ndirections = [\"x\"]\n" +
      material("clay", 1e7, 0.3, 17e3, 19e3) + material("sand", 3e7, 0.25, 19e3, 21e3) +
      "region_min = [0, -2]\nregion_max = [3, -0.8]\n"
      "[initial_stress]\nkind = \"geostatic\"\n[solver]\ntolerance = 1e-6\n" +
      water_within;
  const auto of_box = pressures(box + strip);
  const auto of_regions = pressures(text_of({.more = water_within + strip}));
  ASSERT_EQ(of_regions.size(), 5);
  ASSERT_EQ(of_box.size(), 5);
  constexpr double tolerance = 1e-4;  // 1e-6 of forces, a hundred times as much of a path
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(of_regions[k] / of_box[k], 1.0, tolerance) << k;
  }
}

struct Errors {
  double heave = 0.0, stress = 0.0;  // over the largest heave, and over the stress taken off
};

// The clay taken off all of the sand, which the rollers keep from widening: it heaves by
// gamma h (y - y_base) / E_oed, and what it bore across goes with nu / (1 - nu).
Errors errors_of_unloading(double spacing) {
  StagedRun run(
      scene_of(text_of({.spacing = spacing,
                        .more = "[[stage]]\nname = \"dig\"\nremove = [\"upper\"]\nsteps = 1\n"}),
               {"side.0.kind=roller", "material.0.model=elastic", "material.1.model=elastic",
                "solver.tolerance=1e-8"}));
  run.complete();
  constexpr double taken = 17e3 * 0.8, ratio = 1.0 / 3.0, gamma = 19e3;
  constexpr double oedometric = 3e7 * 0.75 / (1.25 * 0.5), largest = taken * 1.2 / oedometric;
  Errors errors;
  const auto& model = run.stages.model();
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double y = model.particles.position(a, 1);
    EXPECT_LT(y, -0.8);
    const double heave = run.state.displacement(a, 1) - taken * (y + 2.0) / oedometric;
    const double vertical = run.state.stress(1, a) + gamma * (-0.8 - y);
    const double across = run.state.stress(0, a) + ratio * gamma * (-0.8 - y);
    errors.heave = std::max(errors.heave, std::abs(heave) / largest);
    errors.stress = std::max({errors.stress, std::abs(vertical) / taken, std::abs(across) / taken});
  }
  return errors;
}

TEST(LayeredGround, HeavesWhereALayerIsTakenOff) {
  const Errors coarse = errors_of_unloading(0.1), fine = errors_of_unloading(0.05);
  report("heave_error", fine.heave);
  report("stress_error", fine.stress);
  // Measured 1.23e-3 and 3.0e-4, and 3.6e-3 and 1.8e-3 beside the new surface.
  EXPECT_LT(coarse.heave, 2e-3);
  EXPECT_LT(coarse.stress, 5e-3);
  constexpr double of_order = 0.2;
  EXPECT_NEAR(std::log2(coarse.heave / fine.heave), 2.0, of_order);
  EXPECT_NEAR(std::log2(coarse.stress / fine.stress), 1.0, of_order);
}

// Prisms, and elements of a solid.
TEST(LayeredGround, IsAtRestInSpace) {
  const std::string ends =
      "[[support]]\nname = \"front\"\nside = \"front\"\ndirections = [\"z\"]\n"
      "[[support]]\nname = \"back\"\nside = \"back\"\ndirections = [\"z\"]\n";
  const auto in_space = [](std::string text) {
    return text.insert(text.find("spacing"), "dimension = 3\ndepth = [0, 1]\n");
  };
  expect_rest<3>(in_space(text_of({.spacing = 0.25, .more = ends})));
  // Through cells of several widths, and with water.
  expect_rest<3>(in_space(text_of({.joint_left = -0.83,
                                   .joint_right = -0.83,
                                   .spacing = 0.125,
                                   .more = ends + water_within +
                                           "[grading]\nenabled = true\ncoarsest = 0.25\n"
                                           "growth = 0.5\n[[refine]]\nat = [1, 0, 0.5]\n"})));
}

// Elements of a mesh, in the plane and in space, whose joint is a level of nodes.
TEST(LayeredGround, IsAtRestAsElementsOfAMesh) {
  using Kind = support::BoxMesh::Kind;
  for (const Kind kind : {Kind::triangles, Kind::tetrahedra}) {
    const support::BoxMesh mesh{.kind = kind, .cells = {4, 4, 3}, .size = {2.0, 2.0, 1.5}};
    const bool plane = mesh.is_plane();
    std::string text = fmt::format(
        "[geometry]\ndimension = {}\n[mesh]\nparticles = \"elements\"\ntext = '''\n{}'''\n",
        plane ? 2 : 3, text_of(mesh));
    text += material("clay", 1e7, 0.3, 17e3, 19e3) + material("sand", 3e7, 0.25, 19e3, 21e3) +
            "[[region]]\nmaterial = \"sand\"\ngroup = \"low\"\n"
            "[[region]]\nmaterial = \"clay\"\ngroup = \"high\"\n"
            "[approximation]\nkinematics = \"small_strain\"\n[solver]\ntolerance = 1e-9\n"
            "[initial_stress]\nkind = \"geostatic\"\n";
    for (const char* name : {"x0", "x1", "y0", "y1", "z0", "z1"}) {
      if (plane && *name == 'z') continue;
      const char* held = std::string(name) == "y1" ? "free" : "roller";
      text +=
          fmt::format("[[side]]\nname = \"{0}\"\ngroup = \"{0}\"\nkind = \"{1}\"\n", name, held);
    }
    plane ? expect_rest<2>(text) : expect_rest<3>(text);
  }
}

std::string refusal(const Layers& layers) {
  try {
    (void)at_rest<2>(scene_of(text_of(layers)));
  } catch (const model::Refusal& refused) {
    return refused.what();
  }
  return "";
}

TEST(LayeredGround, IsRefusedWhereNothingBearsIt) {
  EXPECT_THAT(refusal({.walls = "free"}), HasSubstr("nothing bears a pressure of "));
  EXPECT_THAT(refusal({.walls = "free"}), HasSubstr("on the side \"far side\", at (3, -1.9"));
  EXPECT_THAT(refusal({.walls = "free"}), HasSubstr("settle it by kind = \"gravity\""));
  // A roller bears no shear.
  EXPECT_THAT(refusal({.right_below = 3.7, .walls = "roller"}), HasSubstr("nothing bears a shear"));
  EXPECT_THAT(refusal({.more = surcharged}),
              HasSubstr("nothing bears a pressure of 5000 Pa on the side \"top\""));
  // What presses more than the ground at rest bears settles it.
  EXPECT_EQ(refusal({.top = loaded}), "");
}

}  // namespace
}  // namespace verification
