#pragma once

#include "fpm/types.hpp"

namespace fpm::detail {

/// Calls visit(index per axis) for all combinations below `count`, first axis fastest.
template <int Dim, class Visitor>
void for_each_place(const Eigen::Matrix<Index, Dim, 1>& count, Visitor&& visit) {
  Eigen::Matrix<Index, Dim, 1> at = Eigen::Matrix<Index, Dim, 1>::Zero();
  const Index total = count.prod();
  for (Index k = 0; k < total; ++k) {
    visit(at);
    for (int i = 0; i < Dim; ++i) {
      if (++at[i] < count[i]) break;
      at[i] = 0;
    }
  }
}

}  // namespace fpm::detail
