#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "fpm/types.hpp"

namespace fpm::detail {

/// A cell of a tree: its lower corner in finest spacings and its width, 2^level of them.
template <int Dim>
struct TreeCell {
  Eigen::Matrix<Index, Dim, 1> place;
  int level = 0;

  Index steps() const { return Index{1} << level; }
};

/// Most finest spacings along an axis that there is room for in a key.
template <int Dim>
inline constexpr int coordinate_bits = Dim == 2 ? 29 : 19;

/// One number for a cell.
template <int Dim>
std::uint64_t key_of(const Eigen::Matrix<Index, Dim, 1>& place, int level) {
  auto key = static_cast<std::uint64_t>(level);
  for (int i = 0; i < Dim; ++i) {
    key =
        (key << static_cast<unsigned>(coordinate_bits<Dim>)) | static_cast<std::uint64_t>(place[i]);
  }
  return key;
}

/// Lower corner of the cell of a level that holds a finest cell.
template <int Dim>
Eigen::Matrix<Index, Dim, 1> corner_at(const Eigen::Matrix<Index, Dim, 1>& finest, int level) {
  return finest.unaryExpr([level](Index x) { return (x >> level) << level; });
}

/// The cells of the coarsest balanced tree in a box that has no layer of one cell on wider ones,
/// sorted by level, then as in a lattice.
/// @param extent  of the box, in finest spacings
/// @param split  whether a cell inside the box, above the finest level, is too wide
template <int Dim>
std::vector<TreeCell<Dim>> balanced_tree(const Eigen::Matrix<Index, Dim, 1>& extent,
                                         const std::function<bool(const TreeCell<Dim>&)>& split);

}  // namespace fpm::detail
