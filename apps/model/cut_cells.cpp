#include "model/cut_cells.hpp"

#include <algorithm>
#include <array>

namespace model {
namespace {

constexpr int any_region = -1;

}  // namespace

CutCells::CutCells(const shape::Body& body, const fpm::Cells<2>& cells) : cells_(cells) {
  constexpr double nothing = 1e-9;
  for (fpm::Index a = 0; a < cells.size(); ++a) {
    const double cell = cells.width(a) * cells.width(a);
    std::vector<Share>& shares = shares_.emplace_back();
    for (int r = 0; r < body.regions(); ++r) {
      const shape::Part part = body.within(cells.lower(a), cells.upper(a), r);
      if (part.area > nothing * cell) shares.push_back({r, part});
    }
    std::ranges::stable_sort(shares, std::ranges::greater(),
                             [](const Share& share) { return share.part.area; });
  }
  for (fpm::Index a = 0; a < cells.size(); ++a) {
    for (Share& share : shares_[static_cast<std::size_t>(a)]) {
      const bool own = stands(a) && &share == &shares_[static_cast<std::size_t>(a)].front();
      share.owner = own ? a : heir(a, share.region);
      if (share.owner < 0) share.owner = stands(a) ? a : heir(a, any_region);
    }
  }
}

bool CutCells::stands(fpm::Index cell) const {
  // Less than this of a cell is no particle: its row would be close to singular.
  constexpr double fewest = 0.3;
  const std::vector<Share>& shares = shares_[static_cast<std::size_t>(cell)];
  const double whole = cells_.width(cell) * cells_.width(cell);
  return !shares.empty() && shares.front().part.area >= fewest * whole;
}

// The cell beside another that takes over what a region has of it: the one with most left.
fpm::Index CutCells::heir(fpm::Index cell, int region) const {
  fpm::Index best = -1;
  double most = 0.0;
  const fpm::Index steps = cells_.steps(cell);
  const std::array<fpm::Index, 3> ways{-1, 0, steps};
  for (const fpm::Index dx : ways) {
    for (const fpm::Index dy : ways) {
      const fpm::Index b = cells_.holding(cells_.place(cell) + fpm::Cells<2>::Place(dx, dy));
      if (b < 0 || b == cell || !stands(b)) continue;
      const Share& share = shares_[static_cast<std::size_t>(b)].front();
      if ((region != any_region && share.region != region) || share.part.area <= most) continue;
      most = share.part.area;
      best = b;
    }
  }
  return best;
}

fpm::Cells<2> CutCells::standing(const std::vector<char>& present) const {
  std::vector<fpm::Index> owner;
  for (const std::vector<Share>& shares : shares_) {
    const fpm::Index by = shares.empty() ? -1 : shares.front().owner;
    const bool is_there =
        by >= 0 &&
        present[static_cast<std::size_t>(shares_[static_cast<std::size_t>(by)].front().region)] !=
            0;
    owner.push_back(is_there ? by : -1);
  }
  return cells_.restricted(owner);
}

fpm::Index CutCells::particle_at(const shape::Point& place, int region,
                                 const fpm::Cells<2>& standing) const {
  const fpm::Index cell = cells_.containing(place);
  if (cell < 0) return -1;
  for (const Share& share : shares_[static_cast<std::size_t>(cell)]) {
    if (share.region == region && share.owner >= 0) {
      return standing.holding(cells_.place(share.owner));
    }
  }
  return -1;
}

std::vector<int> CutCells::regions(const fpm::Cells<2>& standing) const {
  std::vector<int> region(static_cast<std::size_t>(standing.size()), 0);
  for (std::size_t a = 0; a < shares_.size(); ++a) {
    if (shares_[a].empty() || shares_[a].front().owner != static_cast<fpm::Index>(a)) continue;
    const auto b = standing.holding(cells_.place(static_cast<fpm::Index>(a)));
    if (b < 0) continue;
    region[static_cast<std::size_t>(b)] = shares_[a].front().region;
  }
  return region;
}

}  // namespace model
