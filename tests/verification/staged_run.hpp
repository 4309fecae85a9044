#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "stepping/staged_model.hpp"
#include "test_scene.hpp"

namespace verification {

/// A run of all its stages, and the records of each.
template <int Dim>
struct StagedRunIn {
  explicit StagedRunIn(const TestScene& s)
      : scene(s), stages(scene), state(stages.initial_state()) {}

  /// Runs the stage at hand; false if a step does not converge.
  bool complete_stage() {
    const auto stepper = stages.stepper(state);
    EXPECT_TRUE(stepper->begin_stage());
    auto& these = records.emplace_back();
    while (!stepper->finished()) {
      const stepping::StepResult result = stepper->advance();
      if (result.outcome != stepping::StepOutcome::converged) return false;
      these.push_back(result.record);
    }
    return true;
  }
  void complete() {
    for (;;) {
      ASSERT_TRUE(complete_stage()) << "in stage " << records.size();
      if (stages.is_last()) return;
      stages.go_on(state);
    }
  }

  TestScene scene;
  stepping::StagedModel<Dim> stages;
  model::State<Dim> state;
  std::vector<std::vector<stepping::StepRecord>> records;
};
using StagedRun = StagedRunIn<2>;

}  // namespace verification
