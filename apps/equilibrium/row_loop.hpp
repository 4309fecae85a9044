#pragma once

#include <algorithm>
#include <atomic>
#include <concepts>
#include <limits>
#include <variant>

#include "equilibrium/instruction_sets.hpp"
#include "equilibrium/row_data.hpp"
#include "fpm/threads.hpp"

namespace equilibrium {

/// Runs some work over all rows of an operator, block by block, in parallel.
///
/// The work on a particle is a template over `Real`; as many consecutive particles as a register
/// has lanes are worked on at a time as long as there are so many of one material.
template <int Dim, class Law>
struct RowLoop {
  template <class Real>
  using Moments = RowMoments<Dim, Law::mixed, Real>;
  static constexpr fpm::Index none = std::numeric_limits<fpm::Index>::max();

  /// Whether particles of a material can be worked on side by side.
  template <class Work, class Material>
  static constexpr bool wide = Work::wide && !requires {
    Material::one_point_at_a_time;
  };

  /// Rows [begin, end) of one block and one material. `Work::row` returns where it could; the
  /// lowest index where it could not is returned, else `none`.
  template <class Work, int Width, class Material>
  static fpm::Index plain_rows(const LoopData<Dim>& data, fpm::Index begin, fpm::Index end,
                               const double* moments, const Material& material) {
    const fpm::Channels channels = data.op.channels();
    fpm::Index failed = none;
    fpm::Index a = begin;
    if constexpr (Width > 1) {
      for (; a + Width <= end; a += Width) {
        const LaneMask<Width> could =
            Work::row(data, a, Moments<Lanes<Width>>{moments + (a - begin), channels}, material);
        if (!any(!could)) continue;
        for (int lane = Width - 1; lane >= 0; --lane) {
          if (!could[lane]) failed = std::min(failed, a + lane);
        }
      }
    }
    for (; a < end; ++a) {
      if (!Work::row(data, a, Moments<double>{moments + (a - begin), channels}, material)) {
        failed = std::min(failed, a);
      }
    }
    return failed;
  }

#ifdef EQUILIBRIUM_WIDE_LOOPS
  template <class Work, class Material>
  EQUILIBRIUM_AVX512 __attribute__((flatten)) static fpm::Index avx512_rows(
      const LoopData<Dim>& data, fpm::Index begin, fpm::Index end, const double* moments,
      const Material& material) {
    return plain_rows<Work, 8>(data, begin, end, moments, material);
  }
  template <class Work, class Material>
  EQUILIBRIUM_AVX2 __attribute__((flatten)) static fpm::Index avx2_rows(const LoopData<Dim>& data,
                                                                        fpm::Index begin,
                                                                        fpm::Index end,
                                                                        const double* moments,
                                                                        const Material& material) {
    return plain_rows<Work, 4>(data, begin, end, moments, material);
  }
#endif

  template <class Work, class Material>
  static fpm::Index rows(const LoopData<Dim>& data, fpm::Index begin, fpm::Index end,
                         const double* moments, const Material& material) {
    if constexpr (!wide<Work, Material>) {
      return plain_rows<Work, 1>(data, begin, end, moments, material);
    } else {
#ifdef EQUILIBRIUM_WIDE_LOOPS
      if (__builtin_cpu_supports("x86-64-v4")) {
        return avx512_rows<Work>(data, begin, end, moments, material);
      }
      if (__builtin_cpu_supports("x86-64-v3")) {
        return avx2_rows<Work>(data, begin, end, moments, material);
      }
#endif
      return plain_rows<Work, 4>(data, begin, end, moments, material);
    }
  }

  /// Rows of one block, with one visit per run of one law.
  template <class Work>
  static fpm::Index material_runs(const LoopData<Dim>& data, fpm::Index first, fpm::Index end,
                                  const double* moments) {
    const auto& law_of = data.law_of;
    fpm::Index failed = none;
    for (fpm::Index begin = first; begin < end;) {
      const auto law = law_of[static_cast<std::size_t>(begin)];
      fpm::Index run_end = begin + 1;
      while (run_end < end && law_of[static_cast<std::size_t>(run_end)] == law) {
        ++run_end;
      }
      const fpm::Index run_failed = std::visit(
          [&](const auto& m) {
            return rows<Work>(data, begin, run_end, moments + (begin - first), m);
          },
          data.laws[law]);
      failed = std::min(failed, run_failed);
      begin = run_end;
    }
    return failed;
  }

  /// Runs `Work` over all rows, block by block.
  template <class Work>
  static LoopOutcome for_each_row(const LoopData<Dim>& data) {
    const auto& op = data.op;
    std::atomic<fpm::Index> failed = none;
    fpm::for_each_block(op.block_count(), [&](fpm::Index block) {
      alignas(64) double
          moments[fpm::most_channels<Dim> * Dim * fpm::MomentOperator<Dim>::block_stride];
      op.gather(block, data.evaluation.extended.data(), moments);
      const fpm::Index first = op.block_first(block);
      const fpm::Index end = first + op.block_size(block);
      fpm::Index lowest = none;
      if constexpr (Work::by_material) {
        lowest = material_runs<Work>(data, first, end, moments);
      } else {
        lowest = rows<Work>(data, first, end, moments, std::monostate{});
      }
      for (fpm::Index known = failed; lowest < known;) {
        if (failed.compare_exchange_weak(known, lowest)) break;
      }
    });
    return {failed == none ? -1 : failed.load()};
  }
};

}  // namespace equilibrium
