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
  bool hands_out = false;    ///< the last solve was of a method whose pairs are changes of F
  bool needs_setup = false;  ///< loaded: the preconditioner must be set up at work.setup_point
};

namespace detail {

/// Whether the pairs of the multisecant are changes of F, as far as options tell.
[[nodiscard]] inline bool pairs_are_of_residual(const Options& options) {
  return options.method != Method::newton_krylov && !options.multisecant.preconditioned_norm;
}

/// Allocates for n of `global` unknowns and forgets the secant pairs.
void resize(Workspace& work, Eigen::Index n, Eigen::Index global, const Options& options,
            bool preconditioned);

}  // namespace detail
}  // namespace jfnk
