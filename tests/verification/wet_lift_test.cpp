// A lift that is put down with pore pressure in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "measure.hpp"
#include "model/model.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

constexpr double weight = 20e3;                           // [N/m3]
constexpr double oedometric = 1e7 * 0.75 / (1.25 * 0.5);  // E (1 - nu) / ((1 + nu)(1 - 2 nu))

// Two metres of ground between smooth walls, which were at rest, and a lift of two more.
std::string column(const std::string& interfaces, double spacing, const std::string& water,
                   const std::string& later) {
  const auto material = [](const std::string& name) {
    return "[[material]]\nname = \"" + name +
           "\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\npoissons_ratio = 0.25\n"
           "unit_weight = 20e3\n";
  };
  return "[geometry]\nspacing = " + std::to_string(spacing) +
         "\n[approximation]\nkinematics = \"small_strain\"\ninterfaces = \"" + interfaces +
         "\"\n[solver]\ntolerance = 1e-6\n[initial_stress]\nkind = \"gravity\"\n" +
         material("ground") + material("fill") + "[water]\n" + water + R"(
[[region]]
name = "ground"
material = "ground"
outline = [[0, 0], [2, 0], [2, 2], [0, 2]]
[[region]]
name = "lift"
material = "fill"
outline = [[0, 2], [2, 2], [2, 4], [0, 4]]
[[side]]
name = "top"
kind = "free"
along = [[2, 4], [0, 4]]
[[side]]
name = "held"
kind = "roller"
along = [[0, 4], [0, 0], [2, 0], [2, 4]]
[[stage]]
name = "lift"
place = ["lift"]
steps = 2
)" + later;
}

// Settlement of the particles since the ground was at rest, against the integral of what the
// effective stress has gained over E_oed. The worst, over the largest.
template <class Gain>
double error_of(const std::string& text, const Gain& gain) {
  StagedRun run(scene_of(text));
  run.complete();
  const auto settlement = [&](double y) {
    constexpr int cuts = 400;
    double sum = 0.0;
    for (int i = 0; i < cuts; ++i) sum += gain((i + 0.5) * y / cuts) * y / cuts;
    return sum / oedometric;
  };
  double worst = 0.0;
  for (Eigen::Index a = 0; a < run.state.displacement.rows(); ++a) {
    const double y = run.stages.model().particles.position(a, 1);
    worst = std::max(worst, std::abs(run.state.displacement(a, 1) + settlement(y)));
  }
  return worst / settlement(4.0);
}

struct Pair {
  double coarse, fine;
};

template <class Gain>
Pair errors_of(const std::string& interfaces, const std::string& water, const std::string& later,
               const Gain& gain) {
  const Pair pair{error_of(column(interfaces, 0.25, water, later), gain),
                  error_of(column(interfaces, 0.125, water, later), gain)};
  report("settlement_error_" + interfaces + "_4_cells", pair.coarse);
  report("settlement_error_" + interfaces + "_8_cells", pair.fine);
  return pair;
}

class WetLift : public ::testing::TestWithParam<const char*> {};

// Lumps of weight are half a cell off beside faces, of 16 and 32 cells in the column.
constexpr double half_a_cell = 1.0 / 32.0, finer = 0.7;

// What was built fast keeps its water: 20 kPa at its foot, which drains to its top and the base.
TEST_P(WetLift, OfAPressureOfItsOwnSettlesByWhatIsEffective) {
  const auto [coarse, fine] = errors_of(
      GetParam(), "pore_pressure = { along = \"y\", table = [[0, 1], [4, 0]] }",
      "pore_pressure = { along = \"y\", table = [[0, 1], [2, 20e3], [4, 0]] }\n", [](double y) {
        const double pressure = y < 2.0 ? 10e3 * y : 10e3 * (4.0 - y);
        return weight * (4.0 - std::max(y, 2.0)) - pressure;
      });
  EXPECT_LT(coarse, half_a_cell);
  EXPECT_LT(fine, finer * coarse);
}

// Water rises to half of the lift as that is put down.
TEST_P(WetLift, ThatIsFloodedSettlesByItsBuoyantWeight) {
  const auto [coarse, fine] = errors_of(
      GetParam(), "table = [[0, 0], [2, 0]]", "water_table = [[0, 3], [2, 3]]\n",
      [](double y) { return weight * (4.0 - std::max(y, 2.0)) - 9810.0 * std::max(3.0 - y, 0.0); });
  EXPECT_LT(coarse, half_a_cell);
  EXPECT_LT(fine, finer * coarse);
}

INSTANTIATE_TEST_SUITE_P(Stages, WetLift, ::testing::Values("through", "tied"));

}  // namespace
}  // namespace verification
