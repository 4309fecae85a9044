#pragma once

#include <algorithm>
#include <limits>
#include <variant>

#include "wiring/equilibrium.hpp"

// One binary serves every x86-64; the loader picks the widest variant the processor has. Sanitizer
// builds keep to one (their runtime is not up when the loader resolves the variants).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__OPTIMIZE__)
#define WIRING_HOT __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define WIRING_HOT
#endif

namespace wiring {

/// The loops over particles of one law, with access to the equilibrium's work arrays.
template <int Dim, class Law>
struct LoopsOf {
  using Equilibrium = wiring::Equilibrium<Dim>;
  using Operator = fpm::MomentOperator<Dim>;
  using Tensor = fpm::Tensor<Dim>;
  using Vector = fpm::Vector<Dim>;
  static constexpr int size = generalised_size<Dim, Law::mixed>;
  static constexpr fpm::Index none = std::numeric_limits<fpm::Index>::max();

  /// Moments of one row of a block, in the order of the channels.
  struct RowMoments {
    const double* at;  // of the row within the block buffer
    bool pair;

    void read(int first, int count, double* out) const {
      for (int e = 0; e < count; ++e) out[e] = at[(first + e) * Operator::block_stride];
    }
    ParticleIncrement<Dim> increment() const {
      ParticleIncrement<Dim> i;
      read(0, Dim * Dim, i.gradient.data());
      if constexpr (Law::mixed) {
        read(Dim * (Dim + (pair ? 1 + Dim : 0)), 6, i.second_gradient.data());
      }
      return i;
    }
    Vector pair_first() const {
      Vector v;
      read(Dim * Dim, Dim, v.data());
      return v;
    }
    Tensor pair_second() const {
      Tensor t;
      read(Dim * Dim + Dim, Dim * Dim, t.data());
      return t;
    }
  };

  /// Rows [begin, end) of one block and one material. `Work::row` returns whether it could; the
  /// lowest index that could not is returned, else `none`.
  template <class Work, class Material>
  static fpm::Index plain_rows(Equilibrium& e, fpm::Index begin, fpm::Index end,
                               const double* moments, const Material& material) {
    const bool pair = e.model_.channels.pair;
    fpm::Index failed = none;
    for (fpm::Index a = begin; a < end; ++a) {
      if (!Work::row(e, a, RowMoments{moments + (a - begin), pair}, material)) {
        failed = std::min(failed, a);
      }
    }
    return failed;
  }

  /// The same, compiled for several instruction sets with everything inlined: for hot, short laws.
  template <class Work, class Material>
  WIRING_HOT static fpm::Index hot_rows(Equilibrium& e, fpm::Index begin, fpm::Index end,
                                        const double* moments, const Material& material) {
    return plain_rows<Work>(e, begin, end, moments, material);
  }

  template <class Work, class Material>
  static fpm::Index rows(Equilibrium& e, fpm::Index begin, fpm::Index end, const double* moments,
                         const Material& material) {
    // The scene's check refuses a material that its integration does not support.
    if constexpr (!Law::template supports<Material>) {
      return begin;
    } else if constexpr (Work::hot && !std::same_as<Material, constitutive::MohrCoulomb>) {
      return hot_rows<Work>(e, begin, end, moments, material);
    } else {
      return plain_rows<Work>(e, begin, end, moments, material);
    }
  }

  /// Runs `Work` over all rows, block by block, with one visit per run of equal material.
  template <class Work>
  static fpm::Index for_each_row(Equilibrium& e) {
    const auto& op = e.operator_;
    const auto& material_of = e.model_.material;
    fpm::Index failed = none;
#pragma omp parallel reduction(min : failed)
    {
      constexpr int most_channels = Dim + 1 + Dim + fpm::second_gradient_size<Dim>;
      alignas(64) double moments[most_channels * Dim * Operator::block_stride];
#pragma omp for schedule(static)
      for (fpm::Index block = 0; block < op.block_count(); ++block) {
        op.gather(block, e.extended_.data(), moments);
        const fpm::Index first = op.block_first(block);
        const fpm::Index end = first + op.block_size(block);
        for (fpm::Index begin = first; begin < end;) {
          const auto material = material_of[static_cast<std::size_t>(begin)];
          fpm::Index run_end = begin + 1;
          while (run_end < end && material_of[static_cast<std::size_t>(run_end)] == material) {
            ++run_end;
          }
          const fpm::Index run_failed = std::visit(
              [&](const auto& m) {
                return rows<Work>(e, begin, run_end, moments + (begin - first), m);
              },
              e.model_.materials[material]);
          failed = std::min(failed, run_failed);
          begin = run_end;
        }
      }
    }
    return failed == none ? -1 : failed;
  }

  /// Stores generalised stresses and pair forces of one row where `scatter` looks for them.
  static void store(Equilibrium& e, fpm::Index a, const Tensor& nominal,
                    const fpm::SecondGradient* second, const fpm::PairResponse<Dim>* pair) {
    const Eigen::Index stride = e.operator_.stride();
    double* out = e.stress_.data() + a;
    const auto put = [&](const double* values, int count) {
      for (int k = 0; k < count; ++k, out += stride) *out = values[k];
    };
    if (pair == nullptr) {
      put(nominal.data(), Dim * Dim);
    } else {
      const Tensor total = nominal + pair->stress;
      const Tensor on_position = pair->on_position.transpose();  // row-major for scatter
      const Tensor affine = pair->affine.transpose();
      put(total.data(), Dim * Dim);
      put(&pair->stiffness, 1);
      put(pair->constant.data(), Dim);
      put(on_position.data(), Dim * Dim);
      put(affine.data(), Dim * Dim);
      const Eigen::Index n = e.model_.size();
      for (int i = 0; i < Dim; ++i) e.own_force_[i * n + a] = pair->own_force[i];
    }
    if constexpr (Law::mixed) put(second->data(), 6);
  }

  static Vector field_at(const Equilibrium& e, fpm::Index a) {
    Vector v;
    for (int i = 0; i < Dim; ++i) v[i] = e.extended_[i * e.operator_.stride() + a];
    return v;
  }

  static fpm::PairResponse<Dim> pair_force(const Equilibrium& e, fpm::Index a,
                                           const RowMoments& moments, const Tensor& gradient,
                                           const Tensor& defect) {
    return fpm::pair_response<Dim>(e.pair_stiffness_[a], e.pair_row(a), field_at(e, a),
                                   moments.pair_first(), moments.pair_second(), gradient, defect);
  }

  static bool remembers(const Equilibrium& e, fpm::Index a) {
    return e.model_.layout.incremental && e.state_.released[a] > 0.0;
  }

  // F^-T and volume of the row, which the paper's viscosity works on.
  static void keep_configuration(Equilibrium& e, fpm::Index a, const Tensor& increment) {
    if (e.inverse_transposed_.rows() == 0) return;
    const ParticleStart<Dim> start = e.start_of(a);
    const detail::CurrentGradient<Dim> now(start.gradient, increment);
    e.volume_[a] = start.reference_volume * now.determinant;
    const Tensor transposed = now.inverse.transpose();
    e.inverse_transposed_.row(a) = detail::flat(transposed).transpose();
  }

  struct Respond {
    static constexpr bool hot = true;
    template <class Material>
    static bool row(Equilibrium& e, fpm::Index a, const RowMoments& moments,
                    const Material& material) {
      const ParticleIncrement<Dim> increment = moments.increment();
      ParticleResponse<Dim> response;
      Law::respond(material, e.start_of(a), increment, response);
      if (!response.admissible) return false;
      keep_configuration(e, a, increment.gradient);
      if (!moments.pair) {
        store(e, a, response.nominal, &response.second_stress, nullptr);
        return true;
      }
      Tensor defect = Tensor::Identity();
      if (remembers(e, a)) defect -= response.rotation;
      const auto pair = pair_force(e, a, moments, increment.gradient, defect);
      store(e, a, response.nominal, &response.second_stress, &pair);
      return true;
    }
  };
  static fpm::Index respond(Equilibrium& e) {
    return for_each_row<Respond>(e);
  }

  struct Linearise {
    static constexpr bool hot = false;
    template <class Material>
    static bool row(Equilibrium& e, fpm::Index a, const RowMoments& moments,
                    const Material& material) {
      ParticleTangent<Dim, Law::mixed> tangent;
      const ParticleIncrement<Dim> increment = moments.increment();
      if (!Law::linearise(material, e.start_of(a), increment, tangent)) return false;
      keep_configuration(e, a, increment.gradient);
      Eigen::Map<Eigen::Matrix<double, size, size>>(e.tangent_.data() +
                                                    Eigen::Index{a} * size * size) = tangent.stress;
      if (e.model_.layout.incremental) {
        Eigen::Map<Eigen::Matrix<double, Dim * Dim, Dim * Dim>>(e.rotation_tangent_.col(a).data()) =
            tangent.rotation;
      }
      return true;
    }
  };
  static fpm::Index linearise(Equilibrium& e) {
    const Eigen::Index n = e.model_.size();
    e.tangent_.resize(n * size * size);
    e.rotation_tangent_.resize(Eigen::NoChange, e.model_.layout.incremental ? n : 0);
    return for_each_row<Linearise>(e);
  }

  struct Apply {
    static constexpr bool hot = true;
    template <class Material>
    static bool row(Equilibrium& e, fpm::Index a, const RowMoments& moments, const Material&) {
      const ParticleIncrement<Dim> direction = moments.increment();
      Eigen::Matrix<double, size, 1> strain;
      strain.template head<Dim * Dim>() = detail::flat(direction.gradient);
      if constexpr (Law::mixed) {
        strain.template tail<6>() = detail::flat(direction.second_gradient);
      }
      const Eigen::Map<const Eigen::Matrix<double, size, size>> tangent(
          e.tangent_.data() + Eigen::Index{a} * size * size);
      const Eigen::Matrix<double, size, 1> stress = tangent * strain;
      const Tensor nominal = Eigen::Map<const Tensor>(stress.data());
      fpm::SecondGradient second;
      if constexpr (Law::mixed) second = Eigen::Map<const fpm::SecondGradient>(stress.data() + 4);
      if (!moments.pair) {
        store(e, a, nominal, &second, nullptr);
        return true;
      }
      Tensor defect = Tensor::Zero();
      if (remembers(e, a)) {
        const Eigen::Map<const Eigen::Matrix<double, Dim * Dim, Dim * Dim>> rotation(
            e.rotation_tangent_.col(a).data());
        const Eigen::Matrix<double, Dim * Dim, 1> change =
            rotation * strain.template head<Dim * Dim>();
        defect = -Eigen::Map<const Tensor>(change.data());
      }
      const auto pair = pair_force(e, a, moments, direction.gradient, defect);
      store(e, a, nominal, &second, &pair);
      return true;
    }
  };
  static fpm::Index apply(Equilibrium& e) {
    return for_each_row<Apply>(e);
  }

  struct Commit {
    static constexpr bool hot = false;
    template <class Material>
    static bool row(Equilibrium& e, fpm::Index a, const RowMoments& moments,
                    const Material& material) {
      const ParticleIncrement<Dim> increment = moments.increment();
      ParticleResponse<Dim> response;
      Law::respond(material, e.start_of(a), increment, response);
      State<Dim>& s = e.state_;
      s.stress.col(a) = response.point.stress;
      if (s.layout.finite) s.deformation_gradient.col(a) += detail::flat(increment.gradient);
      if (s.layout.plastic) {
        s.plastic_strain[a] = response.point.plastic_strain;
        s.plastic_volume_strain[a] = response.point.plastic_volume_strain;
        s.plastic_increment[a] = response.plastic_increment;
      }
      if (s.layout.incremental && response.plastic) s.released[a] = 1.0;
      if constexpr (Law::mixed) {
        for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
          s.subpoint_deviator.template block<4, 1>(4 * static_cast<Eigen::Index>(k), a) =
              response.deviator[k];
        }
      }
      return true;
    }
  };
  static fpm::Index commit(Equilibrium& e) {
    return for_each_row<Commit>(e);
  }
};

template <int Dim, class Law>
LawLoops<Dim> law_loops() {
  using Loops = LoopsOf<Dim, Law>;
  return {&Loops::respond, &Loops::linearise, &Loops::apply, &Loops::commit};
}

}  // namespace wiring
