// What supports and drives bear, and the loads, come to nothing together.
#include <gtest/gtest.h>

#include <string>

#include "model/measures.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

// The sum of all columns of reactions along one axis.
double reactions(const StagedRun& run, const std::string& axis) {
  const model::Measures<2> measures(run.stages.scene(), run.stages.model());
  const std::string end = "_R" + axis + "_N_per_m";
  double sum = 0.0;
  const std::vector<double> values = measures.of(run.state);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (measures.columns()[i].ends_with(end)) sum += values[i];
  }
  return sum;
}

struct Corner {
  const char* name;
  std::string base, left, more;
};

class Reactions : public ::testing::TestWithParam<Corner> {};

// A block under its weight and pushed along its top, held twice where its sides meet.
TEST_P(Reactions, OfSupportsThatMeetSumToTheLoads) {
  const auto support = [](const char* name, const std::string& rest) {
    return "[[support]]\nname = \"" + std::string(name) + "\"\n" + rest;
  };
  StagedRun run(scene_of(R"(
[geometry]
min = [0.0, 0.0]
max = [2.0, 1.0]
spacing = 0.125
[approximation]
kinematics = "small_strain"
[[material]]
name = "m"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
density = 2e3
[gravity]
acceleration = [0.0, -10.0]
[[traction]]
name = "push"
side = "top"
value = [3e3, -1e3]
[drive]
kind = "load"
scales = ["gravity", "traction"]
[programme]
steps = 1
[solver]
tolerance = 1e-8
)" + support("base", "side = \"bottom\"\n" + GetParam().base) +
                         support("left", "side = \"left\"\n" + GetParam().left) + GetParam().more));
  ASSERT_TRUE(run.complete_stage());
  // The solver leaves 1e-8 of forces open in each of 128 particles.
  constexpr double of_solver = 1e-6;
  const double weight = 2e3 * 10.0 * 2.0;
  EXPECT_NEAR(reactions(run, "x"), -3e3 * 2.0, of_solver * weight);
  EXPECT_NEAR(reactions(run, "y"), weight + 1e3 * 2.0, of_solver * weight);
}

const std::string both = "directions = [\"x\", \"y\"]\n";
const std::string in_region =
    "[[support]]\nname = \"toe\"\nregion_min = [0.0, 0.0]\nregion_max = [0.5, 0.2]\n"
    "directions = [\"x\", \"y\"]\n";
const std::string at_corner =
    "[[support]]\nname = \"pin\"\nat = [0.0, 0.0]\ndirections = [\"x\", \"y\"]\n";

INSTANTIATE_TEST_SUITE_P(
    Corners, Reactions,
    ::testing::Values(
        Corner{"Direct", both + "method = \"direct\"\n", both + "method = \"direct\"\n", ""},
        Corner{"Ghosts", both, both, ""},
        Corner{"DirectAndGhosts", both + "method = \"direct\"\n", both, ""},
        Corner{"GhostsAndPenalty", both, both + "method = \"penalty\"\n", ""},
        Corner{"RegionOverTheCorner", both, "directions = [\"x\"]\n", in_region},
        Corner{"PinAtTheCorner", both + "method = \"direct\"\n", both + "method = \"direct\"\n",
               at_corner},
        Corner{"TwoOfOneSide", "directions = [\"y\"]\n", "directions = [\"x\"]\n",
               "[[support]]\nname = \"rough\"\nside = \"bottom\"\ndirections = [\"x\"]\n"}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace verification
