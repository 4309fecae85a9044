// What fpm-run --check says of memory against what is allocated.
#include <gtest/gtest.h>
#include <malloc.h>

#include "model/state_file.hpp"
#include "run.hpp"

namespace verification {
namespace {

// What the table promises.
constexpr double tenth = 0.1;

/// Bytes that are allocated now; 0 where another allocator stands in for the C library's.
double allocated() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

struct Memory {
  double held = 0.0;      // by all that a run works with, as the allocator counts
  double told = 0.0;      // by its own account
  double foretold = 0.0;  // before the first step
};

Memory memory_after(int steps, const TestScene& scene) {
  const auto model = model::build_model<2>(scene);
  auto state = model::initial_state(model);
  const double before = allocated();
  if (before == 0.0) return {};
  const std::size_t of_state = model::bytes_of(state);
  stepping::LoadStepper<2> stepper(scene, model, state);
  Memory memory;
  memory.foretold = static_cast<double>(model::total(stepper.memory(true)));
  for (int step = 0; step < steps && !stepper.finished(); ++step) {
    EXPECT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged);
  }
  memory.held = allocated() - before;
  memory.told = static_cast<double>(stepper.bytes() + model::bytes_of(state) - of_state);
  return memory;
}

TEST(Memory, OfAPlasticRunIsForetoldWithinATenth) {
  const Memory memory = memory_after(
      12, shipped_scene("footing.toml", {"geometry.spacing=0.02", "re_search.enabled=false"}));
  if (memory.held == 0.0) GTEST_SKIP() << "another allocator";
  EXPECT_NEAR(memory.told, memory.held, tenth * memory.held);
  EXPECT_NEAR(memory.foretold, memory.held, tenth * memory.held);
}

TEST(Memory, OfAnElasticRunIsForetoldWithinATenth) {
  const Memory memory = memory_after(1, shipped_scene("beam.toml"));
  if (memory.held == 0.0) GTEST_SKIP() << "another allocator";
  EXPECT_NEAR(memory.told, memory.held, tenth * memory.held);
  EXPECT_NEAR(memory.foretold, memory.held, tenth * memory.held);
}

// Small strains and no plasticity: what the table of speed.md says a plane body wants at most.
TEST(Memory, OfAnElasticRunIsLessThanAKilobytePerParticle) {
  const auto scene = shipped_scene("beam.toml");
  const auto model = model::build_model<2>(scene);
  auto state = model::initial_state(model);
  stepping::LoadStepper<2> stepper(scene, model, state);
  ASSERT_EQ(stepper.advance().outcome, stepping::StepOutcome::converged);
  EXPECT_LE(stepper.bytes() + model::bytes_of(state),
            1000 * static_cast<std::size_t>(model.size()));
}

}  // namespace
}  // namespace verification
