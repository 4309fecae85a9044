#include "triad.hpp"

#include <omp.h>

// As the kernels beside it: the widest variant the processor has.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define FPM_BENCH_TARGET_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FPM_BENCH_TARGET_CLONES
#endif

namespace benchmarks {
namespace {

FPM_BENCH_TARGET_CLONES void triad_range(double* __restrict a, const double* __restrict b,
                                         const double* __restrict c, std::size_t count) {
  constexpr double s = 3.0;
  for (std::size_t k = 0; k < count; ++k) a[k] = b[k] + s * c[k];
}

// Calls work(first, count) with the share of each thread.
template <class Work>
void share_out(std::size_t size, Work&& work) {
#pragma omp parallel
  {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto thread = static_cast<std::size_t>(omp_get_thread_num());
    const std::size_t first = size * thread / threads;
    work(first, size * (thread + 1) / threads - first);
  }
}

}  // namespace

Triad::Triad(std::size_t elements)
    : size_(elements),
      a_(new double[elements]),
      b_(new double[elements]),
      c_(new double[elements]) {
  share_out(size_, [this](std::size_t first, std::size_t count) {
    for (std::size_t k = first; k < first + count; ++k) {
      a_[k] = 0.0;
      b_[k] = 1.0;
      c_[k] = 2.0;
    }
  });
}

void Triad::run() {
  share_out(size_, [this](std::size_t first, std::size_t count) {
    triad_range(a_.get() + first, b_.get() + first, c_.get() + first, count);
  });
}

}  // namespace benchmarks
