#pragma once

#include <utility>

#include "jfnk/jfnk.hpp"

namespace jfnk_test {

inline jfnk::Options without_learning() {
  jfnk::Options options;
  options.learning.enabled = false;
  return options;
}

template <class F, class P = jfnk::Identity>
jfnk::Report solve_from(F&& residual, jfnk::Vector u, const jfnk::Options& options,
                        P&& preconditioner = {}) {
  return jfnk::solve(residual, u, options, preconditioner);
}

}  // namespace jfnk_test
