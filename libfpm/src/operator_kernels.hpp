#pragma once

#include "fpm/moment_operator.hpp"

// The two hot loops, compiled for several instruction sets and chosen at run time.
namespace fpm::detail {

/// What a kernel needs of the rows it works on.
struct KernelRows {
  const SegmentedRows::Segment* begin;
  const SegmentedRows::Segment* end;
  const Index* ids;
  const double* weights;
};

/// Moments of the segments into a block buffer whose row 0 is `block_first`.
using GatherKernel = void (*)(const KernelRows& rows, const double* field, std::ptrdiff_t stride,
                              Index block_first, double* moments, std::ptrdiff_t moment_stride);

/// Forces of the segments' nodes from stresses.
using ScatterKernel = void (*)(const KernelRows& rows, const double* stress, const double* v,
                               const double* x, std::ptrdiff_t stride, double* force);

struct Kernels {
  GatherKernel gather = nullptr;
  ScatterKernel scatter = nullptr;
};

/// What kernels are compiled for; `narrow` is whatever the compiler's options allow.
enum class InstructionSet { narrow, avx2, avx512 };

/// The widest that this processor and this build have.
InstructionSet widest_instruction_set();

/// The kernels of some channels.
template <int Dim>
Kernels kernels(Channels channels, InstructionSet set = widest_instruction_set());

}  // namespace fpm::detail
