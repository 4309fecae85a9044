#pragma once

#include <vector>

#include "fpm/hourglass.hpp"
#include "fpm/moment_operator.hpp"
#include "fpm/viscosity.hpp"
#include "jfnk/residual.hpp"
#include "wiring/local_response.hpp"
#include "wiring/model.hpp"
#include "wiring/state.hpp"

namespace wiring {

/// Why and where the last evaluation was not possible.
struct EvaluationFailure {
  fpm::Index particle = -1;  // the lowest index whose motion is inverted or not finite
};

/// What a converged step leaves for the records.
struct StepForces {
  double reaction = 0.0;        // [N/m or N] along the measured direction, positive against it
  double hourglass_work = 0.0;  // [J/m or J] of this step
  double external_work = 0.0;   // [J/m or J] of this step, by reactions and loads
  Eigen::Index plastic = 0;     // particles that yielded in this step
  double max_plastic_strain = 0.0;
};

template <int Dim>
class Equilibrium;

/// The loops over particles of one local law (kinematics and integration), chosen once per run.
/// Each returns the lowest index of a particle that could not be evaluated, or -1.
template <int Dim>
struct LawLoops {
  fpm::Index (*respond)(Equilibrium<Dim>&);    // field -> generalised stresses
  fpm::Index (*linearise)(Equilibrium<Dim>&);  // field -> tangents
  fpm::Index (*apply)(Equilibrium<Dim>&);      // field, tangents -> generalised stress changes
  fpm::Index (*commit)(Equilibrium<Dim>&);     // field -> end-of-step state
};

/// The loops of a law; instantiated law by law in equilibrium_loops_*.cpp.
template <int Dim, class Law>
LawLoops<Dim> law_loops();

/// Equilibrium of one step as a residual functor: r(du) = f_int + f_hourglass - f_ext, zeroed at
/// prescribed unknowns. The unknown is the increment of displacement of the step, prescribed
/// entries included (the caller sets them; the solver sees a zero residual there).
///
/// All evaluations start from the converged state, never from an earlier trial; the state changes
/// in `commit` alone. No allocation between `begin_step` and `commit`.
template <int Dim>
class Equilibrium {
 public:
  Equilibrium(const Model<Dim>& model, State<Dim>& state);
  Equilibrium(const Equilibrium&) = delete;
  Equilibrium& operator=(const Equilibrium&) = delete;

  /// Rebuilds the operator from the state's rows; call after a re-search.
  void rebuild_operator();

  /// Prepares a step that ends at load parameter `load`.
  void begin_step(double load);

  // The residual in the sense of libjfnk.
  jfnk::Evaluation operator()(const Eigen::VectorXd& increment, Eigen::VectorXd& residual);
  bool linearise(const Eigen::VectorXd& increment);
  void apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& jv);
  /// max(|r_prescribed|, |f_ext|) of the latest evaluation: what a residual is small against.
  double reference_norm() const { return reference_norm_; }

  /// Takes the increment into the state. Call right after an evaluation that converged at it.
  StepForces commit(const Eigen::VectorXd& increment);

  /// Full residual of the latest evaluation, reactions included.
  const Eigen::VectorXd& unmasked_residual() const { return unmasked_; }
  const EvaluationFailure& failure() const { return failure_; }
  const fpm::MomentOperator<Dim>& moment_operator() const { return operator_; }
  /// Memory of the operator and all work arrays [bytes].
  std::size_t bytes() const;

 private:
  template <int D, class Law>
  friend struct LoopsOf;

  LawLoops<Dim> choose_loops() const;
  void remember_pairs(Eigen::Index a, const Eigen::VectorXd& position_moments);
  void assemble(const double* field, double* force);
  void add_boundary_terms(const Eigen::VectorXd& increment);
  void add_boundary_actions(const Eigen::VectorXd& v, Eigen::VectorXd& jv);
  ParticleStart<Dim> start_of(Eigen::Index a) const;
  fpm::PairRow<Dim> pair_row(Eigen::Index a) const;
  double hourglass_work(const Eigen::VectorXd& increment) const;

  const Model<Dim>& model_;
  State<Dim>& state_;
  fpm::MomentOperator<Dim> operator_;
  fpm::Field<Dim> potential_;  // of the consistency correction, kept for rebuilds
  fpm::PairViscosity<Dim> viscosity_;
  LawLoops<Dim> loops_;

  // Constant in a step.
  double load_ = 0.0;
  Eigen::VectorXd external_;
  fpm::Field<Dim> start_position_;
  Eigen::VectorXd position_;                                  // the same, extended to the ghosts
  Eigen::Matrix<double, 6, Eigen::Dynamic> second_gradient_;  // H_a(n), with sub-points
  Eigen::Matrix<double, Dim, Eigen::Dynamic> memory_first_;
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> memory_second_;
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> pair_gradient_;  // of the motion, since Xref
  Eigen::VectorXd pair_stiffness_;

  // Work arrays of an evaluation.
  Eigen::VectorXd extended_;
  Eigen::VectorXd stress_;
  Eigen::VectorXd force_;
  Eigen::VectorXd own_force_;
  Eigen::VectorXd unmasked_;
  Eigen::VectorXd tangent_;  // of all particles, after linearise
  Eigen::Matrix<double, Dim * Dim * Dim * Dim, Eigen::Dynamic> rotation_tangent_;
  Eigen::VectorXd base_increment_;            // of the latest linearise, where a term needs it
  fpm::Field<Dim * Dim> inverse_transposed_;  // F^-T of each row, with the paper's viscosity
  Eigen::VectorXd volume_;                    // V_a, with the paper's viscosity
  fpm::Field<Dim> displacement_;              // total, where a boundary term needs it
  double reference_norm_ = 0.0;
  EvaluationFailure failure_;
};

// Inline for the loops over particles.
template <int Dim>
fpm::PairRow<Dim> Equilibrium<Dim>::pair_row(Eigen::Index a) const {
  const auto row = static_cast<fpm::Index>(a);
  fpm::PairRow<Dim> pair;
  pair.first_moment = operator_.first_moment(row);
  pair.second_moment = operator_.second_moment(row);
  pair.memory_first = memory_first_.col(a);
  pair.memory_second = Eigen::Map<const fpm::Tensor<Dim>>(memory_second_.col(a).data());
  for (int i = 0; i < Dim; ++i) pair.position[i] = position_[i * operator_.stride() + a];
  pair.gradient = Eigen::Map<const fpm::Tensor<Dim>>(pair_gradient_.col(a).data());
  return pair;
}

template <int Dim>
ParticleStart<Dim> Equilibrium<Dim>::start_of(Eigen::Index a) const {
  ParticleStart<Dim> start;
  if (model_.layout.finite) {
    start.gradient = Eigen::Map<const fpm::Tensor<Dim>>(state_.deformation_gradient.col(a).data());
  } else {
    start.gradient.setIdentity();
  }
  start.reference_volume = state_.rows.reference_volume()[a];
  start.point.stress = state_.stress.col(a);
  if (model_.layout.plastic) {
    start.point.plastic_strain = state_.plastic_strain[a];
    start.point.plastic_volume_strain = state_.plastic_volume_strain[a];
  }
  if constexpr (Dim == 2) {
    if (model_.layout.subpoints) {
      start.second_gradient = Eigen::Map<const fpm::SecondGradient>(second_gradient_.col(a).data());
      start.deviator = state_.subpoint_deviator.col(a).data();
    }
  }
  return start;
}

}  // namespace wiring
