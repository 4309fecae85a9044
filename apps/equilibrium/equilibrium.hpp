#pragma once

#include <optional>
#include <vector>

#include "equilibrium/initial_balance.hpp"
#include "equilibrium/initial_rows.hpp"
#include "equilibrium/interface_forces.hpp"
#include "equilibrium/law_loops.hpp"
#include "equilibrium/share_out.hpp"
#include "fpm/moment_operator.hpp"
#include "fpm/viscosity.hpp"
#include "jfnk/residual.hpp"
#include "model/memory.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace equilibrium {

/// Why and where the last evaluation was not possible.
struct EvaluationFailure {
  // The lowest index whose motion is inverted or not finite, or next to such a point of a load.
  fpm::Index particle = -1;
  bool plate = false;  // no motion of a free plate is in balance with its load

  bool any() const { return particle >= 0 || plate; }
};

/// What a converged step leaves for the records.
struct StepForces {
  double reaction = 0.0;         // [N/m or N] along the measured direction, positive against it; of
                                 // a loaded plate its load
  double hourglass_work = 0.0;   // [J/m or J] of this step
  double external_work = 0.0;    // [J/m or J] of this step, by reactions and loads
  double growing_work = 0.0;     // [J/m or J] of the loads that grow, at a load parameter of one;
                                 // 0 if forces that follow or plates may belong to them
  double unbalanced_work = 0.0;  // [J/m or J] that balance lacks on the step's motion
  Eigen::Index plastic = 0;      // particles that yielded in this step
  double max_plastic_strain = 0.0;
  double settlement = 0.0;  // [m] of a loaded plate, along its load, since the run began
};

/// Equilibrium of one step as a residual functor: r(du) = f_int + f_hourglass - f_ext, zeroed at
/// prescribed unknowns. The unknown is the increment of displacement of the step, prescribed
/// entries included (the caller sets them; the solver sees a zero residual there).
///
/// All evaluations start from the converged state, never from an earlier trial; the state changes
/// in `commit` alone. No allocation between `begin_step` and `commit`.
template <int Dim>
class Equilibrium {
 public:
  /// @param rest  what keeps the initial stress at rest, of ground that stages have changed since;
  ///   none: it is that of the model
  Equilibrium(const model::Model<Dim>& model, model::State<Dim>& state,
              std::optional<InitialBalance<Dim>> rest = std::nullopt);
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// Builds the operator from the state's rows.
  void rebuild_operator();
  /// The same after a re-search, in proportion to the rows that it changed.
  /// @param changed  those rows, ascending
  void follow_re_search(const std::vector<fpm::Index>& changed);

  /// Prepares a step that ends at load parameter `load`, when a share of what the stage's changes
  /// have left unbalanced has faded, and with strength divided by a factor.
  void begin_step(double load, double faded = 1.0, double reduction = 1.0);

  /// The forces that the converged state leaves unbalanced at a load parameter and a reduction:
  /// none, but where the ground has changed. None at prescribed unknowns.
  /// @return nothing if they cannot be had: `failure` says where
  [[nodiscard]] std::optional<fpm::Field<Dim>> unbalanced(double load, double reduction);

  /// Takes what is borne where the state is into its reactions and the tractions of its faces.
  /// @return the reaction that is reported; nothing if it cannot be had
  [[nodiscard]] std::optional<double> reactions_at_rest(double load, double reduction);

  const InitialBalance<Dim>& balance() const { return balance_; }

  /// Whether the residual is linear in the increment, and its tangent that of an energy.
  [[nodiscard]] bool is_linear() const;

  InitialRows<Dim> initial_rows() const { return {model_, state_}; }
  /// On the initial rows, with the consistency correction.
  fpm::MomentOperator<Dim> initial_operator() const;

  // The residual in the sense of libjfnk.
  jfnk::Evaluation operator()(const Eigen::VectorXd& increment, Eigen::VectorXd& residual);
  bool linearise(const Eigen::VectorXd& increment);
  void apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& jv);

  /// Residual and linearisation at an increment, the planes of images being where the step begins.
  /// @returns whether both could be had
  bool linearise_before_motion(const Eigen::VectorXd& increment, Eigen::VectorXd& residual);
  /// Action of the Jacobian on what is prescribed for the step: entries of `prescribed`, and the
  /// motion of the planes of images.
  void apply_motion(const Eigen::VectorXd& prescribed, Eigen::VectorXd& jv);
  /// max(|r_prescribed|, |f_ext|) of the latest evaluation, loads that follow the boundary
  /// included: what a residual is small against.
  double reference_norm() const { return reference_norm_; }

  /// What libjfnk does with vectors, on all threads; see `equilibrium::share_out`.
  void share_out(Eigen::Index n, Eigen::Index numbers, jfnk::BlockWork work) const {
    equilibrium::share_out(n, numbers, model_.size(), work);
  }

  /// Takes the increment into the state. Call right after an evaluation that converged at it.
  /// @throws std::logic_error naming a particle that cannot be evaluated there: the state is void
  StepForces commit(const Eigen::VectorXd& increment);

  /// Full residual of the latest evaluation, reactions included.
  const Eigen::VectorXd& unmasked_residual() const { return evaluation_.unmasked; }
  /// Dead loads of the step, what keeps the initial stress at rest among them.
  const Eigen::VectorXd& external_load() const { return step_.external; }
  const EvaluationFailure& failure() const { return failure_; }
  const fpm::MomentOperator<Dim>& moment_operator() const { return operator_; }
  /// Memory of the operator, the viscosity and all arrays [bytes].
  std::size_t bytes() const { return model::total(memory(false)); }
  /// The same part by part.
  /// @param to_come  with the tangents, which the first linearisation allocates
  std::vector<model::MemoryPart> memory(bool to_come) const;

 private:
  void pair_up();
  LoopData<Dim> loop_data();
  void reduce_strength(double factor);
  void add_to_images(const fpm::Field<Dim>& motion, Eigen::VectorXd& extended) const;
  void extend_increment(const Eigen::VectorXd& increment);
  double take_plane_reactions();
  void take_side_reactions();
  void take_reactions();
  [[nodiscard]] double reported_reaction() const;
  void take_shares_of_growing_loads(const Eigen::VectorXd& increment, StepForces& forces) const;
  void act(const Eigen::VectorXd& v, double load_change, Eigen::VectorXd& jv);
  void place_particles();
  void remember_pairs(Eigen::Index a, const Eigen::VectorXd& position_moments);
  void assemble(const double* field, double* force, const double* load, double* copy);
  [[nodiscard]] bool has_boundary_terms() const;
  void add_boundary_terms(const Eigen::VectorXd& increment);
  [[nodiscard]] fpm::Index nearest_particle(
      const Eigen::Matrix<double, 1, Dim>& reference_place) const;
  void add_boundary_actions(const Eigen::VectorXd& v, double load_change, Eigen::VectorXd& jv);

  const model::Model<Dim>& model_;
  model::State<Dim>& state_;
  std::vector<Eigen::Index> given_;  // the prescribed unknowns
  fpm::MomentOperator<Dim> operator_;
  fpm::ConsistencyCorrection<Dim> correction_;  // of the first rows, kept for rebuilds
  InitialBalance<Dim> balance_;                 // of the initial stress, if there is one
  fpm::PairViscosity<Dim> viscosity_;
  std::vector<constitutive::Material> laws_;  // where strength is divided; else the model's
  double reduction_ = 1.0;                    // of theirs
  LawLoops<Dim> loops_;
  InterfaceForces<Dim> interfaces_;
  StepArrays<Dim> step_;
  EvaluationArrays<Dim> evaluation_;
  TangentArrays tangents_;
  std::vector<fpm::Vector<Dim>> plane_force_;  // by which each plane holds the body
  double rigid_load_ = 0.0;                    // load parameter to which rigid bodies have moved
  double external_norm_ = 0.0;                 // of the dead loads of the step
  double reference_norm_ = 0.0;
  EvaluationFailure failure_;
};

}  // namespace equilibrium
