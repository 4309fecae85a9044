// Ground without weight that is under one stress everywhere, and what is dug in it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "measure.hpp"
#include "model/build.hpp"
#include "model/initial_equilibrium.hpp"
#include "model/measures.hpp"
#include "model/refusal.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

using ::testing::HasSubstr;

// The whole of a bore and its far sides, which are held: radius 1 m, 24 m by 24 m.
const std::string bore = R"(
[geometry]
spacing = 0.1
[grading]
enabled = true
[[refine]]
region_min = [-2, -2]
region_max = [2, 2]
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 7e9
poissons_ratio = 0.3
[[region]]
name = "core"
material = "rock"
outline = [[-1, 0], { centre = [0, 0], radius = 1, from = 180, to = 360 },
           { centre = [0, 0], radius = 1, from = 0, to = 180 }]
[[region]]
name = "around"
material = "rock"
outline = [[-12, -12], [12, -12], [12, 12], [-12, 12]]
holes = [[[-1, 0], { centre = [0, 0], radius = 1, from = 180, to = 360 },
          { centre = [0, 0], radius = 1, from = 0, to = 180 }]]
[[side]]
name = "far"
kind = "fixed"
along = [[-12, -12], [12, -12], [12, 12], [-12, 12], [-12, -12]]
[initial_stress]
kind = "uniform"
sigma_x = -10e6
sigma_y = -20e6
[[stage]]
name = "dig"
remove = ["core"]
steps = 1
[solver]
tolerance = 1e-5
[[measure]]
name = "rock"
kind = "stress"
at = [1.5, 0]
)";

std::string displacement_at(const std::string& name, double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return fmt::format("[[measure]]\nname = \"{}\"\nkind = \"displacement\"\nat = [{:.9f}, {:.9f}]\n",
                     name, std::cos(angle), std::sin(angle));
}

double measured(const StagedRun& run, const std::string& column) {
  const model::Measures<2> measures(run.stages.scene(), run.stages.model());
  const auto& names = measures.columns();
  return measures.of(run.state).at(
      static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin()));
}

// Principal stresses of -10 and -20 MPa, the former `turned` [deg] from the x axis.
Settings turned_stress(double turned) {
  const double twice = 2.0 * turned * std::numbers::pi / 180.0;
  return {fmt::format("initial_stress.sigma_x={:.10g}", 1e6 * (-15.0 + 5.0 * std::cos(twice))),
          fmt::format("initial_stress.sigma_y={:.10g}", 1e6 * (-15.0 - 5.0 * std::cos(twice))),
          fmt::format("initial_stress.sigma_xy={:.10g}", 1e6 * 5.0 * std::sin(twice))};
}

struct Closure {
  double worst = 0.0;  // over the exact one, less 1, of what faces come in by
  double shear = 0.0;  // [MPa] at 1.5 radii
};

// Half of what opposite faces, which a shift of all does not matter to, come nearer by, in four
// directions; Kirsch (1898), in plane strain.
Closure closure(double turned, double spacing) {
  std::string text = bore;
  for (int k = 0; k < 8; ++k) text += displacement_at(fmt::format("at{}", k), 45.0 * k);
  Settings settings = turned_stress(turned);
  settings.push_back(fmt::format("geometry.spacing={}", spacing));
  StagedRun run(scene_of(text, settings));
  run.complete();
  constexpr double modulus = 7e9, ratio = 0.3;
  Closure found;
  for (int k = 0; k < 4; ++k) {
    const double angle = 0.25 * std::numbers::pi * k;
    const auto inwards = [&](int at) {
      const double sign = at == k ? -1.0 : 1.0;
      return sign * (measured(run, fmt::format("at{}_ux_m", at)) * std::cos(angle) +
                     measured(run, fmt::format("at{}_uy_m", at)) * std::sin(angle));
    };
    const double from_principal = angle - turned * std::numbers::pi / 180.0;
    const double exact = (1.0 + ratio) / modulus * 1e6 *
                         (15.0 - 5.0 * (3.0 - 4.0 * ratio) * std::cos(2.0 * from_principal));
    const double error = 0.5 * (inwards(k) + inwards(k + 4)) / exact - 1.0;
    if (std::abs(error) > std::abs(found.worst)) found.worst = error;
  }
  found.shear = measured(run, "rock_sxy_Pa") / 1e6;
  return found;
}

// Along the principal axes and aslant to the cells. Measured at 5, 10 and 20 particles to the
// radius the worst of four directions: 6.2, -1.7, -2.3 % and 5.1, -0.8, -2.9 %. What is left at
// last is of far sides that are held at 12 radii, which takes 1 to 3 % away.
TEST(InSituStress, ClosesABoreAsKirschSaysWhicheverWayItIsTurned) {
  constexpr double tolerance = 0.04;
  const double coarse = closure(30.0, 0.2).worst;
  for (const double turned : {0.0, 30.0}) {
    const Closure fine = closure(turned, 0.1);
    report(fmt::format("closure_error_turned_{}", turned), fine.worst);
    EXPECT_NEAR(fine.worst, 0.0, tolerance) << turned;
    EXPECT_LT(std::abs(fine.worst), std::abs(coarse)) << turned;
    // On the x axis the shear is sigma_xy (1 + 2 / r^2 - 3 / r^4): 5.61 MPa; 5.26, 5.45 and 5.50
    // measured at 5, 10 and 20 particles to the radius, 5.32, 5.51 and 5.58 with far sides at 24.
    const double sigma_xy = 5.0 * std::sin(2.0 * turned * std::numbers::pi / 180.0);
    const double r2 = 1.5 * 1.5;
    EXPECT_NEAR(fine.shear, sigma_xy * (1.0 + 2.0 / r2 - 3.0 / (r2 * r2)), 0.04 * 5.0) << turned;
  }
}

// Rock that yields around the bore; at 20 particles to the radius it closes turned by 45 degrees by
// what it does along the axes, 0.07 % apart at most.
TEST(InSituStress, ClosesABoreThatYieldsWhicheverWayItIsTurned) {
  const Settings yields{"material.0.model=mohr_coulomb",
                        "material.0.cohesion=3.45e6",
                        "material.0.friction_angle=30",
                        "material.0.dilation_angle=0",
                        "initial_stress.sigma_z=-15e6",
                        "geometry.spacing=0.05",
                        "stage.0.steps=10",
                        "hourglass.stiffness_ratio=0.1",
                        "solver.tolerance=1e-3"};
  const auto closures = [&](double turned) {
    std::string text = bore;
    for (int k = 0; k < 8; ++k) text += displacement_at(fmt::format("at{}", k), 45.0 * k);
    Settings settings = turned_stress(turned);
    settings.insert(settings.end(), yields.begin(), yields.end());
    StagedRun run(scene_of(text, settings));
    run.complete();
    std::array<double, 4> found{};
    for (std::size_t k = 0; k < 4; ++k) {
      const double angle = 0.25 * std::numbers::pi * static_cast<double>(k);
      const auto outwards = [&](std::size_t at) {
        return measured(run, fmt::format("at{}_ux_m", at)) * std::cos(angle) +
               measured(run, fmt::format("at{}_uy_m", at)) * std::sin(angle);
      };
      found[k] = 0.5 * (outwards(k + 4) - outwards(k));
    }
    return found;
  };
  constexpr double tolerance = 0.005;
  const auto along = closures(0.0), aslant = closures(45.0);
  for (std::size_t k = 0; k < 4; ++k) {
    const double apart = aslant[(k + 1) % 4] / along[k] - 1.0;
    report(fmt::format("apart_{}", k), apart);
    EXPECT_NEAR(apart, 0.0, tolerance) << k;
  }
}

// Loaded by name the far side of the shipped bore presses as its pressure does (Salencon 1969);
// what it is off there is -1.4 % at 10 particles to the radius.
TEST(InSituStress, ClosesABoreThatYieldsAsSalenconSays) {
  std::ifstream file(std::string(FPM_SCENES) + "/deep_bore.toml");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto replace = [&](const std::string& what, const std::string& by) {
    text.replace(text.find(what), what.size(), by);
  };
  replace("kind = \"loaded\"\npressure = 30e6", "kind = \"free\"");
  replace("kind = \"gravity\"\nK0 = 1.0",
          "kind = \"uniform\"\nsigma_x = -30e6\nsigma_y = -30e6\nsigma_z = -30e6\n"
          "loaded_sides = [\"far\"]");
  StagedRun run(scene_of(text));
  run.complete();
  constexpr double exact = -0.012201878, tolerance = 0.02;
  report("over_exact", measured(run, "face_ux_m") / exact);
  EXPECT_NEAR(measured(run, "face_ux_m"), exact, tolerance * std::abs(exact));
}

// A body whose sides are aslant, in all of its parts under the same stress.
const std::string aslant = R"(
[geometry]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "mohr_coulomb"
youngs_modulus = 1e9
poissons_ratio = 0.25
cohesion = 5e6
friction_angle = 30
dilation_angle = 0
[[material]]
name = "seam"
model = "elastic"
youngs_modulus = 1e8
poissons_ratio = 0.4
[[region]]
name = "below"
material = "rock"
outline = [[0, 0], [4, -1], [5, 2], [0, 2]]
[[region]]
name = "above"
material = "seam"
outline = [[0, 2], [5, 2], [3, 5], [1, 4]]
[[side]]
name = "right"
kind = "free"
along = [[4, -1], [5, 2]]
[[side]]
name = "others"
kind = "free"
along = [[5, 2], [3, 5], [1, 4], [0, 2], [0, 0], [4, -1]]
[initial_stress]
kind = "uniform"
sigma_x = -8e6
sigma_y = -3e6
sigma_xy = 2e6
loaded_sides = ["right", "others"]
)";

template <int Dim>
double unbalanced(const model::Model<Dim>& model) {
  model::State<Dim> state = model::initial_state(model);
  const equilibrium::Equilibrium<Dim> equilibrium(model, state);
  return equilibrium.balance().load.cwiseAbs().maxCoeff();
}

// The loads of sides are sigma n, so that nothing is left over; a fault of a sign leaves twice the
// stress times a spacing.
TEST(InSituStress, IsBalancedByTheSidesThatItLoads) {
  const TestScene scene = scene_of(aslant);
  const auto model = model::build_model<2>(scene);
  model::check_stress_at_rest<2>(scene, model);
  constexpr double round_off = 1e-9 * 8e6 * 0.25;
  EXPECT_LT(unbalanced(model), round_off);
  // Out of the plane what plane strain makes of it, each material its own.
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double nu = model.material[static_cast<std::size_t>(a)] == 0 ? 0.25 : 0.4;
    EXPECT_NEAR(model.initial_stress(2, a), nu * -11e6, 1.0);
  }
}

// Of n = (3, -1)/sqrt(10): p = -n sigma n and s = t sigma n, with t = (1, 3)/sqrt(10), n turned to
// the left.
TEST(InSituStress, IsBorneByPressureAndShearGivenByHand) {
  const auto given = [](double pressure, double shear) {
    const TestScene scene =
        scene_of(aslant, {"initial_stress.loaded_sides=[\"others\"]", "side.0.kind=loaded",
                          fmt::format("side.0.pressure={}", pressure),
                          fmt::format("side.0.shear={}", shear)});
    const auto model = model::build_model<2>(scene);
    model::check_stress_at_rest<2>(scene, model);
    return unbalanced(model);
  };
  const double pressure = (9.0 * 8e6 + 3e6 + 6.0 * 2e6) / 10.0;
  const double shear = (3.0 * -8e6 + 8.0 * 2e6 + -3.0 * -3e6) / 10.0;
  constexpr double round_off = 1e-6 * 8e6 * 0.25;  // of numbers with seven digits
  EXPECT_LT(given(pressure, shear), round_off);
  EXPECT_THROW((void)given(pressure, -shear), model::Refusal);
}

std::string refusal(const Settings& settings, const std::string& text = aslant) {
  try {
    const TestScene scene = scene_of(text, settings);
    model::check_stress_at_rest<2>(scene, model::build_model<2>(scene));
  } catch (const model::Refusal& refused) {
    return refused.what();
  }
  return "";
}

TEST(InSituStress, IsRefusedWhereNothingBearsIt) {
  EXPECT_THAT(refusal({"initial_stress.loaded_sides=[\"others\"]"}),
              HasSubstr("nothing bears a pressure of 8700000 and a shear of 100000 Pa on the side "
                        "\"right\", at ("));
  // A roller holds across alone.
  EXPECT_THAT(refusal({"initial_stress.loaded_sides=[\"others\"]", "side.0.kind=roller"}),
              HasSubstr("nothing bears a shear of 100000 Pa on the side"));
  EXPECT_EQ(refusal({"initial_stress.loaded_sides=[\"others\"]", "side.0.kind=fixed"}), "");
}

// Mohr-Coulomb: (sigma_1 - sigma_3)/2 = 3.2 MPa; with phi = 0 it needs as much cohesion.
TEST(InSituStress, IsRefusedBeyondTheStrengthOfAMaterial) {
  EXPECT_EQ(refusal({"material.0.friction_angle=0", "material.0.cohesion=3.21e6"}), "");
  EXPECT_THAT(refusal({"material.0.friction_angle=0", "material.0.cohesion=3.19e6"}),
              HasSubstr("the material \"rock\" does not bear this stress at ("));
}

// Ends of prisms are faces of the box, whatever their section.
TEST(InSituStress, LoadsTheEndsOfPrisms) {
  const TestScene scene = scene_of(R"(
[geometry]
dimension = 3
depth = [0, 0.5]
spacing = 0.125
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e9
poissons_ratio = 0.25
[[region]]
material = "rock"
outline = [[0, 0], [1, 0], [0.6, 0.7], [0, 1]]
[[side]]
name = "base"
kind = "fixed"
along = [[0, 0], [1, 0]]
[[side]]
name = "rest"
kind = "free"
along = [[1, 0], [0.6, 0.7], [0, 1], [0, 0]]
[initial_stress]
kind = "uniform"
sigma_x = -8e6
sigma_y = -3e6
sigma_z = -5e6
sigma_yz = -1e6
sigma_zx = 1.5e6
loaded_sides = ["rest", "front", "back"]
[[measure]]
name = "front"
kind = "resultant"
side = "front"
)");
  const auto model = model::build_model<3>(scene);
  model::check_stress_at_rest<3>(scene, model);
  constexpr double round_off = 1e-9 * 8e6 * 0.125 * 0.125;
  EXPECT_LT(unbalanced(model), round_off);
  const model::Measures<3> measures(scene, model);
  ASSERT_EQ(measures.columns().at(2), "front_Fz_N");
  constexpr double area = 0.5 * (0.6 * 1.0 + 1.0 * 0.7);  // of (1, 0), (0.6, 0.7), (0, 1) by 0
  const auto found = measures.of(model::initial_state(model));
  EXPECT_NEAR(found.at(2), 5e6 * area, 1.0);
  EXPECT_NEAR(found.at(0), -1.5e6 * area, 1.0);
}

// All six of a block.
TEST(InSituStress, IsBalancedInSpace) {
  const TestScene scene = scene_of(R"(
[geometry]
dimension = 3
min = [0, 0, 0]
max = [1, 0.75, 0.5]
spacing = 0.125
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e9
poissons_ratio = 0.25
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y", "z"]
[initial_stress]
kind = "uniform"
sigma_x = -8e6
sigma_y = -3e6
sigma_z = -5e6
sigma_xy = 2e6
sigma_yz = -1e6
sigma_zx = 1.5e6
loaded_sides = ["left", "right", "top", "front", "back"]
)");
  const auto model = model::build_model<3>(scene);
  model::check_stress_at_rest<3>(scene, model);
  constexpr double round_off = 1e-9 * 8e6 * 0.125 * 0.125;
  EXPECT_LT(unbalanced(model), round_off);
}

const std::string box = R"(
[geometry]
min = [0, 0]
max = [2, 1]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e9
poissons_ratio = 0.25
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "roof"
side = "top"
directions = ["y"]
[[support]]
name = "wall"
side = "left"
directions = ["x"]
[initial_stress]
kind = "uniform"
sigma_x = -2e6
sigma_y = -3e6
loaded_sides = ["right"]
[[measure]]
name = "base"
kind = "reaction"
support = "base"
[[measure]]
name = "wall"
kind = "reaction"
support = "wall"
)";

// With what to do about it.
TEST(InSituStress, IsRefusedWithWhatWouldBearIt) {
  EXPECT_THAT(refusal({"side.0.kind=loaded", "side.0.pressure=1e6"}),
              HasSubstr("initial_stress.loaded_sides names it"));
  EXPECT_THAT(refusal({"support.1.method=penalty"}, box),
              HasSubstr("a penalty bears nothing at first: use direct, ghosts or contact"));
  EXPECT_THAT(
      refusal({"initial_stress.loaded_sides=[\"left\"]", "drive.kind=displacement",
               "drive.side=right", "drive.direction=[1,0]", "drive.target=0.01", "drive.width=1"},
              box),
      HasSubstr("the plate of a drive bears nothing at first"));
  const std::string foot =
      "[[support]]\nname = \"foot\"\nat = [0, 0]\ndirections = [\"x\", \"y\"]\n";
  EXPECT_THAT(refusal({"initial_stress.loaded_sides=[\"left\"]"}, box + foot),
              HasSubstr("hold it there by a support that names its side"));
}

// Sides that press against each other: each bears what it does, though in sum they bear nothing.
TEST(InSituStress, IsShownByTheSupportsThatBearIt) {
  StagedRun run{scene_of(box)};
  run.complete();
  constexpr double round_off = 1.0;
  EXPECT_NEAR(measured(run, "base_Ry_N_per_m"), 2.0 * 3e6, round_off);
  EXPECT_NEAR(measured(run, "wall_Rx_N_per_m"), 2e6, round_off);
  EXPECT_LT(run.state.displacement.cwiseAbs().maxCoeff(), 1e-9);
}

// What is measured on a side that the stress loads, aslant and of the box, at rest and after a
// step.
TEST(InSituStress, IsMeasuredOnTheSidesThatItLoads) {
  const auto at_wall = [](const char* at) {
    return fmt::format("[[measure]]\nname = \"at\"\nkind = \"stress\"\nat = {}\n", at);
  };
  struct Told {
    double x, y, xy;  // [Pa]
  };
  const auto check = [](const std::string& text, const Settings& settings, const Told& told) {
    StagedRun run{scene_of(text, settings)};
    const double slack = 1e-6 * std::abs(told.x);
    for (const bool stepped : {false, true}) {
      if (stepped) run.complete();
      EXPECT_NEAR(measured(run, "at_sxx_Pa"), told.x, slack) << stepped;
      EXPECT_NEAR(measured(run, "at_syy_Pa"), told.y, slack) << stepped;
      EXPECT_NEAR(measured(run, "at_sxy_Pa"), told.xy, slack) << stepped;
    }
  };
  check(aslant + at_wall("[4.5, 0.5]"), {"geometry.spacing=0.125"}, {-8e6, -3e6, 2e6});
  check(box + at_wall("[2.0, 0.5]"), {"geometry.spacing=0.0625"}, {-2e6, -3e6, 0.0});
}

// What is behind a mirror is sheared the other way; a roller lets it slide.
TEST(InSituStress, HasNoShearAlongMirrorsAndRollers) {
  const Settings sheared{"initial_stress.sigma_xy=1e6"};
  EXPECT_EQ(refusal({}, box), "");
  EXPECT_THAT(refusal(sheared, box), HasSubstr("bears a shear of 1000000 Pa on the face \"left\""));
  const std::string wall = "[[support]]\nname = \"wall\"\nside = \"left\"\ndirections = [\"x\"]\n";
  std::string half = box;
  half.replace(half.find(wall), wall.size(), "[[symmetry]]\naxis = \"x\"\nposition = 0.0\n");
  EXPECT_THAT(refusal(sheared, half.substr(0, half.find("[[measure]]"))),
              HasSubstr("found a shear along the face \"left\", which is a mirror"));
}

}  // namespace
}  // namespace verification
