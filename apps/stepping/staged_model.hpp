#pragma once

#include <memory>
#include <optional>

#include "equilibrium/initial_balance.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "scene/scene.hpp"
#include "stepping/stepper.hpp"

namespace stepping {

/// The model of a run's stage at hand, and of the next one when that begins. A run without stages
/// has one; stages in which only the drive goes on, there or back, share it.
template <int Dim>
class StagedModel {
 public:
  /// @param whole  must outlive it
  /// @param stage  the first at hand
  /// @throws DoesNotSettle
  explicit StagedModel(const scene::Scene& whole, std::size_t stage = 0);
  StagedModel(const StagedModel&) = delete;
  StagedModel& operator=(const StagedModel&) = delete;

  /// Of the stage at hand.
  [[nodiscard]] const scene::Scene& scene() const { return scene_; }
  [[nodiscard]] const model::Model<Dim>& model() const { return changed_ ? *changed_ : first_; }
  [[nodiscard]] bool is_last() const;

  /// The state of ground at rest, as the first stage finds it.
  [[nodiscard]] model::State<Dim> initial_state() const;
  /// A stepper of the stage at hand. What it refers to must stay: no next stage meanwhile.
  [[nodiscard]] std::unique_ptr<LoadStepper<Dim>> stepper(model::State<Dim>& state) const;
  /// Goes to the next stage, and takes the state there (carry_state); its stepper begins it.
  void go_on(model::State<Dim>& state);

 private:
  void build(std::size_t stage);
  void take_stress_at_rest();
  [[nodiscard]] std::optional<equilibrium::InitialBalance<Dim>> rest() const;

  const scene::Scene& whole_;
  scene::Scene scene_;
  model::Model<Dim> first_;  // before any change
  std::optional<model::Model<Dim>> changed_;
  equilibrium::InitialBalance<Dim> rest_;  // of the first, if the ground changes
};

}  // namespace stepping
