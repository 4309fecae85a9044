#include "operator_kernels.hpp"

// One binary serves every x86-64: kernels are compiled for several instruction sets, as wide as
// their registers are, and chosen when the program runs.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define FPM_WIDE_KERNELS
#endif
// Vectors never cross a call: everything that takes one is inlined.
#pragma GCC diagnostic ignored "-Wpsabi"
#define FPM_INLINE inline __attribute__((always_inline))

namespace fpm::detail {
namespace {

using Segment = SegmentedRows::Segment;

// A register of rows. Rows with weights of their own lie in fours.
template <int Width>
struct Register {
  using Type __attribute__((vector_size(Width * sizeof(double)))) = double;
  // One move from any address, where std::memcpy would make two.
  using Unaligned __attribute__((aligned(sizeof(double)), may_alias)) = Type;
};
template <int Width>
using Lanes = typename Register<Width>::Type;
constexpr int own_width = 4;

template <int Width>
FPM_INLINE Lanes<Width> load(const double* p) {
  return *reinterpret_cast<const typename Register<Width>::Unaligned*>(p);
}

template <int Width>
FPM_INLINE void store(double* p, const Lanes<Width>& v, Index count) {
  if (count >= Width) {
    *reinterpret_cast<typename Register<Width>::Unaligned*>(p) = v;
  } else {
    for (Index lane = 0; lane < count; ++lane) p[lane] = v[lane];
  }
}

// How the entries of a register of rows are reached: one shared stencil at a constant offset from
// the row, or weights of their own, side by side or anywhere.
template <int Width>
struct SharedEntries {
  static constexpr int width = Width;
  const Index* ids;
  const double* weights;
  Index base;
  FPM_INLINE Lanes<Width> field(const double* p, Index k) const {
    return load<Width>(p + base + ids[k]);
  }
  template <int Count>
  FPM_INLINE Lanes<Width> weight(Index k, int channel) const {
    return weights[k * Count + channel] - Lanes<Width>{};
  }
};

struct AlignedEntries {
  static constexpr int width = own_width;
  const Index* ids;
  const double* weights;
  FPM_INLINE Lanes<width> field(const double* p, Index k) const { return load<width>(p + ids[k]); }
  template <int Count>
  FPM_INLINE Lanes<width> weight(Index k, int channel) const {
    return load<width>(weights + (k * Count + channel) * width);
  }
};

struct OwnEntries {
  static constexpr int width = own_width;
  const Index* ids;
  const double* weights;
  FPM_INLINE Lanes<width> field(const double* p, Index k) const {
    const Index* at = ids + k * width;
    return Lanes<width>{p[at[0]], p[at[1]], p[at[2]], p[at[3]]};
  }
  template <int Count>
  FPM_INLINE Lanes<width> weight(Index k, int channel) const {
    return load<width>(weights + (k * Count + channel) * width);
  }
};

template <int Dim, int Count, class Entries>
FPM_INLINE void gather_rows(const Entries& entries, Index width, Index base, Index count,
                            const double* field, std::ptrdiff_t stride, double* moments,
                            std::ptrdiff_t moment_stride) {
  using Lane = Lanes<Entries::width>;
  Lane sum[Count][Dim] = {};
  Lane own[Dim];
  for (int i = 0; i < Dim; ++i) own[i] = load<Entries::width>(field + i * stride + base);
  for (Index k = 0; k < width; ++k) {
    Lane difference[Dim];
    for (int i = 0; i < Dim; ++i) {
      difference[i] = entries.field(field + i * stride, k) - own[i];
    }
    for (int c = 0; c < Count; ++c) {
      const Lane w = entries.template weight<Count>(k, c);
      for (int i = 0; i < Dim; ++i) sum[c][i] += w * difference[i];
    }
  }
  for (int c = 0; c < Count; ++c) {
    for (int i = 0; i < Dim; ++i) {
      store<Entries::width>(moments + (c * Dim + i) * moment_stride, sum[c][i], count);
    }
  }
}

template <int Dim, bool Pair, bool Second, class Entries>
FPM_INLINE void scatter_rows(const Entries& entries, Index width, Index base, Index count,
                             const double* stress, const double* v, const double* x,
                             std::ptrdiff_t stride, double* force) {
  using Lane = Lanes<Entries::width>;
  constexpr Channels channels{Pair, Second};
  constexpr int count_of_weights = channels.count(Dim);
  constexpr int pair = Dim * Dim;  // first stress entry of the pairs, then that of the sub-points
  constexpr int second = pair + (Pair ? 1 + Dim + 2 * Dim * Dim : 0);
  // A sum of its own for each kind of stress, as an addition must wait for the one before it.
  Lane gradient[Dim] = {};
  Lane constant[Dim] = {};
  Lane affine[Dim] = {};
  Lane bent[Dim] = {};
  Lane stiffness = {};
  Lane rotation[Dim][Dim] = {};
  for (Index k = 0; k < width; ++k) {
    const auto entry = [&](int e) __attribute__((always_inline)) {
      return entries.field(stress + e * stride, k);
    };
    const auto weight = [&](int c) __attribute__((always_inline)) {
      return entries.template weight<count_of_weights>(k, c);
    };
    for (int j = 0; j < Dim; ++j) {
      const Lane w = weight(j);
      for (int i = 0; i < Dim; ++i) gradient[i] += w * entry(j * Dim + i);
    }
    if constexpr (Pair) {
      const Lane kappa = weight(channels.kappa(Dim));
      stiffness += kappa * entry(pair);
      for (int i = 0; i < Dim; ++i) {
        constant[i] += kappa * entry(pair + 1 + i);
        for (int j = 0; j < Dim; ++j) {
          rotation[i][j] += kappa * entry(pair + 1 + Dim + i * Dim + j);
        }
      }
      for (int j = 0; j < Dim; ++j) {
        const Lane w = weight(channels.kappa_x(Dim) + j);
        for (int i = 0; i < Dim; ++i) {
          affine[i] += w * entry(pair + 1 + Dim + Dim * Dim + i * Dim + j);
        }
      }
    }
    if constexpr (Second) {
      for (int c = 0; c < second_gradient_size<Dim>; ++c) {
        const Lane w = weight(channels.second_gradient(Dim) + c);
        for (int i = 0; i < Dim; ++i) bent[i] += w * entry(second + c * Dim + i);
      }
    }
  }
  for (int i = 0; i < Dim; ++i) {
    Lane sum = gradient[i];
    if constexpr (Pair) {
      sum += constant[i] - affine[i] + stiffness * load<Entries::width>(v + i * stride + base);
      for (int j = 0; j < Dim; ++j) {
        sum += rotation[i][j] * load<Entries::width>(x + j * stride + base);
      }
    }
    if constexpr (Second) sum += bent[i];
    store<Entries::width>(force + i * stride + base, sum, count);
  }
}

// Calls work(entries, width, base, count) for every register of rows; `Width` is that of rows which
// share a stencil.
template <int Width, class Work>
FPM_INLINE void for_each_register(const KernelRows& rows, const Work& work) {
  for (const Segment* s = rows.begin; s != rows.end; ++s) {
    const Index* ids = rows.ids + s->id_begin;
    const double* weights = rows.weights + s->weight_begin;
    if (s->kind == SegmentedRows::Kind::own) {
      work(OwnEntries{ids, weights}, s->width, s->first, s->count);
      continue;
    }
    if (s->kind == SegmentedRows::Kind::aligned) {
      work(AlignedEntries{ids, weights}, s->width, s->first, s->count);
      continue;
    }
    Index r = 0;
    for (; r + own_width < s->count; r += Width) {
      const Index base = s->first + r;
      work(SharedEntries<Width>{ids, weights, base}, s->width, base, s->count - r);
    }
    for (; r < s->count; r += own_width) {
      const Index base = s->first + r;
      work(SharedEntries<own_width>{ids, weights, base}, s->width, base, s->count - r);
    }
  }
}

template <int Width, int Dim, bool Pair, bool Second>
FPM_INLINE void gather_segments(const KernelRows& rows, const double* field, std::ptrdiff_t stride,
                                Index block_first, double* moments, std::ptrdiff_t moment_stride) {
  for_each_register<Width>(
      rows, [&](const auto& entries, Index width, Index base, Index count)
                __attribute__((always_inline)) {
                  gather_rows<Dim, Channels{Pair, Second}.count(Dim)>(
                      entries, width, base, count, field, stride, moments + (base - block_first),
                      moment_stride);
                });
}

template <int Width, int Dim, bool Pair, bool Second>
FPM_INLINE void scatter_segments(const KernelRows& rows, const double* stress, const double* v,
                                 const double* x, std::ptrdiff_t stride, double* force) {
  for_each_register<Width>(
      rows, [&](const auto& entries, Index width, Index base,
                Index count) __attribute__((always_inline)) {
        scatter_rows<Dim, Pair, Second>(entries, width, base, count, stress, v, x, stride, force);
      });
}

// A pair of kernels of each kind for one instruction set.
#define FPM_KERNELS(set, attribute, width)                                                         \
  template <int Dim, bool Pair, bool Second>                                                       \
  attribute void gather_##set(const KernelRows& rows, const double* field, std::ptrdiff_t stride,  \
                              Index first, double* moments, std::ptrdiff_t moment_stride) {        \
    gather_segments<width, Dim, Pair, Second>(rows, field, stride, first, moments, moment_stride); \
  }                                                                                                \
  template <int Dim, bool Pair, bool Second>                                                       \
  attribute void scatter_##set(const KernelRows& rows, const double* stress, const double* v,      \
                               const double* x, std::ptrdiff_t stride, double* force) {            \
    scatter_segments<width, Dim, Pair, Second>(rows, stress, v, x, stride, force);                 \
  }

FPM_KERNELS(narrow, , 4)
#ifdef FPM_WIDE_KERNELS
FPM_KERNELS(avx2, __attribute__((target("arch=x86-64-v3"))), 4)
FPM_KERNELS(avx512, __attribute__((target("arch=x86-64-v4"))), 8)
#endif

template <int Dim, bool Pair, bool Second>
Kernels kernels_of(InstructionSet set) {
#ifdef FPM_WIDE_KERNELS
  if (set == InstructionSet::avx512) {
    return {gather_avx512<Dim, Pair, Second>, scatter_avx512<Dim, Pair, Second>};
  }
  if (set == InstructionSet::avx2) {
    return {gather_avx2<Dim, Pair, Second>, scatter_avx2<Dim, Pair, Second>};
  }
#endif
  (void)set;
  return {gather_narrow<Dim, Pair, Second>, scatter_narrow<Dim, Pair, Second>};
}

}  // namespace

InstructionSet widest_instruction_set() {
#ifdef FPM_WIDE_KERNELS
  if (__builtin_cpu_supports("x86-64-v4")) return InstructionSet::avx512;
  if (__builtin_cpu_supports("x86-64-v3")) return InstructionSet::avx2;
#endif
  return InstructionSet::narrow;
}

template <int Dim>
Kernels kernels(Channels channels, InstructionSet set) {
  if (channels.pair) {
    return channels.second ? kernels_of<Dim, true, true>(set) : kernels_of<Dim, true, false>(set);
  }
  return channels.second ? kernels_of<Dim, false, true>(set) : kernels_of<Dim, false, false>(set);
}

template Kernels kernels<2>(Channels channels, InstructionSet set);
template Kernels kernels<3>(Channels channels, InstructionSet set);

}  // namespace fpm::detail
