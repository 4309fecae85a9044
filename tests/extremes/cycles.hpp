#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "block.hpp"
#include "staged_run.hpp"
#include "sweep.hpp"

namespace extremes {

/// A block of Tresca's clay between smooth plates, small strain, that goes there and back: its
/// stress is 2 c at most and E / (1 - nu^2) times the strain in between, whatever came before.
struct CycledBlock {
  std::vector<double> places;  // where it goes one after the other, over the strain at yield
  int steps = 10;              // on the way to each

  static constexpr double cohesion = 1e3, young = 1e6, poisson = 0.3;
  static constexpr double strength = 2.0 * cohesion;
  static constexpr double at_yield = strength * (1.0 - poisson * poisson) / young;

  [[nodiscard]] std::string scene() const {
    std::string text =
        box(0, 0, 0.5, 1, 0.1) + small_strain +
        fmt::format(
            "[[material]]\nname = \"clay\"\nmodel = \"mohr_coulomb\"\nyoungs_modulus = {}\n"
            "poissons_ratio = {}\ncohesion = {}\nfriction_angle = 0\ndilation_angle = 0\n",
            young, poisson, cohesion) +
        on_rollers +
        "[drive]\nkind = \"displacement\"\nside = \"top\"\nlateral = \"free\"\n"
        "direction = [0.0, -1.0]\nwidth = 0.5\n"
        "[solver]\ntolerance = 1e-8\nmax_evaluations_per_step = 5000\n";
    for (std::size_t k = 0; k < places.size(); ++k) {
      text += fmt::format("[[stage]]\nname = \"{}\"\nto = {}\nsteps = {}\n", k,
                          places[k] * at_yield, steps);
    }
    return text;
  }
};

/// The stress of the block over its strength, compression positive.
class IdealBlock {
 public:
  void go_to(double strain_over_that_at_yield) {
    stress_ = std::clamp(stress_ + strain_over_that_at_yield - strain_, -1.0, 1.0);
    strain_ = strain_over_that_at_yield;
  }
  [[nodiscard]] double stress() const { return stress_; }

 private:
  double stress_ = 0.0, strain_ = 0.0;
};

/// Runs all stages of a scene; `look` sees the run at the end of each.
/// @throws std::runtime_error with the reason if a step does not converge
inline void run_stages(
    const verification::TestScene& scene,
    const std::function<void(const model::Model<2>&, const model::State<2>&)>& look,
    const std::function<void()>& after_step = {}) {
  stepping::StagedModel<2> stages(scene);
  model::State<2> state = stages.initial_state();
  for (;;) {
    const auto stepper = stages.stepper(state);
    if (!stepper->begin_stage()) throw std::runtime_error("a stage does not begin");
    while (!stepper->finished()) {
      const stepping::StepResult result = stepper->advance();
      if (result.outcome != stepping::StepOutcome::converged) {
        throw std::runtime_error("run ends: " + result.reason);
      }
      if (after_step) after_step();
    }
    look(stages.model(), state);
    if (stages.is_last()) return;
    stages.go_on(state);
  }
}

/// The largest error of the block's stress at the ends of its ways, over its strength.
inline double error_of(const CycledBlock& block, const verification::TestScene& scene,
                       const std::function<void()>& after_step = {}) {
  IdealBlock ideal;
  std::size_t k = 0;
  double error = 0.0;
  run_stages(
      scene,
      [&](const auto&, const model::State<2>& state) {
        ideal.go_to(block.places[k++]);
        const double exact = -ideal.stress() * CycledBlock::strength;
        error = std::max(error, (state.stress.row(1).array() - exact).abs().maxCoeff());
      },
      after_step);
  return error / CycledBlock::strength;
}

/// An axis of such blocks.
inline Axis of_cycled(const std::string& name, const std::string& problem, double tolerance,
                      const std::string& source,
                      const std::vector<std::pair<std::string, CycledBlock>>& blocks) {
  Axis axis{name, problem, tolerance, source};
  for (const auto& [value, block] : blocks) axis.samples.push_back({value, block.scene()});
  axis.course = [blocks](const verification::TestScene& scene, std::size_t k) {
    return error_of(blocks[k].second, scene);
  };
  return axis;
}

}  // namespace extremes
