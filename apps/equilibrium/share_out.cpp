#include "equilibrium/share_out.hpp"

#include <algorithm>

#include "fpm/threads.hpp"

namespace equilibrium {

void share_out(Eigen::Index n, Eigen::Index numbers, Eigen::Index particles, jfnk::BlockWork work) {
  // The threads' meeting takes some 10 us, in which one alone reads so many numbers.
  constexpr Eigen::Index least_work = 40000;
  const Eigen::Index blocks = jfnk::blocks_of(n);
  if (numbers < least_work) {
    for (Eigen::Index block = 0; block < blocks; ++block) work(block);
    return;
  }
  // In the order of the particles, as all other loops: what one processor has written another reads
  // at many times the cost. Blocks beyond those of whole components come last.
  const Eigen::Index components = std::max<Eigen::Index>(n / particles, 1);
  const Eigen::Index of_each = blocks / components;
  fpm::for_each_block(blocks, [&](Eigen::Index k) {
    work(k < of_each * components ? k % components * of_each + k / components : k);
  });
}

}  // namespace equilibrium
