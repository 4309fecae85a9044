#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "wiring/scene_reader.hpp"
#include "wiring/stepper.hpp"

namespace verification {

using Settings = std::vector<std::string>;

inline wiring::Scene checked(const wiring::SceneReading& reading) {
  for (const auto& problem : reading.errors) ADD_FAILURE() << problem.text();
  if (!reading.scene) throw std::runtime_error("the scene of this test is refused");
  return *reading.scene;
}

/// A scene of share/scenes, with settings as --set takes them.
inline wiring::Scene shipped_scene(const std::string& name, const Settings& settings = {}) {
  return checked(wiring::read_scene(std::filesystem::path(FPM_SCENES) / name, settings));
}

inline wiring::Scene scene_of(const std::string& text, const Settings& settings = {}) {
  return checked(wiring::parse_scene(text, "test scene", settings));
}

/// A scene with its model, state and stepper, which refer to one another.
template <int Dim>
struct Run {
  explicit Run(const wiring::Scene& s)
      : scene(s),
        model(wiring::build_model<Dim>(scene)),
        state(wiring::initial_state(model, scene)),
        stepper(scene, model, state) {}
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// Advances until the load parameter reaches `load`; fails the test if a step does not converge.
  std::vector<wiring::StepRecord> advance_to(double load) {
    std::vector<wiring::StepRecord> records;
    while (state.programme.load < load * (1.0 - 1e-12)) {
      const wiring::StepResult result = stepper.advance();
      if (result.outcome != wiring::StepOutcome::converged) {
        ADD_FAILURE() << "stopped at load " << state.programme.load << ": " << result.reason;
        break;
      }
      records.push_back(result.record);
    }
    return records;
  }
  std::vector<wiring::StepRecord> complete() { return advance_to(1.0); }

  /// The particle nearest to a point of the initial configuration.
  Eigen::Index nearest(const fpm::Vector<Dim>& point) const {
    Eigen::Index best = 0;
    (model.particles.position.rowwise() - point.transpose())
        .rowwise()
        .squaredNorm()
        .minCoeff(&best);
    return best;
  }

  wiring::Scene scene;
  wiring::Model<Dim> model;
  wiring::State<Dim> state;
  wiring::LoadStepper<Dim> stepper;
};

}  // namespace verification
