#pragma once

#include "strategy.hpp"

namespace jfnk {

/// All that a solver holds.
struct Solver::Memory {
  Options options;
  detail::Workspace work;
  detail::Course course;
  Report report;
  SecantPairs given;         ///< which the next solve begins with
  bool needs_setup = false;  ///< loaded: the preconditioner must be set up at work.setup_point
};

namespace detail {

/// Allocates for n of `global` unknowns and forgets the secant pairs.
void resize(Workspace& work, Eigen::Index n, Eigen::Index global, const Options& options,
            bool preconditioned);

}  // namespace detail
}  // namespace jfnk
