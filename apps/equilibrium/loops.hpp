#pragma once

#include <algorithm>
#include <limits>
#include <variant>

#include "equilibrium/equilibrium.hpp"

// One binary serves every x86-64; the loader picks the widest variant the processor has. Sanitizer
// builds keep to one (their runtime is not up when the loader resolves the variants).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__OPTIMIZE__)
#define WIRING_HOT __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define WIRING_HOT
#endif

namespace equilibrium {

/// Where the entries of the tangents of all particles lie: those of the particles of a register
/// side by side, so that applying them reads memory in order.
template <int Size>
struct TangentLayout {
  static Eigen::Index total(Eigen::Index particles) {
    return (particles + lane_count - 1) / lane_count * lane_count * Size;
  }
  static Eigen::Index at(Eigen::Index particle, int entry) {
    const Eigen::Index lane = particle % lane_count;
    return (particle - lane) * Size + Eigen::Index{entry} * lane_count + lane;
  }
  static void put(double* tangents, Eigen::Index particle, const double* entries) {
    for (int k = 0; k < Size; ++k) tangents[at(particle, k)] = entries[k];
  }
  static void put(double* tangents, Eigen::Index particle, const Lanes* entries) {
    for (int k = 0; k < Size; ++k) {
      for (int lane = 0; lane < lane_count; ++lane) {
        tangents[at(particle + lane, k)] = entries[k][lane];
      }
    }
  }
};

/// The loops over particles of one law, with access to the equilibrium's work arrays.
///
/// The work on a particle is a template over `Real`; `lane_count` consecutive particles are worked
/// on at a time as long as there are so many of one material.
template <int Dim, class Law>
struct LoopsOf {
  using Equilibrium = equilibrium::Equilibrium<Dim>;
  using Operator = fpm::MomentOperator<Dim>;
  template <class Real>
  using Tensor = fpm::Tensor<Dim, Real>;
  template <class Real>
  using Vector = fpm::Vector<Dim, Real>;
  template <class Real>
  using Mask = constitutive::Mask<Real>;
  static constexpr int size = generalised_size<Dim, Law::mixed>;
  using StressTangents = TangentLayout<size * size>;
  using RotationTangents = TangentLayout<Dim * Dim * Dim * Dim>;
  static constexpr fpm::Index none = std::numeric_limits<fpm::Index>::max();

  /// Moments of a row of a block (with Lanes, also of the rows behind it), in the order of the
  /// channels.
  template <class Real>
  struct RowMoments {
    const double* at;  // of the row within the block buffer
    bool pair;

    void read(int first, int count, Real* out) const {
      for (int e = 0; e < count; ++e) {
        out[e] = load<Real>(at + (first + e) * Operator::block_stride);
      }
    }
    ParticleIncrement<Dim, Real> increment() const {
      ParticleIncrement<Dim, Real> i;
      read(0, Dim * Dim, i.gradient.data());
      if constexpr (Law::mixed) {
        read(Dim * (Dim + (pair ? 1 + Dim : 0)), 6, i.second_gradient.data());
      }
      return i;
    }
    Vector<Real> pair_first() const {
      Vector<Real> v;
      read(Dim * Dim, Dim, v.data());
      return v;
    }
    Tensor<Real> pair_second() const {
      Tensor<Real> t;
      read(Dim * Dim + Dim, Dim * Dim, t.data());
      return t;
    }
  };

  /// Whether particles of a material can be worked on side by side.
  template <class Work, class Material>
  static constexpr bool wide = Work::wide && !requires {
    Material::one_point_at_a_time;
  };

  /// Rows [begin, end) of one block and one material. `Work::row` returns where it could; the
  /// lowest index where it could not is returned, else `none`.
  template <class Work, class Material>
  static fpm::Index plain_rows(Equilibrium& e, fpm::Index begin, fpm::Index end,
                               const double* moments, const Material& material) {
    const bool pair = e.model_.channels.pair;
    fpm::Index failed = none;
    fpm::Index a = begin;
    if constexpr (wide<Work, Material>) {
      for (; a + lane_count <= end; a += lane_count) {
        const LaneMask could =
            Work::row(e, a, RowMoments<Lanes>{moments + (a - begin), pair}, material);
        if (!any(!could)) continue;
        for (int lane = lane_count - 1; lane >= 0; --lane) {
          if (!could[lane]) failed = std::min(failed, a + lane);
        }
      }
    }
    for (; a < end; ++a) {
      if (!Work::row(e, a, RowMoments<double>{moments + (a - begin), pair}, material)) {
        failed = std::min(failed, a);
      }
    }
    return failed;
  }

  /// The same, compiled for several instruction sets with everything inlined.
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
    } else if constexpr (wide<Work, Material>) {
      return hot_rows<Work>(e, begin, end, moments, material);
    } else {
      return plain_rows<Work>(e, begin, end, moments, material);
    }
  }

  /// Rows of one block, with one visit per run of equal material.
  template <class Work>
  static fpm::Index material_runs(Equilibrium& e, fpm::Index first, fpm::Index end,
                                  const double* moments) {
    const auto& material_of = e.model_.material;
    fpm::Index failed = none;
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
    return failed;
  }

  /// Runs `Work` over all rows, block by block.
  template <class Work>
  static fpm::Index for_each_row(Equilibrium& e) {
    const auto& op = e.operator_;
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
        if constexpr (Work::by_material) {
          failed = std::min(failed, material_runs<Work>(e, first, end, moments));
        } else {
          failed = std::min(failed, hot_rows<Work>(e, first, end, moments, std::monostate{}));
        }
      }
    }
    return failed == none ? -1 : failed;
  }

  /// Stores generalised stresses and pair forces of one row where `scatter` looks for them.
  template <class Real>
  static void put(Equilibrium& e, fpm::Index a, const Tensor<Real>& nominal,
                  const fpm::BasicSecondGradient<Real>& second,
                  const fpm::PairResponse<Dim, Real>* pair) {
    const Eigen::Index stride = e.operator_.stride();
    double* out = e.stress_.data() + a;
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
      const Eigen::Index n = e.model_.size();
      for (int i = 0; i < Dim; ++i) store(e.own_force_.data() + i * n + a, pair->own_force[i]);
    }
    if constexpr (Law::mixed) put_all(second.data(), 6);
  }

  template <class Real>
  static fpm::PairResponse<Dim, Real> pair_force(const Equilibrium& e, fpm::Index a,
                                                 const RowMoments<Real>& moments,
                                                 const Tensor<Real>& gradient,
                                                 const Tensor<Real>& defect) {
    Vector<Real> field;
    for (int i = 0; i < Dim; ++i) {
      field[i] = load<Real>(e.extended_.data() + i * e.operator_.stride() + a);
    }
    return fpm::pair_response(load<Real>(e.pair_stiffness_.data() + a),
                              e.template pair_row<Real>(a), field, moments.pair_first(),
                              moments.pair_second(), gradient, defect);
  }

  // `value` where the row's pair control remembers its beginning (omega = 1), else `otherwise`.
  template <class Real>
  static Tensor<Real> if_released(const Equilibrium& e, fpm::Index a, const Tensor<Real>& value,
                                  const Tensor<Real>& otherwise) {
    using constitutive::select;
    const Mask<Real> released = load<Real>(e.state_.released.data() + a) > Real(0.0);
    Tensor<Real> chosen;
    for (int k = 0; k < Dim * Dim; ++k) {
      chosen.data()[k] = select(released, value.data()[k], otherwise.data()[k]);
    }
    return chosen;
  }

  // F^-T and volume of the row, which the paper's viscosity works on.
  template <class Real>
  static void keep_configuration(Equilibrium& e, fpm::Index a, const Tensor<Real>& increment) {
    if (e.inverse_transposed_.rows() == 0) return;
    const auto start = e.template start_of<Real>(a);
    const detail::CurrentGradient<Dim, Real> now(start.gradient, increment);
    store(e.volume_.data() + a, Real(start.reference_volume * now.determinant));
    const Tensor<Real> transposed = now.inverse.transpose();
    for (int k = 0; k < Dim * Dim; ++k) {
      store(e.inverse_transposed_.col(k).data() + a, transposed.data()[k]);
    }
  }

  struct Respond {
    static constexpr bool by_material = true;
    static constexpr bool wide = true;
    template <class Material, class Real>
    static Mask<Real> row(Equilibrium& e, fpm::Index a, const RowMoments<Real>& moments,
                          const Material& material) {
      const auto increment = moments.increment();
      ParticleResponse<Dim, Real> response;
      Law::respond(material, e.template start_of<Real>(a), increment, response);
      keep_configuration<Real>(e, a, increment.gradient);
      if (!moments.pair) {
        put<Real>(e, a, response.nominal, response.second_stress, nullptr);
        return response.admissible;
      }
      Tensor<Real> defect = Tensor<Real>::Identity();
      if (e.model_.layout.incremental) {
        defect = if_released<Real>(e, a, defect - response.rotation, defect);
      }
      const auto pair = pair_force<Real>(e, a, moments, increment.gradient, defect);
      put<Real>(e, a, response.nominal, response.second_stress, &pair);
      return response.admissible;
    }
  };
  static fpm::Index respond(Equilibrium& e) {
    return for_each_row<Respond>(e);
  }

  struct Linearise {
    static constexpr bool by_material = true;
    static constexpr bool wide = true;
    template <class Material, class Real>
    static Mask<Real> row(Equilibrium& e, fpm::Index a, const RowMoments<Real>& moments,
                          const Material& material) {
      ParticleTangent<Dim, Law::mixed, Real> tangent;
      const auto increment = moments.increment();
      const Mask<Real> could =
          Law::linearise(material, e.template start_of<Real>(a), increment, tangent);
      keep_configuration<Real>(e, a, increment.gradient);
      StressTangents::put(e.tangent_.data(), a, tangent.stress.data());
      if (e.model_.layout.incremental) {
        RotationTangents::put(e.rotation_tangent_.data(), a, tangent.rotation.data());
      }
      return could;
    }
  };
  static fpm::Index linearise(Equilibrium& e) {
    const Eigen::Index n = e.model_.size();
    e.tangent_.resize(StressTangents::total(n));
    e.rotation_tangent_.resize(RotationTangents::total(e.model_.layout.incremental ? n : 0));
    return for_each_row<Linearise>(e);
  }

  struct Apply {
    static constexpr bool by_material = false;
    static constexpr bool wide = true;
    // The first `Count` rows and columns of a tangent on as many strains.
    template <int Count, class Real>
    static Eigen::Matrix<Real, Count, 1> product(const double* tangent,
                                                 const Eigen::Matrix<Real, size, 1>& strain) {
      Eigen::Matrix<Real, Count, 1> sum = Eigen::Matrix<Real, Count, 1>::Zero();
      for (int j = 0; j < Count; ++j) {
        for (int i = 0; i < Count; ++i, tangent += lane_count) {
          sum[i] += load<Real>(tangent) * strain[j];
        }
      }
      return sum;
    }
    template <class Real>
    static Mask<Real> row(Equilibrium& e, fpm::Index a, const RowMoments<Real>& moments,
                          std::monostate) {
      const auto direction = moments.increment();
      Eigen::Matrix<Real, size, 1> strain;
      strain.template head<Dim * Dim>() = detail::flat(direction.gradient);
      if constexpr (Law::mixed) {
        strain.template tail<6>() = detail::flat(direction.second_gradient);
      }
      const auto stress = product<size, Real>(e.tangent_.data() + StressTangents::at(a, 0), strain);
      const Tensor<Real> nominal = Eigen::Map<const Tensor<Real>>(stress.data());
      fpm::BasicSecondGradient<Real> second;
      if constexpr (Law::mixed) {
        second = Eigen::Map<const fpm::BasicSecondGradient<Real>>(stress.data() + 4);
      }
      const Mask<Real> everywhere = Real(0.0) < Real(1.0);
      if (!moments.pair) {
        put<Real>(e, a, nominal, second, nullptr);
        return everywhere;
      }
      Tensor<Real> defect = Tensor<Real>::Zero();
      if (e.model_.layout.incremental) {
        const auto change = product<Dim * Dim, Real>(
            e.rotation_tangent_.data() + RotationTangents::at(a, 0), strain);
        const Tensor<Real> turned = -Eigen::Map<const Tensor<Real>>(change.data());
        defect = if_released<Real>(e, a, turned, defect);
      }
      const auto pair = pair_force<Real>(e, a, moments, direction.gradient, defect);
      put<Real>(e, a, nominal, second, &pair);
      return everywhere;
    }
  };
  static fpm::Index apply(Equilibrium& e) {
    return for_each_row<Apply>(e);
  }

  struct Commit {
    static constexpr bool by_material = true;
    static constexpr bool wide = false;
    template <class Material>
    static bool row(Equilibrium& e, fpm::Index a, const RowMoments<double>& moments,
                    const Material& material) {
      const auto increment = moments.increment();
      ParticleResponse<Dim> response;
      Law::respond(material, e.template start_of<double>(a), increment, response);
      model::State<Dim>& s = e.state_;
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

}  // namespace equilibrium
