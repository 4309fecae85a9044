#pragma once

#include <array>

#include "equilibrium/lanes.hpp"
#include "equilibrium/law_loops.hpp"
#include "equilibrium/local_response.hpp"
#include "fpm/hourglass.hpp"

/// What a row is made of, read from the arrays: of particle `a`, and with Lanes of those behind it,
/// too. Inlined into the loops.
namespace equilibrium {

/// Moments of a row of a block (with Lanes, also of the rows behind it), in the order of the
/// channels.
template <int Dim, bool Mixed, class Real>
struct RowMoments {
  const double* at;  // of the row within the block buffer
  fpm::Channels channels;

  void read(int first, int count, Real* out) const {
    for (int e = 0; e < count; ++e) {
      out[e] = load<Real>(at + (first + e) * fpm::MomentOperator<Dim>::block_stride);
    }
  }
  ParticleIncrement<Dim, Real> increment() const {
    ParticleIncrement<Dim, Real> i;
    read(0, Dim * Dim, i.gradient.data());
    if constexpr (Mixed) {
      read(Dim * channels.second_gradient(Dim), fpm::SecondGradient<Dim>::SizeAtCompileTime,
           i.second_gradient.data());
    }
    return i;
  }
  fpm::Vector<Dim, Real> pair_first() const {
    fpm::Vector<Dim, Real> v;
    read(Dim * channels.kappa(Dim), Dim, v.data());
    return v;
  }
  fpm::Tensor<Dim, Real> pair_second() const {
    fpm::Tensor<Dim, Real> t;
    read(Dim * channels.kappa_x(Dim), Dim * Dim, t.data());
    return t;
  }
};

template <class Real, int Dim>
fpm::PairRow<Dim, Real> pair_row(const LoopData<Dim>& data, Eigen::Index a) {
  const fpm::MomentOperator<Dim>& op = data.op;
  const StepArrays<Dim>& step = data.step;
  fpm::PairRow<Dim, Real> pair;
  for (int i = 0; i < Dim; ++i) {
    pair.first_moment[i] = load<Real>(op.first_moments(i) + a);
    pair.position[i] = load<Real>(step.position.data() + i * op.stride() + a);
  }
  load_columns<Dim * Dim>(op.second_moments() + a * Dim * Dim, pair.second_moment.data());
  load_columns<Dim>(step.memory_first.col(a).data(), pair.memory_first.data());
  load_columns<Dim * Dim>(step.memory_second.col(a).data(), pair.memory_second.data());
  load_columns<Dim * Dim>(step.pair_gradient.col(a).data(), pair.gradient.data());
  return pair;
}

template <class Real, int Dim>
ParticleStart<Dim, Real> particle_start(const LoopData<Dim>& data, Eigen::Index a) {
  using State = model::State<Dim>;
  const State& state = data.state;
  ParticleStart<Dim, Real> start;
  if (state.layout.finite) {
    load_columns<Dim * Dim>(state.deformation_gradient.col(a).data(), start.gradient.data());
  } else {
    start.gradient.setIdentity();
  }
  start.reference_volume = load<Real>(state.rows.reference_volume().data() + a);
  load_columns<State::stress_rows>(state.stress.col(a).data(), start.point.stress.data());
  if (state.layout.plastic) {
    start.point.plastic_strain = load<Real>(state.plastic_strain.data() + a);
    start.point.plastic_volume_strain = load<Real>(state.plastic_volume_strain.data() + a);
  }
  if (state.layout.subpoints) {
    constexpr int second = fpm::SecondGradient<Dim>::SizeAtCompileTime;
    load_columns<second>(data.step.second_gradient.col(a).data(), start.second_gradient.data());
    std::array<Real, State::subpoint_rows> deviator;
    load_columns<State::subpoint_rows>(state.subpoint_deviator.col(a).data(), deviator.data());
    for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
      start.deviator[k] = Eigen::Map<const constitutive::StressVector<Dim, Real>>(
          deviator.data() + State::stress_rows * k);
    }
  }
  return start;
}

}  // namespace equilibrium
