#include "lattice_pattern.hpp"

#include <algorithm>
#include <cstdlib>

namespace jfnk::detail {

void LatticePattern::reset(Eigen::Index n) {
  n_ = n;
  width_ = 0;
  diagonals_.assign(1, 0);
}

Eigen::Index LatticePattern::way(Eigen::Index offset) const {
  return std::min(std::abs(offset), n_ - std::abs(offset));
}

LatticePattern::Column LatticePattern::read(Eigen::Index j, const Vector& product,
                                            Eigen::Index half) const {
  Column column{j, {}};
  const bool everywhere = 2 * half + 1 >= n_;
  const Eigen::Index begin = everywhere ? 0 : j - half;
  const Eigen::Index end = everywhere ? n_ : j + half + 1;
  for (Eigen::Index k = begin; k < end; ++k) {
    const Eigen::Index i = k < 0 ? k + n_ : (k < n_ ? k : k - n_);
    if (product[i] != 0.0) column.offsets.push_back(i - j);
  }
  return column;
}

Eigen::Index LatticePattern::width(const Column& column) const {
  Eigen::Index longest = 0;
  for (const Eigen::Index offset : column.offsets) longest = std::max(longest, way(offset));
  return longest;
}

bool LatticePattern::learn(const Column& column) {
  widen(width(column));
  const std::size_t known = diagonals_.size();
  for (const Eigen::Index offset : column.offsets) {
    for (const Eigen::Index diagonal : {offset, -offset}) {
      const auto place = std::lower_bound(diagonals_.begin(), diagonals_.end(), diagonal);
      if (place == diagonals_.end() || *place != diagonal) diagonals_.insert(place, diagonal);
    }
  }
  return diagonals_.size() > known;
}

void LatticePattern::widen(Eigen::Index width) {
  width_ = std::max(width_, width);
}

Eigen::SparseMatrix<double> LatticePattern::matrix() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(n_) * diagonals_.size());
  for (Eigen::Index column = 0; column < n_; ++column) {
    for (const Eigen::Index diagonal : diagonals_) {
      const Eigen::Index row = column + diagonal;
      if (row >= 0 && row < n_) entries.emplace_back(row, column, 0.0);
    }
  }
  Eigen::SparseMatrix<double> matrix(n_, n_);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace jfnk::detail
