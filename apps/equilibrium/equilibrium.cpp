#include "equilibrium/equilibrium.hpp"

#include <limits>

#include "equilibrium/mixed_law.hpp"
#include "equilibrium/plain_law.hpp"
#include "fpm/consistency.hpp"

namespace equilibrium {

template <int Dim>
Equilibrium<Dim>::Equilibrium(const model::Model<Dim>& model, model::State<Dim>& state)
    : model_(model), state_(state), loops_(choose_loops()) {
  if (model_.consistency) {
    // The correction belongs to the initial configuration, whatever was re-searched since.
    const fpm::Rows<Dim> initial(model_.particles, model_.ghosts, model_.row_options);
    potential_ = fpm::consistency_potential(initial, model_.ghosts, model_.area_vector);
  }
  rebuild_operator();
  const Eigen::Index n = model_.size();
  const Eigen::Index extended = operator_.stride();
  position_.setZero(extended * Dim);
  extended_.setZero(extended * Dim);
  force_.setZero(extended * Dim);
  stress_.setZero(extended * operator_.stress_count());
  own_force_.setZero(n * Dim);
  unmasked_.setZero(n * Dim);
  external_.setZero(n * Dim);
  second_gradient_.setZero(6, model_.channels.second ? n : 0);
  const Eigen::Index pairs = model_.channels.pair ? n : 0;
  memory_first_.setZero(Dim, pairs);
  memory_second_.setZero(Dim * Dim, pairs);
  pair_stiffness_.setZero(pairs);
  pair_gradient_.setZero(Dim * Dim, pairs);
  base_increment_.setZero(n * Dim);
  displacement_.setZero(n, Dim);
  if (model_.control == scene::HourglassControl::viscosity) {
    inverse_transposed_.setZero(model_.layout.finite ? n : 0, Dim * Dim);
    volume_ = state_.rows.reference_volume();
  }
}

template <int Dim>
LawLoops<Dim> Equilibrium<Dim>::choose_loops() const {
  const bool finite = model_.layout.finite;
  if constexpr (Dim == 2) {
    if (model_.layout.subpoints) {
      return finite ? law_loops<2, MixedLaw<true>>() : law_loops<2, MixedLaw<false>>();
    }
  }
  return finite ? law_loops<Dim, PlainLaw<Dim, true>>() : law_loops<Dim, PlainLaw<Dim, false>>();
}

template <int Dim>
void Equilibrium<Dim>::rebuild_operator() {
  operator_ = fpm::MomentOperator<Dim>(state_.rows, model_.ghosts, model_.channels, potential_);
  if (model_.control != scene::HourglassControl::viscosity) return;
  Eigen::VectorXd modulus(model_.size());
  for (Eigen::Index a = 0; a < modulus.size(); ++a) {
    modulus[a] = model_.youngs_modulus[model_.material[static_cast<std::size_t>(a)]];
  }
  viscosity_ = fpm::PairViscosity<Dim>(operator_, modulus, fpm::smoothing_lengths(state_.rows));
}

template <int Dim>
void Equilibrium<Dim>::begin_step(double load) {
  load_ = load;
  external_ = model_.constant_load + load * model_.scaled_load;
  start_position_ = model_.particles.position + state_.displacement;
  operator_.extend_positions(start_position_.data(), position_.data());
  if (!model_.channels.pair && !model_.channels.second) return;

  const int m = operator_.channel_count();
  const int second_channel = Dim + (model_.channels.pair ? 1 + Dim : 0);
#pragma omp parallel
  {
    Eigen::VectorXd moments(m * Dim * fpm::MomentOperator<Dim>::block_stride);
    Eigen::VectorXd row(m * Dim);
#pragma omp for schedule(static)
    for (fpm::Index block = 0; block < operator_.block_count(); ++block) {
      operator_.gather(block, position_.data(), moments.data());
      for (fpm::Index r = 0; r < operator_.block_size(block); ++r) {
        const Eigen::Index a = operator_.block_first(block) + r;
        for (int e = 0; e < m * Dim; ++e) {
          row[e] = moments[e * fpm::MomentOperator<Dim>::block_stride + r];
        }
        if (model_.channels.second) second_gradient_.col(a) = row.segment(second_channel * Dim, 6);
        if (model_.channels.pair) remember_pairs(a, row);
      }
    }
  }
}

template <int Dim>
void Equilibrium<Dim>::remember_pairs(Eigen::Index a, const Eigen::VectorXd& position_moments) {
  using Tensor = fpm::Tensor<Dim>;
  const auto row = static_cast<fpm::Index>(a);
  const Eigen::Map<const Tensor> gradient(position_moments.data());
  const Eigen::Map<const fpm::Vector<Dim>> first(position_moments.data() + Dim * Dim);
  const Eigen::Map<const Tensor> second(position_moments.data() + Dim * Dim + Dim);
  pair_gradient_.col(a) = position_moments.head(Dim * Dim);
  memory_first_.col(a) = first - gradient * operator_.first_moment(row);
  Eigen::Map<Tensor>(memory_second_.col(a).data()) =
      second - gradient * operator_.second_moment(row);

  const double youngs_modulus = model_.youngs_modulus[model_.material[static_cast<std::size_t>(a)]];
  double modulus = youngs_modulus;
  if (model_.layout.incremental && model_.layout.plastic) {
    const double sqrt_j2 =
        std::sqrt(constitutive::j2(constitutive::StressVector<Dim>(state_.stress.col(a))));
    modulus = fpm::pair_modulus(youngs_modulus, model_.pair_control.modulus_factor, sqrt_j2,
                                state_.plastic_increment[a]);
  }
  pair_stiffness_[a] =
      model_.pair_control.stiffness_ratio * modulus * state_.rows.reference_volume()[a];
}

template <int Dim>
void Equilibrium<Dim>::assemble(const double* field, double* force) {
  operator_.scatter(stress_.data(), field, position_.data(), force_.data());
  const Eigen::Index n = model_.size();
  for (int i = 0; i < Dim; ++i) {
    const double* component = force_.data() + i * operator_.stride();
    const double* own = own_force_.data() + i * n;
    double* out = force + i * n;
    if (model_.channels.pair) {
      for (Eigen::Index a = 0; a < n; ++a) out[a] = component[a] + own[a];
    } else {
      std::copy_n(component, n, out);
    }
  }
}

template <int Dim>
jfnk::Evaluation Equilibrium<Dim>::operator()(const Eigen::VectorXd& increment,
                                              Eigen::VectorXd& residual) {
  operator_.extend(increment.data(), extended_.data());
  failure_.particle = loops_.respond(*this);
  if (failure_.particle >= 0) return jfnk::Evaluation::out_of_domain;
  assemble(extended_.data(), unmasked_.data());
  unmasked_ -= external_;
  add_boundary_terms(increment);
  if (failure_.particle >= 0) return jfnk::Evaluation::out_of_domain;
  double reaction_square = 0.0;
  for (Eigen::Index k = 0; k < unmasked_.size(); ++k) {
    const bool given = model_.prescribed[static_cast<std::size_t>(k)] != 0;
    if (given) reaction_square += unmasked_[k] * unmasked_[k];
    residual[k] = given ? 0.0 : unmasked_[k];
  }
  reference_norm_ = std::max(std::sqrt(reaction_square), external_.norm());
  return jfnk::Evaluation::ok;
}

template <int Dim>
bool Equilibrium<Dim>::linearise(const Eigen::VectorXd& increment) {
  operator_.extend(increment.data(), extended_.data());
  base_increment_ = increment;
  failure_.particle = loops_.linearise(*this);
  return failure_.particle < 0;
}

template <int Dim>
void Equilibrium<Dim>::apply_jacobian(const Eigen::VectorXd& v, Eigen::VectorXd& jv) {
  operator_.extend(v.data(), extended_.data());
  loops_.apply(*this);
  assemble(extended_.data(), jv.data());
  add_boundary_actions(v, jv);
  for (Eigen::Index k = 0; k < jv.size(); ++k) {
    if (model_.prescribed[static_cast<std::size_t>(k)] != 0) jv[k] = 0.0;
  }
}

// Terms that scenes seldom have: following pressures, penalty supports, the paper's viscosity.
template <int Dim>
void Equilibrium<Dim>::add_boundary_terms(const Eigen::VectorXd& increment) {
  using View = Eigen::Map<const fpm::Field<Dim>>;
  const Eigen::Index n = model_.size();
  Eigen::Map<fpm::Field<Dim>> force(unmasked_.data(), n, Dim);
  const View step(increment.data(), n, Dim);
  if (model_.control == scene::HourglassControl::viscosity) {
    viscosity_.add_force(model_.viscosity, start_position_, step, inverse_transposed_, volume_,
                         force);
  }
  if (model_.following_pressures.empty() && model_.penalty_supports.empty()) return;
  displacement_ = state_.displacement + step;
  for (const auto& support : model_.penalty_supports) {
    fpm::add_penalty_force<Dim>(support.op, support.points, support.options, support.target,
                                displacement_, force);
  }
  for (const auto& load : model_.following_pressures) {
    const double pressure = -load.pressure * (load.scaled ? load_ : 1.0);  // f_ext is subtracted
    if (fpm::add_following_pressure<Dim>(load.op, load.points, pressure, displacement_, force)) {
      failure_.particle = 0;
    }
  }
}

template <int Dim>
void Equilibrium<Dim>::add_boundary_actions(const Eigen::VectorXd& v, Eigen::VectorXd& jv) {
  using View = Eigen::Map<const fpm::Field<Dim>>;
  const Eigen::Index n = model_.size();
  Eigen::Map<fpm::Field<Dim>> force(jv.data(), n, Dim);
  const View direction(v.data(), n, Dim);
  const View step(base_increment_.data(), n, Dim);
  if (model_.control == scene::HourglassControl::viscosity) {
    viscosity_.add_action(model_.viscosity, start_position_, step, direction, inverse_transposed_,
                          volume_, force);
  }
  for (const auto& support : model_.penalty_supports) {
    fpm::add_penalty_action<Dim>(support.op, support.points, support.options, direction, force);
  }
  if (model_.following_pressures.empty()) return;
  displacement_ = state_.displacement + step;
  for (const auto& load : model_.following_pressures) {
    const double pressure = -load.pressure * (load.scaled ? load_ : 1.0);
    fpm::add_following_pressure_action<Dim>(load.op, load.points, pressure, displacement_,
                                            direction, force);
  }
}

// Sum over pairs of k kappa y . (e - e(n)): what the control took from the work of the loads.
// Departure: not in the paper (share/doc/decisions/energy-corrected-load.md).
template <int Dim>
double Equilibrium<Dim>::hourglass_work(const Eigen::VectorXd& increment) const {
  if (!model_.channels.pair) return 0.0;
  using Tensor = fpm::Tensor<Dim>;
  using Vector = fpm::Vector<Dim>;
  const Eigen::Index stride = operator_.stride();
  Eigen::VectorXd extended(stride * Dim);
  operator_.extend(increment.data(), extended.data());
  const auto difference = [&](const Eigen::VectorXd& field, fpm::Index a, fpm::Index b) {
    Vector d;
    for (int i = 0; i < Dim; ++i) d[i] = field[i * stride + b] - field[i * stride + a];
    return d;
  };
  double work = 0.0;
  for (fpm::Index a = 0; a < operator_.size(); ++a) {
    const auto start = start_of<double>(a);
    Tensor gradient = Tensor::Zero();
    operator_.for_each_entry(a, [&](fpm::Index b, const double* w) {
      gradient += difference(extended, a, b) * Eigen::Map<const Eigen::Matrix<double, 1, Dim>>(w);
    });
    Tensor defect = Tensor::Identity();
    if (model_.layout.incremental && state_.released[a] > 0.0) {
      defect -= model_.layout.finite ? constitutive::objective_increment<Dim>(
                                           gradient, Tensor(start.gradient + 0.5 * gradient))
                                           .rotation
                                     : Tensor(Tensor::Identity());
    }
    const Eigen::Map<const Tensor> begin(pair_gradient_.col(a).data());
    double row = 0.0;
    operator_.for_each_entry(a, [&](fpm::Index b, const double* w) {
      const double kappa = w[Dim];
      if (kappa <= 0.0) return;
      const Vector x = Eigen::Map<const Vector>(w + Dim + 1) / kappa;
      const Vector change = difference(extended, a, b) - gradient * x;
      const Vector memory = difference(position_, a, b) - begin * x;
      row += kappa * (change + defect * memory).dot(change);
    });
    work += pair_stiffness_[a] * row;
  }
  return work;
}

template <int Dim>
StepForces Equilibrium<Dim>::commit(const Eigen::VectorXd& increment) {
  StepForces forces;
  forces.reaction = model_.measure.dot(unmasked_);
  forces.hourglass_work = hourglass_work(increment);
  forces.external_work = external_.dot(increment);
  for (Eigen::Index k = 0; k < increment.size(); ++k) {
    const bool given = model_.prescribed[static_cast<std::size_t>(k)] != 0;
    state_.reaction.data()[k] = given ? unmasked_[k] : 0.0;
    if (given) forces.external_work += unmasked_[k] * increment[k];
  }
  operator_.extend(increment.data(), extended_.data());
  loops_.commit(*this);
  state_.increment = Eigen::Map<const fpm::Field<Dim>>(increment.data(), model_.size(), Dim);
  state_.displacement += state_.increment;
  if (model_.layout.plastic) {
    forces.plastic = (state_.plastic_increment.array() > 0.0).count();
    forces.max_plastic_strain = state_.plastic_strain.maxCoeff();
  }
  return forces;
}

template <int Dim>
std::size_t Equilibrium<Dim>::bytes() const {
  const auto doubles = position_.size() + extended_.size() + force_.size() + stress_.size() +
                       own_force_.size() + unmasked_.size() + external_.size() +
                       second_gradient_.size() + memory_first_.size() + memory_second_.size() +
                       pair_stiffness_.size() + pair_gradient_.size() + tangent_.size() +
                       rotation_tangent_.size() + potential_.size() + base_increment_.size() +
                       inverse_transposed_.size() + volume_.size();
  return operator_.bytes() + static_cast<std::size_t>(doubles) * sizeof(double);
}

template class Equilibrium<2>;
template class Equilibrium<3>;

}  // namespace equilibrium
