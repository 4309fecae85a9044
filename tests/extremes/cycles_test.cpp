// There and back: unloading, reversal and cycles.

#include <fmt/format.h>

#include <numbers>

#include "cycles.hpp"

namespace extremes {
namespace {

constexpr double of_solver = 1e-5;
const std::string from_solver =
    "solver's tolerance of 1e-8 on a body of 5 by 10, yielding particles of no stiffness";
const std::string stress_there =
    "clay pressed, pulled as far and brought back, stress at each end: E / (1 - nu²) times the "
    "strain between ± 2 c";

TEST(Axis, Reversal) {
  std::vector<std::pair<std::string, CycledBlock>> blocks;
  for (const double far : {0.5, 0.9, 1.1, 2.0, 10.0, 100.0}) {
    blocks.push_back({fmt::format("{}", far), {{far, -far, 0.0}}});
  }
  sweep(of_cycled("strain of a cycle over that at yield", stress_there, of_solver, from_solver,
                  blocks));
}

TEST(Axis, Cycles) {
  std::vector<std::pair<std::string, CycledBlock>> blocks;
  for (const int cycles : {1, 10, 100}) {
    CycledBlock block{{}, 4};
    for (int k = 0; k < cycles; ++k) block.places.insert(block.places.end(), {2.0, -2.0});
    blocks.push_back({fmt::format("{}", cycles), block});
  }
  sweep(of_cycled("cycles of twice the strain at yield", stress_there, of_solver, from_solver,
                  blocks));
}

TEST(Axis, StepsOfACycle) {
  std::vector<std::pair<std::string, CycledBlock>> blocks;
  for (const int steps : {1, 3, 30, 1000}) {
    blocks.push_back({fmt::format("{}", steps), {{2.0, -2.0, 0.0}, steps}});
  }
  sweep(of_cycled("steps on each way of a cycle", stress_there, of_solver, from_solver, blocks));
}

// Sand under a pressure on its free side goes to its passive and then to its active state, the
// pressure times and over tan^2(45 + phi/2).
TEST(Axis, FrictionThereAndBack) {
  constexpr double pressure = 1e3, poisson = 0.3;
  Axis axis{"friction angle = dilation angle [deg], there and back",
            "sand without cohesion pressed to its passive, then pulled to its active stress", 1e-4,
            "solver's tolerance of 1e-6, ten steps"};
  std::vector<double> factors;
  for (const double angle : {5.0, 10.0, 20.0, 30.0, 40.0, 50.0}) {
    const double s = std::sin(angle * std::numbers::pi / 180.0);
    const double factor = factors.emplace_back((1.0 + s) / (1.0 - s));
    const double young = 1e3 * factor * pressure;
    const double whole = factor * pressure * (1.0 - poisson * poisson) / young;  // strain
    axis.samples.push_back(
        {fmt::format("{}", angle),
         box(0, 0, 0.5, 1, 0.1) + small_strain +
             fmt::format(
                 "[[material]]\nname = \"sand\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = {}\n"
                 "poissons_ratio = {}\ncohesion = 0\nfriction_angle = {}\ndilation_angle = {}\n",
                 young, poisson, angle, angle) +
             on_rollers +
             fmt::format("[[traction]]\nname = \"cell\"\nside = \"right\"\nvalue = [{}, 0.0]\n"
                         "[initial_stress]\nkind = \"none\"\n",
                         -pressure) +
             "[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
             "direction = [0.0, -1.0]\nwidth = 0.5\n"
             "[solver]\ntolerance = 1e-6\nmax_evaluations_per_step = 5000\n" +
             fmt::format("[[stage]]\nname = \"passive\"\nto = {}\nsteps = 10\n"
                         "[[stage]]\nname = \"active\"\nto = {}\nsteps = 10\n",
                         1.5 * whole, -1.5 * whole)});
  }
  axis.course = [factors](const verification::TestScene& scene, std::size_t k) {
    double error = 0.0, exact = pressure * factors[k];
    run_stages(scene, [&](const auto&, const model::State<2>& state) {
      error = std::max(error, (state.stress.row(1).array() + exact).abs().maxCoeff() / exact);
      exact = pressure / factors[k];
    });
    return error;
  };
  sweep(axis);
}

// Held on its sides and pulled, soil slides along its surface to the apex: c cot(phi) in every
// direction, however much farther it is pulled, and elastic again on the way back. Uniaxial strain
// is within the flow of the apex, so ten times the strain of its stress is enough to be there.
TEST(Axis, Apex) {
  constexpr double cohesion = 1e3, angle = 30.0, young = 1e6, poisson = 0.3;
  const double tip = cohesion / std::tan(angle * std::numbers::pi / 180.0);
  const double confined = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const double at_tip = tip / confined;
  Axis axis{"strain of a confined pull over that of the tip's stress",
            "apex everywhere: stress c cot(phi), and 0 in the middle of the way back", of_solver,
            from_solver};
  const std::vector<double> pulls{10.0, 100.0, 1000.0, 10000.0};
  for (const double pull : pulls) {
    axis.samples.push_back(
        {fmt::format("{}", pull),
         box(0, 0, 0.5, 1, 0.1) + small_strain +
             fmt::format(
                 "[[material]]\nname = \"soil\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = {}\n"
                 "poissons_ratio = {}\ncohesion = {}\nfriction_angle = {}\ndilation_angle = {}\n",
                 young, poisson, cohesion, angle, angle) +
             on_rollers +
             "[[support]]\nname = \"other wall\"\nside = \"right\"\ndirections = [\"x\"]\n"
             "[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
             "direction = [0.0, 1.0]\nwidth = 0.5\n"
             "[solver]\ntolerance = 1e-8\nmax_evaluations_per_step = 5000\n" +
             fmt::format("[[stage]]\nname = \"pull\"\nto = {}\nsteps = 10\n"
                         "[[stage]]\nname = \"back\"\nto = {}\nsteps = 2\n",
                         pull * at_tip, (pull - 1.0) * at_tip)});
  }
  axis.course = [tip](const verification::TestScene& scene, std::size_t) {
    double error = 0.0, exact = tip;
    run_stages(scene, [&](const auto&, const model::State<2>& state) {
      error = std::max(error, (state.stress.row(1).array() - exact).abs().maxCoeff() / tip);
      if (exact > 0.0) {
        error = std::max(error, (state.stress.row(0).array() - exact).abs().maxCoeff() / tip);
      }
      exact = 0.0;
    });
    return error;
  };
  sweep(axis);
}

}  // namespace
}  // namespace extremes
