#pragma once

#include "equilibrium/row_loop.hpp"
#include "equilibrium/tangent_layout.hpp"

namespace equilibrium {

/// The loops over particles of one law.
template <int Dim, class Law>
struct LoopsOf {
  using Data = LoopData<Dim>;
  using Loop = RowLoop<Dim, Law>;
  template <class Real>
  using Moments = RowMoments<Dim, Law::mixed, Real>;
  template <class Real>
  using Tensor = fpm::Tensor<Dim, Real>;
  template <class Real>
  using Vector = fpm::Vector<Dim, Real>;
  template <class Real>
  using Second = fpm::SecondGradient<Dim, Real>;
  template <class Real>
  using Mask = constitutive::Mask<Real>;
  static constexpr int size = generalised_size<Dim, Law::mixed>;
  static constexpr int second_size = fpm::SecondGradient<Dim>::SizeAtCompileTime;

  /// Stores generalised stresses and pair forces of one row where `scatter` looks for them.
  template <class Real>
  static void put(const Data& data, fpm::Index a, const Tensor<Real>& nominal,
                  const Second<Real>& second, const fpm::PairResponse<Dim, Real>* pair) {
    const Eigen::Index stride = data.op.stride();
    double* out = data.evaluation.stress.data() + a;
    const auto put_all = [&](const Real* values, int count) {
      for (int k = 0; k < count; ++k, out += stride) store(out, values[k]);
    };
    if (pair == nullptr) {
      put_all(nominal.data(), Dim * Dim);
    } else {
      const Tensor<Real> total = nominal + pair->stress;
      const Tensor<Real> on_position = pair->on_position.transpose();  // row-major for scatter
      const Tensor<Real> affine = pair->affine.transpose();
      put_all(total.data(), Dim * Dim);
      put_all(&pair->stiffness, 1);
      put_all(pair->constant.data(), Dim);
      put_all(on_position.data(), Dim * Dim);
      put_all(affine.data(), Dim * Dim);
      const Eigen::Index n = data.op.size();
      for (int i = 0; i < Dim; ++i)
        store(data.evaluation.own_force.data() + i * n + a, pair->own_force[i]);
    }
    if constexpr (Law::mixed) put_all(second.data(), second_size);
  }

  template <class Real>
  static fpm::PairResponse<Dim, Real> pair_force(const Data& data, fpm::Index a,
                                                 const Moments<Real>& moments,
                                                 const Tensor<Real>& gradient,
                                                 const Tensor<Real>& defect) {
    Vector<Real> field;
    for (int i = 0; i < Dim; ++i) {
      field[i] = load<Real>(data.evaluation.extended.data() + i * data.op.stride() + a);
    }
    return fpm::pair_response(load<Real>(data.step.pair_stiffness.data() + a),
                              pair_row<Real>(data, a), field, moments.pair_first(),
                              moments.pair_second(), gradient, defect);
  }

  // `value` where the row's pair control remembers its beginning (omega = 1), else `otherwise`.
  template <class Real>
  static Tensor<Real> if_released(const Data& data, fpm::Index a, const Tensor<Real>& value,
                                  const Tensor<Real>& otherwise) {
    using constitutive::select;
    const Mask<Real> released = load<Real>(data.state.released.data() + a) > Real(0.0);
    Tensor<Real> chosen;
    for (int k = 0; k < Dim * Dim; ++k) {
      chosen.data()[k] = select(released, value.data()[k], otherwise.data()[k]);
    }
    return chosen;
  }

  // F^-T and volume of the row, which the paper's viscosity works on.
  template <class Real>
  static void keep_configuration(const Data& data, fpm::Index a, const Tensor<Real>& increment) {
    if (data.evaluation.inverse_transposed.rows() == 0) return;
    const auto start = particle_start<Real>(data, a);
    const detail::CurrentGradient<Dim, Real> now(start.gradient, increment);
    store(data.evaluation.volume.data() + a, Real(start.reference_volume * now.determinant));
    const Tensor<Real> transposed = now.inverse.transpose();
    for (int k = 0; k < Dim * Dim; ++k) {
      store(data.evaluation.inverse_transposed.col(k).data() + a, transposed.data()[k]);
    }
  }

  struct Respond {
    static constexpr bool by_material = true;
    static constexpr bool wide = true;
    template <class Material, class Real>
    static Mask<Real> row(const Data& data, fpm::Index a, const Moments<Real>& moments,
                          const Material& material) {
      const auto increment = moments.increment();
      ParticleResponse<Dim, Real> response;
      Law::respond(material, particle_start<Real>(data, a), increment, response);
      keep_configuration<Real>(data, a, increment.gradient);
      if (!moments.channels.pair) {
        put<Real>(data, a, response.nominal, response.second_stress, nullptr);
        return response.admissible;
      }
      Tensor<Real> defect = Tensor<Real>::Identity();
      if (data.state.layout.incremental) {
        defect = if_released<Real>(data, a, defect - response.rotation, defect);
      }
      const auto pair = pair_force<Real>(data, a, moments, increment.gradient, defect);
      put<Real>(data, a, response.nominal, response.second_stress, &pair);
      return response.admissible;
    }
  };
  static LoopOutcome respond(const Data& data) {
    return Loop::template for_each_row<Respond>(data);
  }

  struct Linearise {
    static constexpr bool by_material = true;
    static constexpr bool wide = true;
    template <class Material, class Real>
    static Mask<Real> row(const Data& data, fpm::Index a, const Moments<Real>& moments,
                          const Material& material) {
      ParticleTangent<Dim, Law::mixed, Real> tangent;
      const auto increment = moments.increment();
      const Mask<Real> could =
          Law::linearise(material, particle_start<Real>(data, a), increment, tangent);
      keep_configuration<Real>(data, a, increment.gradient);
      tangent.stress *= Real(1.0 / data.tangents.unit);
      StressTangents<size>::put(data.tangents.stress.data(), a, tangent.stress.data());
      if (data.state.layout.incremental) {
        RotationTangents<Dim>::put(data.tangents.rotation.data(), a, tangent.rotation.data());
      }
      return could;
    }
  };
  static LoopOutcome linearise(const Data& data) {
    return Loop::template for_each_row<Linearise>(data);
  }

  struct Apply {
    static constexpr bool by_material = false;
    static constexpr bool wide = true;
    // The first `Count` rows and columns of a tangent on as many strains.
    template <int Count, class Real>
    static Eigen::Matrix<Real, Count, 1> product(const float* tangent,
                                                 const Eigen::Matrix<Real, size, 1>& strain) {
      Eigen::Matrix<Real, Count, 1> sum = Eigen::Matrix<Real, Count, 1>::Zero();
      for (int j = 0; j < Count; ++j) {
        for (int i = 0; i < Count; ++i, tangent += StressTangents<size>::group) {
          sum[i] += load<Real>(tangent) * strain[j];
        }
      }
      return sum;
    }
    template <class Real>
    static Mask<Real> row(const Data& data, fpm::Index a, const Moments<Real>& moments,
                          std::monostate) {
      const auto direction = moments.increment();
      Eigen::Matrix<Real, size, 1> strain;
      strain.template head<Dim * Dim>() = detail::flat(direction.gradient);
      if constexpr (Law::mixed) {
        strain.template tail<second_size>() = detail::flat(direction.second_gradient);
      }
      const Real unit = data.tangents.unit;
      const Eigen::Matrix<Real, size, 1> stress =
          unit *
          product<size, Real>(data.tangents.stress.data() + StressTangents<size>::at(a, 0), strain);
      const Tensor<Real> nominal = Eigen::Map<const Tensor<Real>>(stress.data());
      Second<Real> second;
      if constexpr (Law::mixed) {
        second = Eigen::Map<const Second<Real>>(stress.data() + Dim * Dim);
      }
      const Mask<Real> everywhere = Real(0.0) < Real(1.0);
      if (!moments.channels.pair) {
        put<Real>(data, a, nominal, second, nullptr);
        return everywhere;
      }
      Tensor<Real> defect = Tensor<Real>::Zero();
      if (data.state.layout.incremental) {
        const auto change = product<Dim * Dim, Real>(
            data.tangents.rotation.data() + RotationTangents<Dim>::at(a, 0), strain);
        const Tensor<Real> turned = -Eigen::Map<const Tensor<Real>>(change.data());
        defect = if_released<Real>(data, a, turned, defect);
      }
      const auto pair = pair_force<Real>(data, a, moments, direction.gradient, defect);
      put<Real>(data, a, nominal, second, &pair);
      return everywhere;
    }
  };
  static void apply(const Data& data) {
    (void)Loop::template for_each_row<Apply>(data);  // linear: there is no row that cannot
  }

  struct Commit {
    static constexpr bool by_material = true;
    static constexpr bool wide = true;
    template <class Material, class Real>
    static Mask<Real> row(const Data& data, fpm::Index a, const Moments<Real>& moments,
                          const Material& material) {
      using constitutive::select;
      using State = model::State<Dim>;
      const auto increment = moments.increment();
      ParticleResponse<Dim, Real> response;
      const auto start = particle_start<Real>(data, a);
      Law::respond(material, start, increment, response);
      State& s = data.state;
      store_columns<State::stress_rows>(s.stress.col(a).data(), response.point.stress.data());
      if (s.layout.finite) {
        const Tensor<Real> gradient = start.gradient + increment.gradient;
        store_columns<Dim * Dim>(s.deformation_gradient.col(a).data(), gradient.data());
      }
      if (s.layout.plastic) {
        store(s.plastic_strain.data() + a, response.point.plastic_strain);
        store(s.plastic_volume_strain.data() + a, response.point.plastic_volume_strain);
        store(s.plastic_increment.data() + a, response.plastic_increment);
      }
      if (s.layout.incremental) {
        const Real before = load<Real>(s.released.data() + a);
        store(s.released.data() + a, select(response.plastic, Real(1.0), before));
      }
      if constexpr (Law::mixed) {
        std::array<Real, State::subpoint_rows> deviator;
        for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
          Eigen::Map<constitutive::StressVector<Dim, Real>>(
              deviator.data() + State::stress_rows * k) = response.deviator[k];
        }
        store_columns<State::subpoint_rows>(s.subpoint_deviator.col(a).data(), deviator.data());
      }
      return response.admissible;
    }
  };
  static LoopOutcome commit(const Data& data) { return Loop::template for_each_row<Commit>(data); }
};

template <int Dim, class Law>
LawLoops<Dim> law_loops() {
  using Loops = LoopsOf<Dim, Law>;
  return {&Loops::respond, &Loops::linearise, &Loops::apply, &Loops::commit};
}

}  // namespace equilibrium
