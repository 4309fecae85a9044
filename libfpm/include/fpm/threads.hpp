#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>

#ifdef _OPENMP
#include <omp.h>
#endif

/// How loops are shared out to the threads of OpenMP.
namespace fpm {
namespace detail {

/// Deals blocks 0 .. count - 1 out to the threads of a team.
///
/// Two neighbours share a range. One takes blocks from its lower end, the other from its upper,
/// until they meet: both are done at once whatever a block costs and whichever of them is put off,
/// and yet all blocks but those around the meeting stay with one thread from loop to loop, and what
/// they read and write with one processor. Between pairs of neighbours nothing is evened out.
template <class Index>
class BlockDealer {
 public:
  static constexpr int most_threads = 128;

  BlockDealer(Index count, int threads) {
    const auto end_of = [&](int thread) {
      return static_cast<Index>(static_cast<std::ptrdiff_t>(count) * thread / threads);
    };
    for (int first = 0; first < threads; first += 2) {
      Range& range = ranges_[static_cast<std::size_t>(first / 2)];
      range.begin = end_of(first);
      range.count = end_of(std::min(first + 2, threads)) - range.begin;
    }
  }

  /// Calls work(block) for the blocks that a thread gets.
  template <class Work>
  void deal(int thread, const Work& work) {
    Range& range = ranges_[static_cast<std::size_t>(thread / 2)];
    const bool upwards = thread % 2 == 0;
    for (Index own = 0; range.taken.fetch_add(1, std::memory_order_relaxed) < range.count; ++own) {
      work(upwards ? range.begin + own : range.begin + range.count - 1 - own);
    }
  }

 private:
  struct alignas(64) Range {  // a cache line each, as threads write there
    std::atomic<Index> taken{0};
    Index begin = 0;
    Index count = 0;
  };
  std::array<Range, most_threads / 2> ranges_;
};

}  // namespace detail

/// Calls work(block) once for each block 0 .. count - 1, in any order, from all threads or the
/// first 128. To be called from one thread; `work` must not throw.
template <class Index, class Work>
void for_each_block(Index count, const Work& work) {
#ifdef _OPENMP
  using Dealer = detail::BlockDealer<Index>;
  const int threads = std::clamp(omp_get_max_threads(), 1, Dealer::most_threads);
  if (threads > 1 && count > 1) {
    Dealer dealer(count, threads);
    int team = threads;
#pragma omp parallel num_threads(threads)
    {
      const int own = omp_get_thread_num();
      if (own == 0) team = omp_get_num_threads();
      dealer.deal(own, work);
    }
    // Of threads that there were none left for.
    for (int absent = team; absent < threads; ++absent) dealer.deal(absent, work);
    return;
  }
#endif
  for (Index block = 0; block < count; ++block) work(block);
}

/// Calls work(row) once for each row 0 .. count - 1, likewise, `per_block` of them one after the
/// other: enough for some microseconds of work.
template <class Index, class Work>
void for_each_row(Index count, Index per_block, const Work& work) {
  for_each_block((count + per_block - 1) / per_block, [&](Index block) {
    const Index end = std::min(count, (block + 1) * per_block);
    for (Index row = block * per_block; row < end; ++row) work(row);
  });
}

}  // namespace fpm
