#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "bodies.hpp"
#include "equilibrium/equilibrium.hpp"
#include "equilibrium/two_level_preconditioner.hpp"
#include "model/build.hpp"
#include "model/model.hpp"
#include "stepping/stepper.hpp"

namespace benchmarks {

/// Advances a state by up to `steps` steps of its programme.
/// @throws std::runtime_error with the solver's reason if one does not converge
template <int Dim>
model::State<Dim> settled_state(const scene::Scene& scene, const model::Model<Dim>& model,
                                int steps) {
  model::State<Dim> state = model::initial_state(model);
  stepping::LoadStepper<Dim> stepper(scene, model, state);
  for (int k = 0; k < steps && !stepper.finished(); ++k) {
    const stepping::StepResult result = stepper.advance();
    if (result.outcome != stepping::StepOutcome::converged) throw std::runtime_error(result.reason);
  }
  return state;
}

/// A body in the midst of its programme, with everything a solver asks of it in one step: an
/// increment like the last one (so the same particles yield) and a direction without structure.
template <int Dim>
struct Prepared {
  Prepared(const Body& body, int settle_steps)
      : scene(scene_of(body)),
        model(model::build_model<Dim>(*scene)),
        state(settled_state(*scene, model, settle_steps)),
        equilibrium(model, state),
        preconditioner(model, *equilibrium.initial_rows(), coarse_spacing_of(*scene)),
        increment(Eigen::Map<const Eigen::VectorXd>(state.increment.data(), model.unknowns())),
        direction(model.unknowns()),
        result(model.unknowns()) {
    const auto& programme = state.programme;
    equilibrium.begin_step(std::min(1.0, programme.load + programme.last_increment));
    std::uint64_t random = 1;
    for (Eigen::Index k = 0; k < direction.size(); ++k) {
      random = random * 6364136223846793005ULL + 1442695040888963407ULL;
      const double uniform = static_cast<double>(random >> 11U) * 0x1.0p-53;
      const bool given = model.prescribed[static_cast<std::size_t>(k)] != 0;
      direction[k] = given ? 0.0 : model.spacing * (uniform - 0.5);
    }
  }
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  std::shared_ptr<const scene::Scene> scene;
  model::Model<Dim> model;
  model::State<Dim> state;
  equilibrium::Equilibrium<Dim> equilibrium;
  equilibrium::TwoLevelPreconditioner<Dim> preconditioner;
  Eigen::VectorXd increment;
  Eigen::VectorXd direction;
  Eigen::VectorXd result;
};

}  // namespace benchmarks
