#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "equilibrium/initial_balance.hpp"
#include "jfnk/solver.hpp"
#include "model/memory.hpp"
#include "model/model.hpp"
#include "model/state.hpp"
#include "record/curve.hpp"
#include "stepping/linear_solve.hpp"
#include "stepping/patience.hpp"

namespace scene {
struct Scene;
}

namespace equilibrium {
template <int Dim>
class Equilibrium;
template <int Dim>
class Preconditioner;
}  // namespace equilibrium

namespace stepping {

/// What one converged step did: its row of the curve, but for the wall time, which is the
/// recorder's, and what the curve does not show.
struct StepRecord : record::CurveRow {
  double max_displacement = 0.0;  // [m]
};

enum class StepOutcome {
  converged,          // the state holds the new step
  minimum_increment,  // cut back to the minimum without convergence; the state is the last good one
  hopeless,           // patience lost after a failed attempt; the state is the last good one
  stopped,            // the observer asked to stop; the state is the last good one
};

struct StepResult {
  StepOutcome outcome = StepOutcome::converged;
  StepRecord record;
  jfnk::Status status = jfnk::Status::converged;  // of the last attempt
  jfnk::Trouble trouble = jfnk::Trouble::none;    // of the last attempt
  std::string reason;                             // why the last attempt failed, in scene's words
  // Of the last attempt, if the stepper gave up:
  fpm::Index folded_particle = -1;  // could not be evaluated: inverted or not finite
  bool unbalanced_plate = false;    // a free plate found no motion in balance with its load
  Eigen::VectorXd attempt;          // [m] increment of the lowest residual met, or empty
  Eigen::VectorXd residual;         // [N/m or N] at it, 0 at prescribed unknowns, or empty
  int attempts = 0;                 // at steps, since the load was `patience_mark`
  double patience_mark = 0.0;
  std::optional<double> corrected_load;  // of the last converged step, if it has one
};

/// Advances a state through the load programme, one converged step at a time: predictor, solve,
/// cut-back, commit, re-search, next step size. Everything it remembers between steps is in the
/// state, so that a resumed run takes the same decisions.
template <int Dim>
class LoadStepper {
 public:
  /// Called after each nonlinear iteration; returning false stops the step.
  using Watch = std::function<bool(const jfnk::Iteration&)>;

  /// @param scene  of the stage at hand, if there are several (scene::scene_of_stage)
  /// @param rest  what keeps the initial stress at rest, of ground that stages have changed since
  LoadStepper(const scene::Scene& scene, const model::Model<Dim>& model, model::State<Dim>& state,
              std::optional<equilibrium::InitialBalance<Dim>> rest = std::nullopt);
  ~LoadStepper();
  LoadStepper(const LoadStepper&) = delete;
  LoadStepper& operator=(const LoadStepper&) = delete;

  /// Takes the state to the beginning of the scene's stage: the stepper begins anew, and what the
  /// stage's changes leave unbalanced is to fade.
  /// @return false if it cannot be evaluated: the ground is not what it was
  [[nodiscard]] bool begin_stage();

  /// What supports and walls bear of an initial stress before the first step, in the state; in the
  /// record what the wall that the drive moves does.
  [[nodiscard]] StepRecord at_rest();

  /// Whether the scene's stage is at its end.
  bool finished() const;
  /// Tries one step, with smaller increments as need be. The state is the new one if it converged,
  /// else as it was, the programme's step sizes included.
  StepResult advance(const Watch& watch = {});

  /// Re-searches, if the scene's rule asks for it, as each converged step does at its end.
  /// @return the rows rebuilt
  Eigen::Index re_search();

  /// Memory of all that it works with [bytes], as it is now.
  std::size_t bytes() const { return model::total(memory(false)); }
  /// The same part by part.
  /// @param to_come  as of a long run: with tangents and all secant pairs
  std::vector<model::MemoryPart> memory(bool to_come) const;

 private:
  StepResult attempt(const Watch& watch);
  [[nodiscard]] double load_at(double progress) const;
  void set_prescribed(double increment, Eigen::VectorXd& u) const;
  void foresee(double increment);
  bool predict_by_tangent(double increment, Eigen::VectorXd& u, StepRecord& record);
  bool solve(Eigen::VectorXd& u, const Watch& watch, StepResult& result);
  [[nodiscard]] bool solves_linearly() const;
  bool solve_linearly(double increment, const Watch& watch, StepResult& result);
  [[nodiscard]] bool hands_on_pairs() const;
  void forget_pairs();
  void keep_pairs(const StepRecord& record);
  StepResult& give_up(StepOutcome outcome, StepResult& result);
  void finish_step(double increment, StepRecord& record);
  void choose_next_increment(const StepRecord& record);

  const scene::Scene& scene_;
  const model::Model<Dim>& model_;
  model::State<Dim>& state_;
  double rounding_;  // [N/m or N] what it leaves of a residual that is zero
  std::unique_ptr<equilibrium::Equilibrium<Dim>> equilibrium_;
  std::unique_ptr<equilibrium::Preconditioner<Dim>> preconditioner_;
  bool use_preconditioner_ = true;
  jfnk::Solver solver_;
  LinearSolve<Dim> linear_solve_;
  double nominal_increment_ = 1.0;  // of the progress
  Patience patience_;
  Eigen::VectorXd increment_;
  std::optional<double> corrected_load_;  // load parameter of the last step
};

}  // namespace stepping
