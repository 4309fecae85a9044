#pragma once

#include <memory>
#include <vector>

#include "fpm/types.hpp"

namespace fpm {

/// Fixed-radius neighbour search in a fixed cloud of points (FLANN's k-d tree).
///
/// FLANN compares in single precision and in no particular order, so the tree is asked for a
/// slightly wider ball, the answer is filtered in double precision and sorted by index: the result
/// depends on the points alone.
template <int Dim>
class NeighbourSearch {
 public:
  /// Builds the tree; the points are copied. Cost O(n log n).
  explicit NeighbourSearch(const Field<Dim>& points);
  ~NeighbourSearch();
  NeighbourSearch(NeighbourSearch&&) noexcept;
  NeighbourSearch& operator=(NeighbourSearch&&) noexcept;

  /// All points strictly closer than `radius` to `centre`, in ascending order of index.
  /// Safe to call from several threads at once, each with its own `found`.
  void within(const Vector<Dim>& centre, double radius, std::vector<Index>& found) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace fpm
