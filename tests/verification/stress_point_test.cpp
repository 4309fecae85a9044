// Stress at points, elastic bodies next to incompressibility, with tips and in contact, against
// closed forms.

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "limit_load.hpp"
#include "model/measures.hpp"
#include "run.hpp"

namespace verification {
namespace {

std::string elastic(const std::string& name, double youngs_modulus, double poissons_ratio) {
  return fmt::format(
      "[[material]]\nname = \"{}\"\nmodel = \"elastic\"\nyoungs_modulus = {}\n"
      "poissons_ratio = {}\n",
      name, youngs_modulus, poissons_ratio);
}

std::string side(const std::string& name, const std::string& kind, const std::string& along) {
  return fmt::format("[[side]]\nname = \"{}\"\nkind = {}\nalong = {}\n", name, kind, along);
}

std::string stress_at(const std::string& name, double x, double y) {
  return fmt::format("[[measure]]\nname = \"{}\"\nkind = \"stress\"\nat = [{}, {}]\n", name, x, y);
}

const std::string in_one_step =
    "[approximation]\nkinematics = \"small_strain\"\n[programme]\nsteps = 1\n";

// Two rings, the outer ten times as stiff, under 1 kPa in the bore: across their joint the stress
// around it jumps from next to nothing to the largest there is, and the particle next to a point by
// the joint is often the other ring's.
TEST(StressAtAPoint, IsThatOfTheRegionItIsIn) {
  constexpr double joint = 1.5, nu = 0.3;
  const auto arc = [](double radius, bool forth) {
    return fmt::format("{{ centre = [0, 0], radius = {}, from = {}, to = {} }}", radius,
                       forth ? 0 : 90, forth ? 90 : 0);
  };
  std::string text =
      "[geometry]\nspacing = 0.05\n" + in_one_step + elastic("soft", 1e6, nu) +
      elastic("stiff", 1e7, nu) +
      fmt::format("[[region]]\nmaterial = \"soft\"\noutline = [{}, {}]\n", arc(1.0, false),
                  arc(joint, true)) +
      fmt::format("[[region]]\nmaterial = \"stiff\"\noutline = [{}, {}]\n", arc(joint, false),
                  arc(2.0, true)) +
      side("bore", "\"loaded\"\nlive_pressure = 1e3", fmt::format("[{}]", arc(1.0, false))) +
      side("mantle", "\"free\"", fmt::format("[{}]", arc(2.0, true))) +
      side("left", "\"symmetry\"", "[[0, 2], [0, 1]]") +
      side("bottom", "\"symmetry\"", "[[1, 0], [2, 0]]") +
      "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n[solver]\ntolerance = 1e-6\n";
  constexpr int points = 9;
  for (int i = 0; i < points; ++i) {
    const double angle = (i + 0.5) / points * std::numbers::pi / 2.0;
    for (const double r : {joint - 0.005, joint + 0.005}) {
      text += stress_at(fmt::format("p{}{}", i, r < joint ? "in" : "out"), r * std::cos(angle),
                        r * std::sin(angle));
    }
  }
  verification::Run<2> run(scene_of(text));
  run.complete();
  const auto measured = model::Measures<2>(run.scene, run.model).of(run.state);
  // u = A r + B / r in each ring: pressure, displacement and traction at the joint, a free mantle.
  const double shear = 1e6 / 2.0 / (1.0 + nu), sum = shear / (1.0 - 2.0 * nu);
  Eigen::Matrix4d equations;
  equations << 2.0 * sum, -2.0 * shear, 0.0, 0.0,                                          //
      joint, 1.0 / joint, -joint, -1.0 / joint,                                            //
      2.0 * sum, -2.0 * shear / joint / joint, -20.0 * sum, 20.0 * shear / joint / joint,  //
      0.0, 0.0, 20.0 * sum, -20.0 * shear / 4.0;
  const Eigen::Vector4d rings = equations.fullPivLu().solve(Eigen::Vector4d(-1e3, 0.0, 0.0, 0.0));
  const double inside = 2.0 * sum * rings[0] + 2.0 * shear * rings[1] / joint / joint;
  const double outside = 20.0 * sum * rings[2] + 20.0 * shear * rings[3] / joint / joint;
  double most = 0.0;
  for (std::size_t k = 0; k < measured.size(); k += 4) {
    const double angle = (static_cast<double>(k / 8) + 0.5) / points * std::numbers::pi / 2.0;
    const double c = std::cos(angle), s = std::sin(angle);
    const double around =
        measured[k] * s * s + measured[k + 1] * c * c - 2.0 * measured[k + 3] * s * c;
    most = std::max(most, std::abs(around - (k % 8 == 0 ? inside : outside)));
  }
  report("error_over_largest_stress", most / outside);
  EXPECT_LT(most, 0.1 * outside);  // a face of a curved body at this spacing; it was all of it
}

// Two leaves with a slot of two spacings between them, one under 10 kPa: the other one's face bears
// next to nothing, though the mean stress comes from twice as far as the slot is wide.
TEST(StressAtAPoint, DoesNotReachAcrossASlot) {
  const std::string text =
      "[geometry]\nspacing = 0.05\n" + in_one_step + elastic("m", 1e6, 0.46) +
      "[[region]]\nmaterial = \"m\"\noutline = [[0, 0], [2.1, 0], [2.1, 1], [1.1, 1], [1.1, 0.3], "
      "[1, 0.3], [1, 1], [0, 1]]\n" +
      side("base", "\"fixed\"", "[[0, 0], [2.1, 0]]") +
      side("top", "\"loaded\"\nlive_pressure = 1e4", "[[1, 1], [0, 1]]") +
      side("rest", "\"free\"", "[[2.1, 0], [2.1, 1], [1.1, 1], [1.1, 0.3], [1, 0.3], [1, 1]]") +
      side("left", "\"roller\"", "[[0, 1], [0, 0]]") + stress_at("face", 1.1, 0.8) +
      "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n[solver]\ntolerance = 1e-5\n";
  verification::Run<2> run(scene_of(text));
  run.complete();
  const auto measured = model::Measures<2>(run.scene, run.model).of(run.state);
  // By its own rows 1 %, which the base's bending leaves it; across the slot it was 12 %.
  constexpr double little = 200.0;
  EXPECT_LT(std::abs(measured[0]), little);
  EXPECT_LT(std::abs(measured[1]), little);
}

// A quarter of a cylinder from 1 to 2 m, 1 kPa in its bore (Lame).
std::string cylinder(double spacing, double poissons_ratio, const std::string& mantle_kind) {
  const std::string bore = "{ centre = [0, 0], radius = 1, from = 90, to = 0 }";
  const std::string mantle = "{ centre = [0, 0], radius = 2, from = 0, to = 90 }";
  return fmt::format("[geometry]\nspacing = {}\n", spacing) + in_one_step +
         elastic("m", 1e6, poissons_ratio) +
         fmt::format("[[region]]\nmaterial = \"m\"\noutline = [{}, {}]\n", mantle, bore) +
         side("bore", "\"loaded\"\nlive_pressure = 1e3", fmt::format("[{}]", bore)) +
         side("mantle", mantle_kind, fmt::format("[{}]", mantle)) +
         side("left", "\"symmetry\"", "[[0, 1], [0, 2]]") +
         side("bottom", "\"symmetry\"", "[[1, 0], [2, 0]]") +
         "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n[solver]\ntolerance = 1e-6\n";
}

// Held around its mantle a body that hardly changes its volume hardly moves; springs of so many
// Young's moduli gave way by 225 % more than it does. Second order, as of a mantle that is free
// (1.5 % at this spacing with a Poisson's ratio of 0.3).
TEST(HeldMantle, HardlyGivesWayNextToIncompressibility) {
  const double b = 2.0, modulus = 1e6, nu = 0.4999, pressure = 1e3;
  const double shear = modulus / 2.0 / (1.0 + nu), sum = shear / (1.0 - 2.0 * nu);
  const double strain = -pressure / (2.0 * sum + 2.0 * shear * b * b);
  for (const char* kind : {"\"fixed\"", "\"roller\""}) {
    verification::Run<2> run(
        scene_of(cylinder(0.1, nu, kind) +
                 "[[measure]]\nname = \"u\"\nkind = \"displacement\"\nat = [1, 0]\n"));
    run.complete();
    const auto measured = model::Measures<2>(run.scene, run.model).of(run.state);
    const double error = measured[0] / (strain * (1.0 - b * b)) - 1.0;
    report(std::string("error_of_") + (kind[1] == 'f' ? "fixed" : "roller"), error);
    EXPECT_LT(std::abs(error), 0.03) << kind;
  }
}

// The particles' own mean stress alternates: at faces it was off by 0.7 of the largest stress at
// this spacing, and by 1.35 of it at half of that. Wanted: what a Poisson's ratio of 0.3 has, 0.1.
TEST(CylinderOfArcs, ShowsItsStressAtFacesNextToIncompressibility) {
  std::string text = cylinder(0.05, 0.4999, "\"free\"");
  for (const int degrees : {0, 15, 30, 45}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    for (const double r : {1.0, 2.0}) {
      text +=
          stress_at(fmt::format("s{}_{}", degrees, r), r * std::cos(angle), r * std::sin(angle));
    }
  }
  verification::Run<2> run(scene_of(text));
  run.complete();
  const auto measured = model::Measures<2>(run.scene, run.model).of(run.state);
  // The trace in the plane is the same all over, 2 p a^2 / (b^2 - a^2).
  const double trace = 2e3 / 3.0, largest = 5e3 / 3.0;
  double most = 0.0;
  for (std::size_t k = 0; k < measured.size(); k += 4) {
    most = std::max(most, std::abs(0.5 * (measured[k] + measured[k + 1] - trace)));
  }
  report("error_of_mean_over_largest_stress", most / largest);
  EXPECT_LT(most, 0.1 * largest);
}

// A tip of 25 degrees, pressed all around. Blocks and grid took 1 800 evaluations or did not get
// there; by factors the balance is linear in one body.
TEST(SharpCorner, BearsPressureAllAroundInAFewEvaluations) {
  const std::string outline = "[[0, 0], [3, 0], [0, 1.4]]";
  verification::Run<2> run(scene_of(
      "[geometry]\nspacing = 0.1\n" + in_one_step + elastic("m", 1e6, 0.3) +
      "[[region]]\nmaterial = \"m\"\noutline = " + outline + "\n" +
      side("all", "\"loaded\"\nlive_pressure = 1e3", "[[0, 0], [3, 0], [0, 1.4], [0, 0]]") +
      "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n"
      "[solver]\ntolerance = 1e-8\n"));
  EXPECT_LT(run.complete().back().evaluations, 20);
  constexpr double bound = 1e-6;  // the solver's tolerance on a body of 30 by 14
  for (const int component : {0, 1}) {
    const Eigen::ArrayXd stress = run.state.stress.row(component).transpose().array();
    EXPECT_LT((stress + 1e3).abs().maxCoeff(), bound * 1e3) << component;
  }
  EXPECT_LT(run.state.stress.row(3).cwiseAbs().maxCoeff(), bound * 1e3);
}

// A block of 2 m by 1 m on a slope of 30 degrees with a face of 31, all but sliding: blocks and
// grid did not get there in the evaluations that a step has. Its weight and the slope's is on the
// base.
TEST(BlockOnASlope, StandsWhereItsFaceIsALittleSteeper) {
  const double c = std::sqrt(0.75), s = 0.5;
  const auto turned = [&](double x, double y) {
    return fmt::format("[{}, {}]", x * c - y * s, x * s + y * c);
  };
  const std::string corner = turned(4.0, 0.0), foot = turned(1.0, 0.0), head = turned(3.0, 0.0);
  const std::string slope = fmt::format("[[0, -1], [{0}, -1], {1}, [0, 0]]", 4.0 * c, corner);
  const std::string block = turned(3.0, 1.0) + ", " + turned(1.0, 1.0);
  const std::string weighty = "unit_weight = 1e4\n";
  verification::Run<2> run(scene_of(
      "[geometry]\nspacing = 0.1\n" + in_one_step + elastic("block", 1e7, 0.3) + weighty +
      elastic("slope", 1e7, 0.3) + weighty + "[[region]]\nmaterial = \"slope\"\noutline = " +
      slope + "\n[[region]]\nmaterial = \"block\"\noutline = [" + foot + ", " + head + ", " +
      block + "]\n" + side("base", "\"fixed\"", fmt::format("[[0, -1], [{}, -1]]", 4.0 * c)) +
      side("surface", "\"free\"",
           fmt::format("[[{0}, -1], {1}, {2}, {3}, {4}, [0, 0], [0, -1]]", 4.0 * c, corner, head,
                       block, foot)) +
      "[[interface]]\nbetween = [\"slope\", \"block\"]\nkind = \"contact\"\n"
      "friction_angle = 31\n[drive]\nkind = \"load\"\nscales = [\"gravity\"]\n"
      "[[measure]]\nname = \"R\"\nkind = \"reaction\"\nsupport = \"base\"\n"));
  run.complete();
  const auto reaction = model::Measures<2>(run.scene, run.model).of(run.state);
  const double weight = 1e4 * (2.0 + 4.0 * c * (1.0 + 1.0));
  constexpr double bound = 2e-3;  // twice the solver's tolerance
  EXPECT_NEAR(reaction[1] / weight, 1.0, bound);
  EXPECT_NEAR(reaction[0] / weight, 0.0, bound);
}

}  // namespace
}  // namespace verification
