#include "equilibrium/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "equilibrium/given_unknowns.hpp"
#include "equilibrium/local_response.hpp"
#include "equilibrium/tangent_layout.hpp"
#include "fpm/consistency.hpp"
#include "fpm/threads.hpp"
#include "model/penalty_targets.hpp"

namespace equilibrium {
namespace {

template <int Dim>
LawLoops<Dim> choose_loops(const model::StateLayout& layout) {
  if (layout.subpoints) {
    return layout.finite ? law_loops<Dim, MixedLaw<Dim, true>>()
                         : law_loops<Dim, MixedLaw<Dim, false>>();
  }
  return layout.finite ? law_loops<Dim, PlainLaw<Dim, true>>()
                       : law_loops<Dim, PlainLaw<Dim, false>>();
}

template <int Dim>
bool holds_planes(const model::Model<Dim>& model) {
  return std::ranges::any_of(model.ghosts.planes(),
                             [](const fpm::GhostPlane<Dim>& plane) { return !plane.symmetry; });
}

template <int Dim>
ArraySizes array_sizes(const model::Model<Dim>& model, const fpm::MomentOperator<Dim>& op) {
  const Eigen::Index n = model.size();
  const auto count = [n](bool needed) { return needed ? n : 0; };
  const bool viscosity = model.control == scene::HourglassControl::viscosity;
  ArraySizes sizes;
  sizes.particles = n;
  sizes.extended = op.stride();
  sizes.stress_entries = op.stress_count();
  sizes.pairs = count(model.channels.pair);
  sizes.subpoints = count(model.channels.second);
  sizes.viscosity = count(viscosity);
  sizes.moving_images = model.plane_drive.empty() ? 0 : model.ghosts.size();
  sizes.held = count(holds_planes(model));
  sizes.viscosity_finite = count(viscosity && model.layout.finite);
  sizes.following = count(!model.following_pressures.empty());
  sizes.tangent_entries = model.layout.subpoints
                              ? StressTangents<generalised_size<Dim, true>>::total(n)
                              : StressTangents<generalised_size<Dim, false>>::total(n);
  sizes.rotation_entries = RotationTangents<Dim>::total(count(model.layout.incremental));
  return sizes;
}

// A power of two about as large as the stiffest particle's modulus times volume, so that single
// precision has numbers about one whatever the scene's units.
template <int Dim>
double energy_unit(const model::Model<Dim>& model) {
  double largest = 0.0;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    largest = std::max(largest, model.youngs_modulus_of(a) * model.particles.volume[a]);
  }
  return std::exp2(std::round(std::log2(largest)));
}

}  // namespace

template <int Dim>
Equilibrium<Dim>::Equilibrium(const model::Model<Dim>& model, model::State<Dim>& state,
                              std::optional<InitialBalance<Dim>> rest)
    : model_(model),
      state_(state),
      given_(given_unknowns(model.prescribed)),
      laws_(model.reduced_laws.empty() ? std::vector<constitutive::Material>() : model.laws),
      loops_(choose_loops<Dim>(model.layout)),
      interfaces_(model) {
  if (model_.consistency) {
    // The correction belongs to the initial configuration, whatever was re-searched since.
    correction_ = fpm::consistency_correction(*initial_rows(), model_.ghosts, model_.area_vector);
  }
  rebuild_operator();
  if (rest) {
    balance_ = std::move(*rest);
  } else if (model_.initial_stress.size() > 0 && state_.programme.balanced != 0) {
    balance_ = balance_initial_stress(model_, initial_operator());
  }
  const ArraySizes sizes = array_sizes(model_, operator_);
  allocate(step_, sizes);
  allocate(evaluation_, sizes);
  if (sizes.viscosity > 0) evaluation_.volume = state_.rows.reference_volume();
}

template <int Dim>
fpm::MomentOperator<Dim> Equilibrium<Dim>::initial_operator() const {
  return {*initial_rows(), model_.ghosts, model_.channels, correction_};
}

template <int Dim>
LoopData<Dim> Equilibrium<Dim>::loop_data() {
  return {operator_, laws_.empty() ? model_.laws : laws_, model_.law, state_, step_, evaluation_,
          tangents_};
}

template <int Dim>
void Equilibrium<Dim>::rebuild_operator() {
  operator_ = fpm::MomentOperator<Dim>(state_.rows, model_.ghosts, model_.channels, correction_);
  pair_up();
}

template <int Dim>
void Equilibrium<Dim>::follow_re_search(const std::vector<fpm::Index>& rows) {
  operator_.update(state_.rows, rows, correction_);
  pair_up();
}

template <int Dim>
void Equilibrium<Dim>::pair_up() {
  if (model_.control != scene::HourglassControl::viscosity) return;
  Eigen::VectorXd modulus(model_.size());
  for (Eigen::Index a = 0; a < modulus.size(); ++a) {
    modulus[a] = model_.youngs_modulus_of(a);
  }
  viscosity_ = fpm::PairViscosity<Dim>(operator_, modulus, fpm::smoothing_lengths(state_.rows));
}

template <int Dim>
void Equilibrium<Dim>::add_to_images(const fpm::Field<Dim>& motion,
                                     Eigen::VectorXd& extended) const {
  for (int i = 0; i < Dim && motion.rows() > 0; ++i) {
    extended.segment(i * operator_.stride() + model_.size(), motion.rows()) += motion.col(i);
  }
}

template <int Dim>
void Equilibrium<Dim>::extend_increment(const Eigen::VectorXd& increment) {
  operator_.extend(increment.data(), evaluation_.extended.data());
  add_to_images(step_.image_motion, evaluation_.extended);
}

// Threads meet once for all of this.
template <int Dim>
void Equilibrium<Dim>::assemble(const double* field, double* force, const double* load,
                                double* copy) {
  operator_.scatter(evaluation_.stress.data(), field, step_.position.data(),
                    evaluation_.force.data());
  const Eigen::Index n = model_.size();
  const auto stride = operator_.stride();
  const double* const sum = evaluation_.force.data();
  const double* const own = model_.channels.pair ? evaluation_.own_force.data() : nullptr;
  constexpr Eigen::Index per_block = 512;
  fpm::for_each_row(n, per_block, [&](Eigen::Index a) {
    for (int i = 0; i < Dim; ++i) {
      const Eigen::Index k = i * n + a;
      double component = sum[i * stride + a];
      if (own != nullptr) component += own[k];
      if (load != nullptr) component -= load[k];
      force[k] = component;
      if (copy != nullptr) copy[k] = component;
    }
  });
}

template <int Dim>
jfnk::Evaluation Equilibrium<Dim>::operator()(const Eigen::VectorXd& increment,
                                              Eigen::VectorXd& residual) {
  extend_increment(increment);
  const LoopOutcome outcome = loops_.respond(loop_data());
  failure_ = {.particle = outcome.failed};
  if (!outcome.ok()) return jfnk::Evaluation::out_of_domain;
  const bool plain = !has_boundary_terms();
  assemble(evaluation_.extended.data(), evaluation_.unmasked.data(), step_.external.data(),
           plain ? residual.data() : nullptr);
  double reaction_square = take_plane_reactions();
  add_boundary_terms(increment);
  if (failure_.any()) return jfnk::Evaluation::out_of_domain;
  for (const fpm::Vector<Dim>& held : interfaces_.rigid_force()) {
    reaction_square += held.squaredNorm();
  }
  if (!plain) residual = evaluation_.unmasked;
  for (const Eigen::Index k : given_) {
    reaction_square += evaluation_.unmasked[k] * evaluation_.unmasked[k];
    residual[k] = 0.0;
  }
  const double loads = evaluation_.following.size() > 0
                           ? (step_.external + evaluation_.following).norm()
                           : external_norm_;
  reference_norm_ = std::max(std::sqrt(reaction_square), loads);
  return jfnk::Evaluation::ok;
}

// Returns the sum of their squares.
template <int Dim>
double Equilibrium<Dim>::take_plane_reactions() {
  if (evaluation_.plane_reaction.rows() == 0) return 0.0;
  const auto stride = operator_.stride();
  evaluation_.plane_reaction.setZero();
  const auto& planes = model_.ghosts.planes();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].symmetry) continue;
    model_.ghosts.add_reactions(p, evaluation_.force.data(), model_.size(), stride,
                                evaluation_.plane_reaction);
  }
  model_.ghosts.plane_forces(evaluation_.force.data(), model_.size(), stride, plane_force_);
  for (std::size_t p = 0; p < balance_.plane_force.size(); ++p) {
    plane_force_[p] += balance_.plane_force[p];
  }
  return evaluation_.plane_reaction.squaredNorm();
}

template <int Dim>
bool Equilibrium<Dim>::linearise_before_motion(const Eigen::VectorXd& increment,
                                               Eigen::VectorXd& residual) {
  fpm::Field<Dim> motion;
  motion.swap(step_.image_motion);
  rigid_load_ = state_.programme.load;
  const bool could = (*this)(increment, residual) == jfnk::Evaluation::ok && linearise(increment);
  rigid_load_ = step_.load;
  motion.swap(step_.image_motion);
  return could;
}

template <int Dim>
bool Equilibrium<Dim>::linearise(const Eigen::VectorXd& increment) {
  failure_ = {};
  extend_increment(increment);
  evaluation_.base_increment = increment;
  if (tangents_.stress.size() == 0) {
    allocate(tangents_, step_.sizes);
    tangents_.unit = energy_unit(model_);
  }
  if (!interfaces_.empty()) {
    evaluation_.displacement = state_.displacement + Eigen::Map<const fpm::Field<Dim>>(
                                                         increment.data(), model_.size(), Dim);
    if (!interfaces_.linearise(state_, evaluation_.displacement, rigid_load_)) {
      failure_.plate = true;
      return false;
    }
  }
  const LoopOutcome outcome = loops_.linearise(loop_data());
  failure_.particle = outcome.failed;
  return outcome.ok();
}

template <int Dim>
void Equilibrium<Dim>::apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& jv) {
  operator_.extend(v.data(), evaluation_.extended.data());
  act(v, 0.0, jv);
}

template <int Dim>
void Equilibrium<Dim>::apply_motion(const Eigen::VectorXd& prescribed, Eigen::VectorXd& jv) {
  extend_increment(prescribed);
  act(prescribed, step_.load - state_.programme.load, jv);
}

// Of the extended direction.
template <int Dim>
void Equilibrium<Dim>::act(const Eigen::VectorXd& v, double load_change, Eigen::VectorXd& jv) {
  loops_.apply(loop_data());
  assemble(evaluation_.extended.data(), jv.data(), nullptr, nullptr);
  add_boundary_actions(v, load_change, jv);
  for (const Eigen::Index k : given_) jv[k] = 0.0;
}

template <int Dim>
fpm::Index Equilibrium<Dim>::nearest_particle(
    const Eigen::Matrix<double, 1, Dim>& reference_place) const {
  Eigen::Index nearest = 0;
  (model_.particles.position.rowwise() - reference_place)
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  return static_cast<fpm::Index>(nearest);
}

template <int Dim>
bool Equilibrium<Dim>::has_boundary_terms() const {
  return model_.control == scene::HourglassControl::viscosity ||
         !model_.following_pressures.empty() || !model_.penalty_supports.empty() ||
         !interfaces_.empty();
}

template <int Dim>
bool Equilibrium<Dim>::is_linear() const {
  return !model_.layout.finite && !model_.layout.plastic &&
         model_.control != scene::HourglassControl::viscosity &&
         model_.following_pressures.empty() && interfaces_.are_linear();
}

// Terms that scenes seldom have: following pressures, penalty supports, the paper's viscosity.
template <int Dim>
void Equilibrium<Dim>::add_boundary_terms(const Eigen::VectorXd& increment) {
  if (!has_boundary_terms()) return;
  using View = Eigen::Map<const fpm::Field<Dim>>;
  const Eigen::Index n = model_.size();
  Eigen::Map<fpm::Field<Dim>> force(evaluation_.unmasked.data(), n, Dim);
  const View step(increment.data(), n, Dim);
  if (model_.control == scene::HourglassControl::viscosity) {
    viscosity_.add_force(model_.viscosity, step_.start_position, step,
                         evaluation_.inverse_transposed, evaluation_.volume, force);
  }
  if (model_.following_pressures.empty() && model_.penalty_supports.empty() &&
      interfaces_.empty()) {
    return;
  }
  evaluation_.displacement = state_.displacement + step;
  if (!interfaces_.add_force(state_, evaluation_.displacement, rigid_load_, force)) {
    failure_.plate = true;
  }
  model::for_each_penalty(model_, state_,
                          [&](const auto& support, const fpm::FieldView<Dim>& target) {
                            fpm::add_penalty_force<Dim>(support.op, support.points, support.options,
                                                        target, evaluation_.displacement, force);
                          });
  if (model_.following_pressures.empty()) return;
  Eigen::Map<fpm::Field<Dim>> following(evaluation_.following.data(), n, Dim);
  following.setZero();
  for (const auto& load : model_.following_pressures) {
    const double pressure = load.pressure * (load.scaled ? step_.load : 1.0);
    const std::optional<fpm::Index> inverted = fpm::add_following_pressure<Dim>(
        load.op, load.points, pressure, evaluation_.displacement, following);
    if (inverted) failure_.particle = nearest_particle(load.points.position.row(*inverted));
  }
  evaluation_.unmasked -= evaluation_.following;
}

template <int Dim>
void Equilibrium<Dim>::add_boundary_actions(const Eigen::VectorXd& v, double load_change,
                                            Eigen::VectorXd& jv) {
  using View = Eigen::Map<const fpm::Field<Dim>>;
  const Eigen::Index n = model_.size();
  Eigen::Map<fpm::Field<Dim>> force(jv.data(), n, Dim);
  const View direction(v.data(), n, Dim);
  const View step(evaluation_.base_increment.data(), n, Dim);
  if (model_.control == scene::HourglassControl::viscosity) {
    viscosity_.add_action(model_.viscosity, step_.start_position, step, direction,
                          evaluation_.inverse_transposed, evaluation_.volume, force);
  }
  for (const auto& support : model_.penalty_supports) {
    fpm::add_penalty_action<Dim>(support.op, support.points, support.options, direction, force);
  }
  interfaces_.add_action(direction, load_change, force);
  if (model_.following_pressures.empty()) return;
  evaluation_.displacement = state_.displacement + step;
  for (const auto& load : model_.following_pressures) {
    const double pressure = -load.pressure * (load.scaled ? step_.load : 1.0);
    fpm::add_following_pressure_action<Dim>(load.op, load.points, pressure,
                                            evaluation_.displacement, direction, force);
  }
}

template <int Dim>
std::vector<model::MemoryPart> Equilibrium<Dim>::memory(bool to_come) const {
  const ArraySizes& sizes = step_.sizes;
  const std::size_t tangents =
      to_come
          ? static_cast<std::size_t>(sizes.tangent_entries + sizes.rotation_entries) * sizeof(float)
          : bytes_of(tangents_);
  return {
      {"stencils", operator_.bytes() + correction_.bytes()},
      {"arrays of a step", bytes_of(step_)},
      {"arrays of an evaluation", bytes_of(evaluation_) + given_.capacity() * sizeof(Eigen::Index)},
      {"tangents", tangents},
      {"viscosity, interfaces", viscosity_.bytes() + interfaces_.bytes()}};
}

template class Equilibrium<2>;
template class Equilibrium<3>;

}  // namespace equilibrium
