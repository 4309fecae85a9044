#include "equilibrium/share_out.hpp"

#include <omp.h>

namespace equilibrium {

void share_out(Eigen::Index n, Eigen::Index numbers, Eigen::Index particles, jfnk::BlockWork work) {
  // The threads' meeting takes some 10 us, in which one alone reads so many numbers.
  constexpr Eigen::Index least_work = 40000;
  const Eigen::Index blocks = jfnk::blocks_of(n);
  if (numbers < least_work) {
    for (Eigen::Index block = 0; block < blocks; ++block) work(block);
    return;
  }
  // Each block on the thread that the particles of its middle are worked on elsewhere: what one
  // processor has written another reads at many times the cost.
#pragma omp parallel
  {
    const Eigen::Index threads = omp_get_num_threads();
    const Eigen::Index own = omp_get_thread_num();
    for (Eigen::Index block = 0; block < blocks; ++block) {
      const jfnk::Rows rows = jfnk::rows_of(block, n);
      const Eigen::Index middle = rows.begin + rows.count / 2;
      if (middle % particles * threads / particles == own) work(block);
    }
  }
}

}  // namespace equilibrium
