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
  [[nodiscard]] fpm::Index heir(fpm::Index cell, int region) const;

  const fpm::Cells<2>& cells_;
  std::vector<std::vector<Share>> shares_;  // of each cell, the largest first
};

}  // namespace model
