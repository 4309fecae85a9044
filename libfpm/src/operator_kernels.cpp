#include "operator_kernels.hpp"

// One binary serves every x86-64: the loader picks the widest variant the processor has. Sanitizer
// builds keep to one (their runtime is not up when the loader resolves the variants).
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FPM_TARGET_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FPM_TARGET_CLONES
#endif
// Vectors never cross a call: everything that takes one is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"
#define FPM_INLINE inline __attribute__((always_inline))

namespace fpm::detail {
namespace {

constexpr int lanes = 4;
using Lanes = double __attribute__((vector_size(lanes * sizeof(double))));
// One move from any address, where std::memcpy would make two.
using UnalignedLanes __attribute__((aligned(sizeof(double)), may_alias)) = Lanes;
using Segment = SegmentedRows::Segment;

FPM_INLINE Lanes load(const double* p) {
  return *reinterpret_cast<const UnalignedLanes*>(p);
}

FPM_INLINE Lanes load(const double* p, const Index* at) {
  return Lanes{p[at[0]], p[at[1]], p[at[2]], p[at[3]]};
}

FPM_INLINE Lanes broadcast(double w) {
  return Lanes{w, w, w, w};
}

FPM_INLINE void store(double* p, const Lanes& v, Index count) {
  if (count >= lanes) {
    *reinterpret_cast<UnalignedLanes*>(p) = v;
  } else {
    for (Index lane = 0; lane < count; ++lane) p[lane] = v[lane];
  }
}

// How the entries of four rows are reached: one shared stencil at a constant offset from the row,
// or indices and weights of their own.
struct SharedEntries {
  const Index* ids;
  const double* weights;
  Index base;
  FPM_INLINE Lanes field(const double* p, Index k) const { return load(p + base + ids[k]); }
  template <int Count>
  FPM_INLINE Lanes weight(Index k, int channel) const {
    return broadcast(weights[k * Count + channel]);
  }
};

struct OwnEntries {
  const Index* ids;
  const double* weights;
  FPM_INLINE Lanes field(const double* p, Index k) const { return load(p, ids + k * lanes); }
  template <int Count>
  FPM_INLINE Lanes weight(Index k, int channel) const {
    return load(weights + (k * Count + channel) * lanes);
  }
};

template <int Dim, int Count, class Entries>
FPM_INLINE void gather_rows(const Entries& entries, Index width, Index base, Index count,
                            const double* field, std::ptrdiff_t stride, double* moments,
                            std::ptrdiff_t moment_stride) {
  Lanes sum[Count][Dim] = {};
  Lanes own[Dim];
  for (int i = 0; i < Dim; ++i) own[i] = load(field + i * stride + base);
  for (Index k = 0; k < width; ++k) {
    Lanes difference[Dim];
    for (int i = 0; i < Dim; ++i) {
      difference[i] = entries.field(field + i * stride, k) - own[i];
    }
    for (int c = 0; c < Count; ++c) {
      const Lanes w = entries.template weight<Count>(k, c);
      for (int i = 0; i < Dim; ++i) sum[c][i] += w * difference[i];
    }
  }
  for (int c = 0; c < Count; ++c) {
    for (int i = 0; i < Dim; ++i) store(moments + (c * Dim + i) * moment_stride, sum[c][i], count);
  }
}

template <int Dim, bool Pair, bool Second>
FPM_INLINE void gather_segments(const KernelRows& rows, const double* field, std::ptrdiff_t stride,
                                Index block_first, double* moments, std::ptrdiff_t moment_stride) {
  constexpr int count = Channels{Pair, Second}.count(Dim);
  for (const Segment* s = rows.begin; s != rows.end; ++s) {
    const Index* ids = rows.ids + s->id_begin;
    const double* weights = rows.weights + s->weight_begin;
    for (Index r = 0; r < s->count; r += lanes) {
      const Index base = s->first + r;
      double* out = moments + (base - block_first);
      if (s->shared) {
        gather_rows<Dim, count>(SharedEntries{ids, weights, base}, s->width, base, s->count - r,
                                field, stride, out, moment_stride);
      } else {
        gather_rows<Dim, count>(OwnEntries{ids, weights}, s->width, base, s->count - r, field,
                                stride, out, moment_stride);
      }
    }
  }
}

template <int Dim, bool Pair, bool Second, class Entries>
FPM_INLINE void scatter_rows(const Entries& entries, Index width, Index base, Index count,
                             const double* stress, const double* v, const double* x,
                             std::ptrdiff_t stride, double* force) {
  constexpr Channels channels{Pair, Second};
  constexpr int count_of_weights = channels.count(Dim);
  constexpr int pair = Dim * Dim;  // first stress entry of the pairs, then that of the sub-points
  constexpr int second = pair + (Pair ? 1 + Dim + 2 * Dim * Dim : 0);
  Lanes sum[Dim] = {};
  Lanes stiffness = {};
  Lanes rotation[Dim][Dim] = {};
  for (Index k = 0; k < width; ++k) {
    const auto entry = [&](int e) __attribute__((always_inline)) {
      return entries.field(stress + e * stride, k);
    };
    const auto weight = [&](int c) __attribute__((always_inline)) {
      return entries.template weight<count_of_weights>(k, c);
    };
    for (int j = 0; j < Dim; ++j) {
      const Lanes w = weight(j);
      for (int i = 0; i < Dim; ++i) sum[i] += w * entry(j * Dim + i);
    }
    if constexpr (Pair) {
      const Lanes kappa = weight(channels.kappa(Dim));
      stiffness += kappa * entry(pair);
      for (int i = 0; i < Dim; ++i) {
        sum[i] += kappa * entry(pair + 1 + i);
        for (int j = 0; j < Dim; ++j) {
          rotation[i][j] += kappa * entry(pair + 1 + Dim + i * Dim + j);
        }
      }
      for (int j = 0; j < Dim; ++j) {
        const Lanes w = weight(channels.kappa_x(Dim) + j);
        for (int i = 0; i < Dim; ++i) sum[i] -= w * entry(pair + 1 + Dim + Dim * Dim + i * Dim + j);
      }
    }
    if constexpr (Second) {
      for (int c = 0; c < second_gradient_size<Dim>; ++c) {
        const Lanes w = weight(channels.second_gradient(Dim) + c);
        for (int i = 0; i < Dim; ++i) sum[i] += w * entry(second + c * Dim + i);
      }
    }
  }
  for (int i = 0; i < Dim; ++i) {
    if constexpr (Pair) {
      sum[i] += stiffness * load(v + i * stride + base);
      for (int j = 0; j < Dim; ++j) sum[i] += rotation[i][j] * load(x + j * stride + base);
    }
    store(force + i * stride + base, sum[i], count);
  }
}

template <int Dim, bool Pair, bool Second>
FPM_INLINE void scatter_segments(const KernelRows& rows, const double* stress, const double* v,
                                 const double* x, std::ptrdiff_t stride, double* force) {
  for (const Segment* s = rows.begin; s != rows.end; ++s) {
    const Index* ids = rows.ids + s->id_begin;
    const double* weights = rows.weights + s->weight_begin;
    for (Index r = 0; r < s->count; r += lanes) {
      const Index base = s->first + r;
      if (s->shared) {
        scatter_rows<Dim, Pair, Second>(SharedEntries{ids, weights, base}, s->width, base,
                                        s->count - r, stress, v, x, stride, force);
      } else {
        scatter_rows<Dim, Pair, Second>(OwnEntries{ids, weights}, s->width, base, s->count - r,
                                        stress, v, x, stride, force);
      }
    }
  }
}

// target_clones wants plain functions, hence one pair for each combination that exists.
#define FPM_KERNELS(name, Dim, Pair, Second)                                                     \
  FPM_TARGET_CLONES void gather_##name(const KernelRows& rows, const double* field,              \
                                       std::ptrdiff_t stride, Index first, double* moments,      \
                                       std::ptrdiff_t moment_stride) {                           \
    gather_segments<Dim, Pair, Second>(rows, field, stride, first, moments, moment_stride);      \
  }                                                                                              \
  FPM_TARGET_CLONES void scatter_##name(const KernelRows& rows, const double* stress,            \
                                        const double* v, const double* x, std::ptrdiff_t stride, \
                                        double* force) {                                         \
    scatter_segments<Dim, Pair, Second>(rows, stress, v, x, stride, force);                      \
  }

FPM_KERNELS(plain_2d, 2, false, false)
FPM_KERNELS(pair_2d, 2, true, false)
FPM_KERNELS(second_2d, 2, false, true)
FPM_KERNELS(pair_second_2d, 2, true, true)
FPM_KERNELS(plain_3d, 3, false, false)
FPM_KERNELS(pair_3d, 3, true, false)
FPM_KERNELS(second_3d, 3, false, true)
FPM_KERNELS(pair_second_3d, 3, true, true)

template <class Kernel>
Kernel choose(Channels channels, Kernel plain, Kernel pair, Kernel second, Kernel both) {
  if (channels.pair) return channels.second ? both : pair;
  return channels.second ? second : plain;
}

}  // namespace

template <>
GatherKernel gather_kernel<2>(Channels channels) {
  return choose<GatherKernel>(channels, gather_plain_2d, gather_pair_2d, gather_second_2d,
                              gather_pair_second_2d);
}
template <>
GatherKernel gather_kernel<3>(Channels channels) {
  return choose<GatherKernel>(channels, gather_plain_3d, gather_pair_3d, gather_second_3d,
                              gather_pair_second_3d);
}
template <>
ScatterKernel scatter_kernel<2>(Channels channels) {
  return choose<ScatterKernel>(channels, scatter_plain_2d, scatter_pair_2d, scatter_second_2d,
                               scatter_pair_second_2d);
}
template <>
ScatterKernel scatter_kernel<3>(Channels channels) {
  return choose<ScatterKernel>(channels, scatter_plain_3d, scatter_pair_3d, scatter_second_3d,
                               scatter_pair_second_3d);
}

}  // namespace fpm::detail
