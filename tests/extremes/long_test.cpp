// What takes long: label `validation`.

#include <malloc.h>

#include <cmath>

#include "cycles.hpp"
#include "turns.hpp"

namespace extremes {
namespace {

/// Bytes that are allocated now; 0 where another allocator stands in for the C library's.
double allocated() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

TEST(Axis, TurnsOfSmallSteps) {
  sweep(turning({{1000, 72}}));
}

// There, back and home in 10 000 and 100 000 steps.
TEST(Axis, StepsOfALongCycle) {
  std::vector<std::pair<std::string, CycledBlock>> blocks;
  for (const int steps : {2500, 25000}) {
    blocks.push_back({fmt::format("{}", 4 * steps), {{2.0, 0.0, -2.0, 0.0}, steps}});
  }
  Axis axis = of_cycled("steps of a cycle in all",
                        "clay pressed, pulled as far and brought back: stress at each end, and "
                        "memory after a thousand steps and at the end",
                        1e-5, "solver's tolerance of 1e-8, as on the way of fewer steps", blocks);
  axis.course = [blocks](const verification::TestScene& scene, std::size_t k) {
    // The secant pairs of the solver are all in use by then.
    constexpr long settled = 1000;
    constexpr double page = 4096.0;  // what the test itself may hold
    long step = 0;
    double early = 0.0, late = 0.0;
    const double error = error_of(blocks[k].second, scene, [&] {
      if (++step == settled) early = allocated();
      if (step % settled == 0) late = allocated();
    });
    EXPECT_GE(step, 4 * blocks[k].second.steps);
    EXPECT_LE(late - early, page);
    return error;
  };
  sweep(axis);
}

// A bar in finite strain, stretched to twice its length and brought back in 100 000 steps: the
// midpoint rule takes the same way back, so it is what it was.
TEST(Axis, StepsOfALongStretch) {
  constexpr double young = 1e6;
  Axis axis{"steps of a bar's stretch to 2 and back",
            "stress E times the sum of the steps' strains there, and 0 back; place", 1e-6,
            "solver's tolerance of 1e-8 on a body of 5 by 10"};
  const std::vector<int> counts{100, 1000, 100000};
  for (const int steps : counts) {
    axis.samples.push_back(
        {fmt::format("{}", steps),
         box(0, 0, 0.5, 1, 0.1) + elastic(young, 0.0) + on_rollers +
             "[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
             "direction = [0.0, 1.0]\nwidth = 0.5\n"
             "[solver]\ntolerance = 1e-8\nmax_evaluations_per_step = 5000\n" +
             fmt::format("[[stage]]\nname = \"there\"\nto = 1.0\nsteps = {0}\n"
                         "[[stage]]\nname = \"back\"\nto = 0.0\nsteps = {0}\n",
                         steps / 2)});
  }
  axis.course = [&counts](const verification::TestScene& scene, std::size_t k) {
    // A step's strain is its change over the length in its middle; ln 2 of many steps.
    const int steps = counts[k] / 2;
    double strain = 0.0, error = 0.0;
    for (int i = 0; i < steps; ++i) strain += 2.0 / (2.0 * (steps + i) + 1.0);
    double exact = young * strain;
    run_stages(scene, [&](const auto&, const model::State<2>& state) {
      error = std::max(error, (state.stress.row(1).array() - exact).abs().maxCoeff() / young);
      if (exact == 0.0) error = std::max(error, state.displacement.cwiseAbs().maxCoeff());
      exact = 0.0;
    });
    return error;
  };
  sweep(axis);
}

}  // namespace
}  // namespace extremes
