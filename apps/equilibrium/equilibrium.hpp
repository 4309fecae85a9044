#pragma once

#include <array>
#include <vector>

#include "equilibrium/lanes.hpp"
#include "equilibrium/local_response.hpp"
#include "fpm/hourglass.hpp"
#include "fpm/moment_operator.hpp"
#include "fpm/viscosity.hpp"
#include "jfnk/residual.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace equilibrium {

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
  Equilibrium(const model::Model<Dim>& model, model::State<Dim>& state);
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
  template <class Real>
  ParticleStart<Dim, Real> start_of(Eigen::Index a) const;
  template <class Real>
  fpm::PairRow<Dim, Real> pair_row(Eigen::Index a) const;
  double hourglass_work(const Eigen::VectorXd& increment) const;

  const model::Model<Dim>& model_;
  model::State<Dim>& state_;
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
  Eigen::VectorXd tangent_;  // of all particles, after linearise (TangentLayout)
  Eigen::VectorXd rotation_tangent_;
  Eigen::VectorXd base_increment_;            // of the latest linearise, where a term needs it
  fpm::Field<Dim * Dim> inverse_transposed_;  // F^-T of each row, with the paper's viscosity
  Eigen::VectorXd volume_;                    // V_a, with the paper's viscosity
  fpm::Field<Dim> displacement_;              // total, where a boundary term needs it
  double reference_norm_ = 0.0;
  EvaluationFailure failure_;
};

// Inline for the loops over particles: of particle `a`, and with Lanes of those behind it, too.
template <int Dim>
template <class Real>
fpm::PairRow<Dim, Real> Equilibrium<Dim>::pair_row(Eigen::Index a) const {
  fpm::PairRow<Dim, Real> pair;
  for (int i = 0; i < Dim; ++i) {
    pair.first_moment[i] = load<Real>(operator_.first_moments(i) + a);
    pair.position[i] = load<Real>(position_.data() + i * operator_.stride() + a);
  }
  load_columns<Dim * Dim>(operator_.second_moments() + a * Dim * Dim, pair.second_moment.data());
  load_columns<Dim>(memory_first_.col(a).data(), pair.memory_first.data());
  load_columns<Dim * Dim>(memory_second_.col(a).data(), pair.memory_second.data());
  load_columns<Dim * Dim>(pair_gradient_.col(a).data(), pair.gradient.data());
  return pair;
}

template <int Dim>
template <class Real>
ParticleStart<Dim, Real> Equilibrium<Dim>::start_of(Eigen::Index a) const {
  using State = model::State<Dim>;
  ParticleStart<Dim, Real> start;
  if (model_.layout.finite) {
    load_columns<Dim * Dim>(state_.deformation_gradient.col(a).data(), start.gradient.data());
  } else {
    start.gradient.setIdentity();
  }
  start.reference_volume = load<Real>(state_.rows.reference_volume().data() + a);
  load_columns<State::stress_rows>(state_.stress.col(a).data(), start.point.stress.data());
  if (model_.layout.plastic) {
    start.point.plastic_strain = load<Real>(state_.plastic_strain.data() + a);
    start.point.plastic_volume_strain = load<Real>(state_.plastic_volume_strain.data() + a);
  }
  if constexpr (Dim == 2) {
    if (model_.layout.subpoints) {
      load_columns<6>(second_gradient_.col(a).data(), start.second_gradient.data());
      std::array<Real, State::subpoint_rows> deviator;
      load_columns<State::subpoint_rows>(state_.subpoint_deviator.col(a).data(), deviator.data());
      for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
        start.deviator[k] =
            Eigen::Map<const constitutive::StressVector<2, Real>>(deviator.data() + 4 * k);
      }
    }
  }
  return start;
}

}  // namespace equilibrium
