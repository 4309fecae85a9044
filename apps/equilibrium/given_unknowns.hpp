#pragma once

#include <Eigen/Core>
#include <vector>

namespace equilibrium {

/// The unknowns that are prescribed, ascending: few, where a pass over all of them would be long.
inline std::vector<Eigen::Index> given_unknowns(const std::vector<char>& prescribed) {
  std::vector<Eigen::Index> given;
  for (std::size_t k = 0; k < prescribed.size(); ++k) {
    if (prescribed[k] != 0) given.push_back(static_cast<Eigen::Index>(k));
  }
  return given;
}

}  // namespace equilibrium
