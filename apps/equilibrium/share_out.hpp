#pragma once

#include "jfnk/vector_operations.hpp"

namespace equilibrium {

/// Calls work(block) for all blocks of n rows, on the threads of OpenMP: what a residual brings
/// along for libjfnk. The bits are those of one thread, for any number.
/// @param numbers  that are read or written in all: few are not worth the threads' meeting
/// @param particles  of which vectors hold one component after the other
void share_out(Eigen::Index n, Eigen::Index numbers, Eigen::Index particles, jfnk::BlockWork work);

}  // namespace equilibrium
