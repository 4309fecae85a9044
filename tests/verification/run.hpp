#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "model/build.hpp"
#include "stepping/stepper.hpp"
#include "test_scene.hpp"

namespace verification {

/// A scene with its model, state and stepper, which refer to one another.
template <int Dim>
struct Run {
  explicit Run(const TestScene& s)
      : scene(s),
        model(model::build_model<Dim>(scene)),
        state(model::initial_state(model)),
        stepper(scene, model, state) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Advances until the load parameter reaches `load`; fails the test if a step does not converge.
  std::vector<stepping::StepRecord> advance_to(double load) {
    std::vector<stepping::StepRecord> records;
    while (state.programme.load < load * (1.0 - 1e-12)) {
      const stepping::StepResult result = stepper.advance();
      if (result.outcome != stepping::StepOutcome::converged) {
        ADD_FAILURE() << "stopped at load " << state.programme.load << ": " << result.reason;
        break;
      }
      records.push_back(result.record);
    }
    return records;
  }
  std::vector<stepping::StepRecord> complete() { return advance_to(1.0); }

  /// The particle nearest to a point of the initial configuration.
  Eigen::Index nearest(const fpm::Vector<Dim>& point) const {
    Eigen::Index best = 0;
    (model.particles.position.rowwise() - point.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&best);
    return best;
  }

  TestScene scene;
  model::Model<Dim> model;
  model::State<Dim> state;
  stepping::LoadStepper<Dim> stepper;
};

}  // namespace verification
