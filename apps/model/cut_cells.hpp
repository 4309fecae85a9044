#pragma once

#include <vector>

#include "fpm/cells.hpp"
#include "shape/body.hpp"

namespace model {

/// What a body leaves of the cells of a tree, and who stands for it. A cell is of the region that
/// has most of it, if that is enough for a particle; what other regions have of it goes to a cell
/// of theirs beside it.
class CutCells {
 public:
  CutCells(const shape::Body& body, const fpm::Cells<2>& cells);

  /// Cells with a particle, what each stands for together: `Cells::restricted`.
  /// @param present  of each region, whether it is there
  [[nodiscard]] fpm::Cells<2> standing(const std::vector<char>& present) const;
  /// The particle, by its number among those of `standing`, of a region's share of the cell that
  /// holds a point; -1 for none.
  [[nodiscard]] fpm::Index particle_at(const shape::Point& place, int region,
                                       const fpm::Cells<2>& standing) const;
  /// Region of each particle.
  [[nodiscard]] std::vector<int> regions(const fpm::Cells<2>& standing) const;

  /// Calls visit(one, other, axis, region, particle of one, of other) for every two cells that meet
  /// across an axis, one below the other, and share a region that, of at least one of them, goes to
  /// another cell's particle.
  template <class Visitor>
  void for_each_handed_over(const fpm::Cells<2>& standing, Visitor&& visit) const {
    const auto particle = [&](const Share& share) {
      return share.owner < 0 ? -1 : standing.holding(cells_.place(share.owner));
    };
    cells_.for_each_pair([&](fpm::Index a, fpm::Index b, int axis) {
      for (const Share& one : shares_[static_cast<std::size_t>(a)]) {
        for (const Share& other : shares_[static_cast<std::size_t>(b)]) {
          if (one.region != other.region || (is_own(one, a) && is_own(other, b))) continue;
          const fpm::Index first = particle(one), second = particle(other);
          if (first >= 0 && second >= 0 && first != second) {
            visit(a, b, axis, one.region, first, second);
          }
        }
      }
    });
  }

  /// Calls visit(particle, area, centroid) for every share.
  template <class Visitor>
  void for_each_share(const fpm::Cells<2>& standing, Visitor&& visit) const {
    for (const std::vector<Share>& shares : shares_) {
      for (const Share& share : shares) {
        if (share.owner < 0) continue;
        const fpm::Index particle = standing.holding(cells_.place(share.owner));
        if (particle >= 0) visit(particle, share.part.area, share.part.centroid);
      }
    }
  }

 private:
  struct Share {
    int region = 0;
    shape::Part part;
    fpm::Index owner = -1;  // cell
  };
  [[nodiscard]] bool stands(fpm::Index cell) const;
  // Whether a cell's particle is that of the share's own region.
  [[nodiscard]] bool is_own(const Share& share, fpm::Index cell) const {
    return share.owner == cell && &share == &shares_[static_cast<std::size_t>(cell)].front();
  }
  [[nodiscard]] fpm::Index heir(fpm::Index cell, int region) const;

  const fpm::Cells<2>& cells_;
  std::vector<std::vector<Share>> shares_;  // of each cell, the largest first
};

}  // namespace model
