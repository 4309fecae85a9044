// The beginning and the end of a step: what stays the same in it, and what it leaves.
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "constitutive/strength_reduction.hpp"
#include "equilibrium/equilibrium.hpp"
#include "equilibrium/hourglass_work.hpp"
#include "fpm/hourglass.hpp"
#include "fpm/threads.hpp"

namespace equilibrium {

template <int Dim>
void Equilibrium<Dim>::reduce_strength(double factor) {
  if (factor == reduction_) return;
  for (const model::ReducedLaw& reduced : model_.reduced_laws) {
    laws_[reduced.law] =
        constitutive::make_material(constitutive::with_strength_over(reduced.parameters, factor));
  }
  reduction_ = factor;
}

template <int Dim>
void Equilibrium<Dim>::begin_step(double load, double faded, double reduction) {
  step_.load = rigid_load_ = load;
  reduce_strength(reduction);
  interfaces_.begin_step(state_, reduction);
  step_.external = model_.constant_load + load * model_.scaled_load;
  if (balance_.load.size() > 0) step_.external += balance_.load;
  if (state_.unbalanced.size() > 0 && faded < 1.0) {
    step_.external += (1.0 - faded) * Eigen::Map<const Eigen::VectorXd>(state_.unbalanced.data(),
                                                                        state_.unbalanced.size());
  }
  external_norm_ = step_.external.norm();
  step_.start_position = model_.particles.position + state_.displacement;
  place_particles();
  if (!model_.plane_drive.empty()) {
    const double start = state_.programme.load;
    const fpm::Field<Dim> motion = model_.ghosts.of_motion(model_.plane_drive);
    add_to_images(start * motion, step_.position);
    if (!model_.plane_held.empty()) {
      add_to_images(model_.ghosts.of_motion(model_.plane_held), step_.position);
    }
    step_.image_motion = (load - start) * motion;
  }
  if (!model_.channels.pair && !model_.channels.second) return;

  const int m = operator_.channel_count();
  const int second_moment = Dim * model_.channels.second_gradient(Dim);
  fpm::for_each_block(operator_.block_count(), [&](fpm::Index block) {
    std::array<double, fpm::most_channels<Dim> * Dim * fpm::MomentOperator<Dim>::block_stride>
        moments;
    Eigen::VectorXd row(m * Dim);
    operator_.gather(block, step_.position.data(), moments.data());
    for (fpm::Index r = 0; r < operator_.block_size(block); ++r) {
      const Eigen::Index a = operator_.block_first(block) + r;
      for (int e = 0; e < m * Dim; ++e) {
        row[e] = moments[static_cast<std::size_t>(e * fpm::MomentOperator<Dim>::block_stride + r)];
      }
      if (model_.channels.second) {
        step_.second_gradient.col(a) =
            row.template segment<StepArrays<Dim>::second_size>(second_moment);
      }
      if (model_.channels.pair) remember_pairs(a, row);
    }
  });
}

// What is summed over pairs are differences of these positions, whose round-off is that of their
// size: measured from a point next to the body it does not depend on where the origin is.
template <int Dim>
void Equilibrium<Dim>::place_particles() {
  operator_.extend_positions(model_.particles.position.data(), step_.position.data());
  operator_.extend(state_.displacement.data(), evaluation_.extended.data());
  const fpm::Vector<Dim> origin = model_.nearby_origin();
  const Eigen::Index nodes = model_.size() + model_.ghosts.size();
  for (int i = 0; i < Dim; ++i) {
    step_.position.segment(i * operator_.stride(), nodes).array() -= origin[i];
  }
  step_.position += evaluation_.extended;
}

template <int Dim>
void Equilibrium<Dim>::remember_pairs(Eigen::Index a, const Eigen::VectorXd& position_moments) {
  using Tensor = fpm::Tensor<Dim>;
  const auto row = static_cast<fpm::Index>(a);
  const Eigen::Map<const Tensor> gradient(position_moments.data());
  const Eigen::Map<const fpm::Vector<Dim>> first(position_moments.data() +
                                                 Dim * fpm::Channels::kappa(Dim));
  const Eigen::Map<const Tensor> second(position_moments.data() +
                                        Dim * fpm::Channels::kappa_x(Dim));
  step_.pair_gradient.col(a) = position_moments.head(Dim * Dim);
  step_.memory_first.col(a) = first - gradient * operator_.first_moment(row);
  Eigen::Map<Tensor>(step_.memory_second.col(a).data()) =
      second - gradient * operator_.second_moment(row);

  const double youngs_modulus = model_.youngs_modulus_of(a);
  double modulus = youngs_modulus;
  if (model_.layout.incremental && model_.layout.plastic) {
    const double sqrt_j2 =
        std::sqrt(constitutive::j2(constitutive::StressVector<Dim>(state_.stress.col(a))));
    modulus = fpm::pair_modulus(youngs_modulus, model_.pair_control.modulus_factor, sqrt_j2,
                                state_.plastic_increment[a]);
  }
  step_.pair_stiffness[a] =
      model_.pair_control.stiffness_ratio * modulus * state_.rows.reference_volume()[a];
}

template <int Dim>
std::optional<fpm::Field<Dim>> Equilibrium<Dim>::unbalanced(double load, double reduction) {
  begin_step(load, 1.0, reduction);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(model_.unknowns());
  Eigen::VectorXd residual(nothing.size());
  if ((*this)(nothing, residual) != jfnk::Evaluation::ok) return std::nullopt;
  return Eigen::Map<const fpm::Field<Dim>>(residual.data(), model_.size(), Dim);
}

// Which of two opposite sides bears what, of particles that both hold.
template <int Dim>
void Equilibrium<Dim>::take_side_reactions() {
  if (!model_.layout.thin) return;
  state_.side_reaction.setZero();
  add_side_reactions(model_, evaluation_.force.data(), operator_.stride(), state_.side_reaction);
  if (balance_.side_reaction.cols() > 0) state_.side_reaction += balance_.side_reaction;
}

// Along the measured direction, positive against it; of a loaded plate its load.
template <int Dim>
double Equilibrium<Dim>::reported_reaction() const {
  double reaction = model_.measure.dot(evaluation_.unmasked);
  for (std::size_t p = 0; p < model_.plane_drive.size(); ++p) {
    reaction += model_.plane_measure[p].dot(plane_force_[p]);
  }
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    const model::Interface<Dim>& interface = model_.interfaces[i];
    reaction += interface.measure.dot(interfaces_.rigid_force()[i]);
    if (interface.plate && interface.plate->reported) {
      reaction += step_.load * interface.plate->force.norm() + interface.plate->held_force.norm();
    }
  }
  return reaction;
}

template <int Dim>
void Equilibrium<Dim>::take_reactions() {
  state_.reaction.setZero();
  for (const Eigen::Index k : given_) state_.reaction.data()[k] = evaluation_.unmasked[k];
  if (evaluation_.plane_reaction.rows() > 0) state_.reaction += evaluation_.plane_reaction;
  if (balance_.reaction.rows() > 0) state_.reaction += balance_.reaction;
  take_side_reactions();
}

template <int Dim>
std::optional<double> Equilibrium<Dim>::reactions_at_rest(double load, double reduction) {
  begin_step(load, 0.0, reduction);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(model_.unknowns());
  Eigen::VectorXd residual(nothing.size());
  if ((*this)(nothing, residual) != jfnk::Evaluation::ok) return std::nullopt;
  take_reactions();
  interfaces_.take_tractions(state_);
  return reported_reaction();
}

// At collapse soil, control and what is out of balance share the power of the loads.
template <int Dim>
void Equilibrium<Dim>::take_shares_of_growing_loads(const Eigen::VectorXd& increment,
                                                    StepForces& forces) const {
  const bool has_plates = std::ranges::any_of(
      model_.interfaces, [](const model::Interface<Dim>& i) { return i.plate.has_value(); });
  if (!model_.following_pressures.empty() || has_plates) return;
  forces.growing_work = model_.scaled_load.dot(increment);
  forces.unbalanced_work = -evaluation_.unmasked.dot(increment);
  for (const Eigen::Index k : given_) {
    forces.unbalanced_work += evaluation_.unmasked[k] * increment[k];
  }
}

template <int Dim>
StepForces Equilibrium<Dim>::commit(const Eigen::VectorXd& increment) {
  StepForces forces;
  forces.reaction = reported_reaction();
  for (std::size_t p = 0; p < model_.plane_drive.size(); ++p) {
    forces.external_work +=
        (step_.load - state_.programme.load) * model_.plane_drive[p].dot(plane_force_[p]);
  }
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    forces.external_work += (step_.load - state_.programme.load) *
                            model_.interfaces[i].drive.dot(interfaces_.rigid_force()[i]);
  }
  forces.external_work += interfaces_.work_of_plates(step_.load);
  forces.settlement = interfaces_.settlement();
  extend_increment(increment);
  forces.hourglass_work = hourglass_work(loop_data());
  take_shares_of_growing_loads(increment, forces);
  forces.external_work += step_.external.dot(increment);
  if (evaluation_.following.size() > 0) {
    forces.external_work += evaluation_.following.dot(increment);
  }
  for (const Eigen::Index k : given_) {
    forces.external_work += evaluation_.unmasked[k] * increment[k];
  }
  take_reactions();
  const LoopOutcome outcome = loops_.commit(loop_data());
  if (!outcome.ok()) {
    throw std::logic_error("commit at an increment at which particle " +
                           std::to_string(outcome.failed) + " cannot be evaluated");
  }
  state_.increment = Eigen::Map<const fpm::Field<Dim>>(increment.data(), model_.size(), Dim);
  state_.displacement += state_.increment;
  interfaces_.commit(state_);
  if (model_.layout.plastic) {
    forces.plastic = (state_.plastic_increment.array() > 0.0).count();
    forces.max_plastic_strain = state_.plastic_strain.maxCoeff();
  }
  return forces;
}

#define EQUILIBRIUM_STEP(Dim)                                                           \
  template void Equilibrium<Dim>::begin_step(double, double, double);                   \
  template std::optional<fpm::Field<Dim>> Equilibrium<Dim>::unbalanced(double, double); \
  template std::optional<double> Equilibrium<Dim>::reactions_at_rest(double, double);   \
  template StepForces Equilibrium<Dim>::commit(const Eigen::VectorXd&);
EQUILIBRIUM_STEP(2)
EQUILIBRIUM_STEP(3)

}  // namespace equilibrium
