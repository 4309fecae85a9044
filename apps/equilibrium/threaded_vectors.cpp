#include "equilibrium/threaded_vectors.hpp"

#include <omp.h>

#include <algorithm>

namespace equilibrium {
namespace {

// So many columns are summed at a time.
constexpr std::size_t strip = 32;

// What threads share out must be worth their meeting: some 10 us, in which one thread alone reads
// so many numbers.
constexpr Eigen::Index least_work = 40000;

// Calls work(block) for all blocks of n rows, each on the thread that the particles of its middle
// are worked on elsewhere: what one processor has written another reads at many times the cost.
template <class Work>
void share_out(Eigen::Index n, std::size_t columns, Eigen::Index particles, Work&& work) {
  const Eigen::Index blocks = jfnk::blocks_of(n);
  if (static_cast<Eigen::Index>(columns) * n < least_work) {
    for (Eigen::Index block = 0; block < blocks; ++block) work(block);
    return;
  }
#pragma omp parallel
  {
    const Eigen::Index threads = omp_get_num_threads();
    const Eigen::Index own = omp_get_thread_num();
    for (Eigen::Index block = 0; block < blocks; ++block) {
      const Eigen::Index begin = block * jfnk::rows_per_block;
      const Eigen::Index middle = (begin + std::min(begin + jfnk::rows_per_block, n)) / 2;
      if (middle % particles * threads / particles == own) work(block);
    }
  }
}

}  // namespace

double ThreadedVectors::dot(const jfnk::Vector& a, const jfnk::Vector& b) const {
  double sum = 0.0;
  const jfnk::Vector* const one = &a;
  dots({&one, 1}, b, {&sum, 1});
  return sum;
}

template <class Columns>
void ThreadedVectors::dots_of(Columns columns, const jfnk::Vector& w,
                              std::span<double> sums) const {
  const Eigen::Index blocks = jfnk::blocks_of(w.size());
  const auto size = static_cast<std::size_t>(blocks) * strip;
  if (block_sums_.size() < size) block_sums_.resize(size);
  for (std::size_t begin = 0; begin < columns.size(); begin += strip) {
    const std::size_t count = std::min(strip, columns.size() - begin);
    const Columns some = columns.subspan(begin, count);
    double* const parts = block_sums_.data();
    share_out(w.size(), count, particles_, [&](Eigen::Index block) {
      jfnk::dots_of_block(block, some, w, {parts + static_cast<std::size_t>(block) * strip, count});
    });
    std::fill_n(sums.begin() + static_cast<std::ptrdiff_t>(begin), count, 0.0);
    for (Eigen::Index block = 0; block < blocks; ++block) {
      const double* const part = parts + static_cast<std::size_t>(block) * strip;
      for (std::size_t j = 0; j < count; ++j) sums[begin + j] += part[j];
    }
  }
}

void ThreadedVectors::dots(jfnk::Vectors columns, const jfnk::Vector& w,
                           std::span<double> sums) const {
  dots_of(columns, w, sums);
}

void ThreadedVectors::dots(jfnk::SingleVectors columns, const jfnk::Vector& w,
                           std::span<double> sums) const {
  dots_of(columns, w, sums);
}

void ThreadedVectors::combine(double own, jfnk::Vectors columns, std::span<const double> factors,
                              jfnk::Vector& w) const {
  share_out(w.size(), columns.size(), particles_,
            [&](Eigen::Index block) { jfnk::combine_block(block, own, columns, factors, w); });
}

void ThreadedVectors::combine(double own, jfnk::SingleVectors columns,
                              std::span<const double> factors, jfnk::Vector& w) const {
  share_out(w.size(), columns.size(), particles_,
            [&](Eigen::Index block) { jfnk::combine_block(block, own, columns, factors, w); });
}

}  // namespace equilibrium
