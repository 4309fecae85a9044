// Axes of parameters, each to its edges: every answer is right, or there is none and a reason. The
// table of share/doc/extremes.md is written by
//
//   EXTREMES_WRITE=rows extremes_tests --gtest_filter='Axis.*'
#include "sweep.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "block.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"

namespace extremes {
namespace {

// The largest departure of the vertical stress from the pressure on top, over it.
double stress_error(PlaneRun& run, double pressure) {
  return (run.state.stress.row(1).array() + pressure).abs().maxCoeff() / pressure;
}

// Of the settlement from that of plane strain between free sides, over the largest.
double settlement_error(PlaneRun& run, double pressure, double youngs_modulus,
                        double poissons_ratio) {
  const double strain = pressure * (1.0 - poissons_ratio * poissons_ratio) / youngs_modulus;
  const Eigen::ArrayXd height = run.model.particles.position.col(1).array() - run.model.box_min[1];
  const Eigen::ArrayXd moved = run.state.displacement.col(1).array();
  return (moved + strain * height).abs().maxCoeff() / (strain * height.maxCoeff());
}

constexpr double patch = 1e-7;
constexpr char of_patch[] = "solver's tolerance of 1e-10 on a body of 10 by 10";

TEST(Axis, PoissonsRatio) {
  const std::vector<double> ratios{-0.9, -0.5, 0.0, 0.3, 0.49, 0.499, 0.4999, 0.49999, 0.5, -1.0};
  Axis axis{"Poisson's ratio", "pressed block, settlement", 1e-6,
            "the same, softer against shear by 1 / (1 - 2 nu)"};
  for (const double nu : ratios) {
    axis.samples.push_back({fmt::format("{}", nu),
                            box(0, 0, 1, 1, 0.1) + small_strain + elastic(1e6, nu) + on_rollers +
                                pressed_by(1e3) + tightly,
                            nu > -1.0 && nu < 0.5});
  }
  axis.error = [&](PlaneRun& run, std::size_t k) {
    return settlement_error(run, 1e3, 1e6, ratios[k]);
  };
  sweep(axis);
}

TEST(Axis, YoungsModulus) {
  Axis axis{"Young's modulus [Pa]", "pressed block, settlement", patch, of_patch};
  std::vector<double> moduli;
  for (const int decade : {-6, -3, 0, 3, 6, 9, 12, 15}) moduli.push_back(std::pow(10.0, decade));
  for (const double modulus : moduli) {
    axis.samples.push_back({fmt::format("{:.0e}", modulus),
                            box(0, 0, 1, 1, 0.1) + small_strain + elastic(modulus, 0.3) +
                                on_rollers + pressed_by(1e-3 * modulus) + tightly});
  }
  axis.error = [&](PlaneRun& run, std::size_t k) {
    return settlement_error(run, 1e-3 * moduli[k], moduli[k], 0.3);
  };
  sweep(axis);
}

TEST(Axis, Size) {
  Axis axis{"size of the body [m]", "pressed block, settlement", patch, of_patch};
  for (const int decade : {-9, -6, -3, 0, 3, 6, 9}) {
    const double size = std::pow(10.0, decade);
    axis.samples.push_back({fmt::format("{:.0e}", size),
                            box(0, 0, size, size, 0.1 * size) + small_strain + elastic(1e6, 0.3) +
                                on_rollers + pressed_by(1e3) + tightly});
  }
  axis.error = [](PlaneRun& run, std::size_t) { return settlement_error(run, 1e3, 1e6, 0.3); };
  sweep(axis);
}

// Coordinates are known to half a unit in their last place, strains to that over a spacing; what is
// compared is a strain of 1e-3.
TEST(Axis, Origin) {
  Axis axis{"origin [m] of a body of 1 m", "pressed block, settlement", 1e-4,
            "round-off of coordinates at 1e7 m over a spacing of 0.1 m, over the strain of 1e-3"};
  for (const double origin : {0.0, 1e3, 1e4, 1e5, 1e6, 1e7, 1e9}) {
    axis.samples.push_back({fmt::format("{:.0e}", origin),
                            box(origin, origin, 1, 1, 0.1) + small_strain + elastic(1e6, 0.3) +
                                on_rollers + pressed_by(1e3) + tightly,
                            origin <= 1e5});
  }
  axis.error = [](PlaneRun& run, std::size_t) { return settlement_error(run, 1e3, 1e6, 0.3); };
  sweep(axis);
}

TEST(Axis, Jitter) {
  Axis axis{"jitter", "pressed block, stress", 1e-6,
            "constant stress, solver's tolerance of 1e-10"};
  for (const double jitter : {0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.5}) {
    axis.samples.push_back({fmt::format("{}", jitter),
                            box(0, 0, 1, 1, 0.1) + fmt::format("jitter = {}\n", jitter) +
                                small_strain + elastic(1e6, 0.3) + on_rollers + pressed_by(1e3) +
                                tightly,
                            jitter <= 0.4});
  }
  axis.error = [](PlaneRun& run, std::size_t) { return stress_error(run, 1e3); };
  sweep(axis);
}

TEST(Axis, Particles) {
  const std::vector<std::pair<int, int>> counts{{1, 1}, {1, 2}, {2, 1}, {1, 5}, {2, 2},
                                                {3, 2}, {3, 3}, {4, 3}, {5, 5}, {3, 50}};
  Axis axis{"particles across and up", "pressed block, stress", 1e-6,
            "constant stress, solver's tolerance of 1e-10"};
  for (const auto& [across, up] : counts) {
    axis.samples.push_back({fmt::format("{} × {}", across, up),
                            box(0, 0, 0.1 * across, 0.1 * up, 0.1) + small_strain +
                                elastic(1e6, 0.3) + on_rollers + pressed_by(1e3) + tightly,
                            across >= 3 && up >= 3});
  }
  axis.error = [](PlaneRun& run, std::size_t) { return stress_error(run, 1e3); };
  sweep(axis);
}

// Strains of the stiffer layer are differences of displacements that the softer one has: 1e-16 of
// these, over a spacing, are 1e-15 of the settlement's strain, or 1e-15 of the contrast in stress.
// A few times ten thousand of such roundings meet in a force and in the solver's sums.
TEST(Axis, Contrast) {
  Axis axis{"ratio of two layers' stiffness", "pressed column, stress", 1e-4,
            "round-off of displacements, 1e-10 of the contrast"};
  for (const int decade : {0, 2, 4, 6}) {
    axis.samples.push_back({fmt::format("1e{}", decade),
                            box(0, 0, 0.5, 1, 0.1) + small_strain + elastic(1e6, 0.0) +
                                fmt::format("[[material]]\nname = \"upper\"\nmodel = \"elastic\"\n"
                                            "youngs_modulus = {}\npoissons_ratio = 0.0\n"
                                            "region_min = [0.0, 0.5]\nregion_max = [0.5, 1.0]\n",
                                            1e6 * std::pow(10.0, decade)) +
                                on_rollers + pressed_by(1e3) + tightly,
                            decade <= 6});
  }
  axis.error = [](PlaneRun& run, std::size_t) { return stress_error(run, 1e3); };
  sweep(axis);
}

// A block squeezed between smooth plates, under a pressure on its free side.
struct Squeezed {
  double cohesion = 1e3, friction_angle = 0.0, dilation_angle = 0.0, pressure = 0.0;
  int steps = 10;
  std::string model = "mohr_coulomb";

  double strength() const {
    if (friction_angle >= 90.0) return cohesion;  // none to speak of
    const double angle = friction_angle * std::numbers::pi / 180.0;
    const double passive = (1.0 + std::sin(angle)) / (1.0 - std::sin(angle));
    return passive * pressure + 2.0 * cohesion * std::sqrt(passive);
  }
  std::string scene() const {
    const double modulus = 1e3 * strength();
    std::string text =
        box(0, 0, 0.5, 1, 0.1) + small_strain +
        fmt::format(
            "[[material]]\nname = \"soil\"\nmodel = \"{}\"\nyoungs_modulus = {}\n"
            "poissons_ratio = 0.3\ncohesion = {}\nfriction_angle = {}\ndilation_angle = {}\n",
            model, modulus, cohesion, friction_angle, dilation_angle) +
        on_rollers +
        "[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
        "direction = [0.0, -1.0]\ntarget = 0.0015\nwidth = 0.5\n"
        "[solver]\ntolerance = 1e-6\nmax_evaluations_per_step = 5000\n" +
        fmt::format("[programme]\nsteps = {}\n", steps);
    if (pressure > 0.0) {
      text += fmt::format(
          "[[traction]]\nname = \"cell\"\nside = \"right\"\nvalue = [{0}, 0.0]\n"
          "[initial_stress]\nkind = \"none\"\n",
          -pressure);
    }
    return text;
  }
  double error(PlaneRun& run) const {
    return (run.state.stress.row(1).array() + strength()).abs().maxCoeff() / strength();
  }
};

Axis squeezed(const std::string& name, std::vector<std::pair<std::string, Squeezed>> blocks,
              const std::function<bool(const Squeezed&)>& is_held) {
  Axis axis{name, "squeezed block, strength", 1e-4, "solver's tolerance of 1e-6, ten steps"};
  for (const auto& [value, block] : blocks) {
    axis.samples.push_back({value, block.scene(), is_held(block)});
  }
  axis.error = [blocks](PlaneRun& run, std::size_t k) { return blocks[k].second.error(run); };
  return axis;
}

TEST(Axis, FrictionAngle) {
  std::vector<std::pair<std::string, Squeezed>> blocks;
  for (const double angle : {0.0, 5.0, 20.0, 40.0, 50.0, 59.0, 60.0, 70.0, 89.0, 90.0}) {
    blocks.push_back({fmt::format("{}", angle), {1e3, angle, angle, 0.0}});
  }
  sweep(squeezed("friction angle = dilation angle [deg]", blocks,
                 [](const Squeezed& block) { return block.friction_angle < 60.0; }));
}

// Beyond, soil that does not dilate parts into bands as soon as it yields, and no uniform answer is
// left to compare with.
TEST(Axis, FrictionAngleWithoutDilation) {
  std::vector<std::pair<std::string, Squeezed>> blocks;
  for (const double angle : {0.0, 5.0, 20.0, 40.0, 50.0}) {
    blocks.push_back({fmt::format("{}", angle), {1e3, angle, 0.0, 0.0}});
  }
  sweep(
      squeezed("friction angle, no dilation [deg]", blocks, [](const Squeezed&) { return true; }));
}

TEST(Axis, Cohesion) {
  std::vector<std::pair<std::string, Squeezed>> blocks;
  for (const double cohesion : {0.0, 1e-6, 1.0, 1e3, 1e6, 1e9}) {
    blocks.push_back({fmt::format("{:.0e}", cohesion), {cohesion, 30.0, 0.0, 1e3}});
  }
  sweep(
      squeezed("cohesion [Pa] at 30°, under 1 kPa", blocks, [](const Squeezed&) { return true; }));
}

TEST(Axis, Steps) {
  std::vector<std::pair<std::string, Squeezed>> blocks;
  for (const int steps : {1, 2, 10, 100, 1000}) {
    Squeezed block{1e3, 30.0, 30.0, 0.0};
    block.steps = steps;
    blocks.push_back({fmt::format("{}", steps), block});
  }
  sweep(squeezed("steps to half as much again as the strain at yield", blocks,
                 [](const Squeezed&) { return true; }));
}

// Clay squeezed to 0.7 of its height bears 2 c, whichever particles are neighbours; the least
// trigger is passed in every step.
TEST(Axis, ReSearch) {
  const std::vector<double> triggers{1e-6, 0.01, 0.15, 10.0};
  constexpr double cohesion = 1e3;
  constexpr int steps = 30;
  Axis axis{"strain at which neighbours are sought anew",
            "squeezed clay at 0.7 of its height, strength", 1e-4,
            "solver's tolerance of 1e-6, thirty steps"};
  for (const double trigger : triggers) {
    axis.samples.push_back(
        {fmt::format("{}", trigger),
         box(0, 0, 0.5, 1, 0.1) +
             fmt::format("[[material]]\nname = \"clay\"\nmodel = \"mohr_coulomb\"\n"
                         "youngs_modulus = {}\npoissons_ratio = 0.3\ncohesion = {}\n"
                         "friction_angle = 0.0\ndilation_angle = 0.0\n",
                         2e3 * cohesion, cohesion) +
             on_rollers +
             fmt::format("[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
                         "direction = [0.0, -1.0]\ntarget = 0.3\nwidth = 0.5\n"
                         "[solver]\ntolerance = 1e-6\nmax_evaluations_per_step = 5000\n"
                         "[programme]\nsteps = {}\n[re_search]\nenabled = true\ntrigger = {}\n",
                         steps, trigger)});
  }
  axis.course = [&](const verification::TestScene& scene, std::size_t k) {
    PlaneRun run{scene};
    int searches = 0;
    while (!run.stepper.finished()) {
      const stepping::StepResult result = run.stepper.advance();
      if (result.outcome != stepping::StepOutcome::converged) {
        throw std::runtime_error(result.reason);
      }
      searches += result.record.re_searched_rows > 0 ? 1 : 0;
    }
    expect_finite(run);
    const int least = k == 0 ? steps : 0;
    const int most = k + 1 == triggers.size() ? 0 : searches;
    EXPECT_GE(searches, least) << "at every step";
    EXPECT_LE(searches, most) << "at none";
    return (run.state.stress.row(1).array() + 2.0 * cohesion).abs().maxCoeff() / (2.0 * cohesion);
  };
  sweep(axis);
}

// Without lateral strain the logarithmic law is exact whatever the steps: sigma = E ln(stretch).
TEST(Axis, Stretch) {
  const std::vector<double> stretches{0.05, 0.1, 0.2, 0.5, 0.9, 1.1, 1.5, 2.0, 2.5, 5.0, 10.0};
  Axis axis{"stretch of a bar", "stress E ln(stretch), nu = 0", 1e-3,
            "midpoint rule over steps of 1 % of the height, at 0.05"};
  for (const double stretch : stretches) {
    axis.samples.push_back(
        {fmt::format("{}", stretch),
         box(0, 0, 0.5, 1, 0.1) + elastic(1e6, 0.0) + on_rollers +
             fmt::format("[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
                         "direction = [0.0, {}]\ntarget = {}\nwidth = 0.5\n"
                         "[solver]\ntolerance = 1e-6\nmax_evaluations_per_step = 2000\n",
                         stretch < 1.0 ? -1.0 : 1.0, std::abs(stretch - 1.0)),
         stretch >= 0.2 && stretch <= 2.0});
  }
  axis.error = [&](PlaneRun& run, std::size_t k) {
    const double exact = 1e6 * std::log(stretches[k]);
    return (run.state.stress.row(1).array() - exact).abs().maxCoeff() / std::abs(exact);
  };
  sweep(axis);
}

// Every number of a scene that is none is refused by its key; one so small that its square is
// nothing is refused, too, or leaves nothing but finite numbers behind.
TEST(Numbers, ThatAreNoneOrNearlyNothingDoNoHarm) {
  const std::string good = box(0, 0, 0.5, 0.5, 0.1) + small_strain + elastic(1e6, 0.3) +
                           on_rollers + pressed_by(1e3) +
                           "[gravity]\nacceleration = [0.0, -9.81]\n" + tightly;
  const std::string heavy =
      std::string(good).replace(good.find("poissons_ratio"), 0, "density = 2000.0\n");
  int refused = 0, harmless = 0;
  for (const scene::SceneTable& table : scene::scene_tables()) {
    for (const auto& field : table.fields) {
      const bool is_number = field.kind == tables::ValueKind::number ||
                             field.kind == tables::ValueKind::numbers ||
                             field.kind == tables::ValueKind::varying;
      if (!is_number) continue;
      const std::string key = table.path(0, field.key);
      for (const char* value : {"nan", "inf", "-inf", "1e400"}) {
        const auto reading = scene::parse_scene(heavy, "scene", std::vector{key + "=" + value});
        EXPECT_FALSE(reading.scene) << key << " = " << value;
        ASSERT_FALSE(reading.errors.empty());
        EXPECT_NE(reading.errors.front().text().find(key.substr(0, key.find('.'))),
                  std::string::npos)
            << reading.errors.front().text();
        ++refused;
      }
      const auto reading = scene::parse_scene(heavy, "scene", std::vector{key + "=4.9e-324"});
      if (!reading.scene) continue;
      ++harmless;
      SCOPED_TRACE(key);
      try {
        PlaneRun run{verification::TestScene(*reading.scene)};
        (void)run.stepper.advance();
        expect_finite(run);
      } catch (const std::exception& reason) {
        EXPECT_NE(std::string(reason.what()), "");
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(harmless, 10);
}

}  // namespace
}  // namespace extremes
