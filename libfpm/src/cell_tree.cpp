#include "cell_tree.hpp"

#include <algorithm>
#include <unordered_map>

#include "places.hpp"

namespace fpm::detail {
namespace {

template <int Dim>
using Place = Eigen::Matrix<Index, Dim, 1>;

template <int Dim>
class TreeBuilder {
 public:
  using Cell = TreeCell<Dim>;

  explicit TreeBuilder(const Place<Dim>& extent) : extent_(extent) {
    while ((Index{2} << top_) <= extent.maxCoeff()) ++top_;
  }

  void refine(const std::function<bool(const Cell&)>& split) {
    const Place<Dim> roots =
        extent_.unaryExpr([this](Index x) -> Index { return ((x - 1) >> top_) + 1; });
    for_each_place<Dim>(roots, [&](const Place<Dim>& root) {
      refine(Cell{root * (Index{1} << top_), top_}, split);
    });
  }

  // What touches a cell less than half as wide is split, and what touches its parts then.
  void balance() {
    std::vector<Cell> queue = leaves();
    while (!queue.empty()) {
      const Cell cell = queue.back();
      queue.pop_back();
      if (!leaf_.contains(key_of<Dim>(cell.place, cell.level))) continue;  // split meanwhile
      for_each_place<Dim>(Place<Dim>::Constant(3), [&](const Place<Dim>& at) {
        Place<Dim> beside = cell.place;
        for (int i = 0; i < Dim; ++i) beside[i] += at[i] == 0 ? -1 : at[i] == 2 ? cell.steps() : 0;
        for (int level = level_at(beside); level > cell.level + 1; --level) {
          const Cell wide{corner_at<Dim>(beside, level), level};
          split(wide);
          for_each_child(wide, [&](const Cell& child) { queue.push_back(child); });
        }
      });
    }
  }

  // Cells come in pairs, but for those at an upper face of a box that is no whole number of wider
  // ones. A layer of one, on wider ones, would see too little across it: what is below is split.
  void thicken() {
    for (bool thin = true; thin;) {
      thin = false;
      for (const Cell& cell : leaves()) {
        for (int i = 0; i < Dim; ++i) {
          if (cell.place[i] + cell.steps() != extent_[i]) continue;
          Place<Dim> below = cell.place;
          below[i] -= 1;
          const int level = level_at(below);
          if (level <= cell.level) continue;
          split(Cell{corner_at<Dim>(below, level), level});
          thin = true;
        }
      }
      if (thin) balance();
    }
  }

  std::vector<Cell> leaves() const {
    std::vector<Cell> cells;
    cells.reserve(leaf_.size());
    for (const auto& [key, cell] : leaf_) cells.push_back(cell);
    const auto before = [](const Cell& a, const Cell& b) {
      if (a.level != b.level) return a.level < b.level;
      for (int i = Dim - 1; i > 0; --i) {
        if (a.place[i] != b.place[i]) return a.place[i] < b.place[i];
      }
      return a.place[0] < b.place[0];
    };
    std::sort(cells.begin(), cells.end(), before);
    return cells;
  }

 private:
  void insert(const Cell& cell) { leaf_.emplace(key_of<Dim>(cell.place, cell.level), cell); }

  void split(const Cell& cell) {
    leaf_.erase(key_of<Dim>(cell.place, cell.level));
    for_each_child(cell, [&](const Cell& child) { insert(child); });
  }

  template <class Visitor>
  static void for_each_child(const Cell& cell, Visitor&& visit) {
    for_each_place<Dim>(Place<Dim>::Constant(2), [&](const Place<Dim>& at) {
      visit(Cell{cell.place + at * (cell.steps() / 2), cell.level - 1});
    });
  }

  // What sticks out of the box is split until its parts are inside or outside.
  void refine(const Cell& cell, const std::function<bool(const Cell&)>& split) {
    if ((cell.place.array() >= extent_.array()).any()) return;
    const bool inside = ((cell.place.array() + cell.steps()) <= extent_.array()).all();
    if (cell.level == 0 || (inside && !split(cell))) {
      insert(cell);
    } else {
      for_each_child(cell, [&](const Cell& child) { refine(child, split); });
    }
  }

  // Of the leaf that holds a finest cell; -1 if it is part of none.
  int level_at(const Place<Dim>& finest) const {
    if ((finest.array() < 0).any() || (finest.array() >= extent_.array()).any()) return -1;
    for (int level = 0; level <= top_; ++level) {
      if (leaf_.contains(key_of<Dim>(corner_at<Dim>(finest, level), level))) return level;
    }
    return -1;
  }

  Place<Dim> extent_;
  int top_ = 0;
  std::unordered_map<std::uint64_t, Cell> leaf_;
};

}  // namespace

template <int Dim>
std::vector<TreeCell<Dim>> balanced_tree(const Eigen::Matrix<Index, Dim, 1>& extent,
                                         const std::function<bool(const TreeCell<Dim>&)>& split) {
  TreeBuilder<Dim> builder(extent);
  builder.refine(split);
  builder.balance();
  builder.thicken();
  return builder.leaves();
}

template std::vector<TreeCell<2>> balanced_tree<2>(const Eigen::Matrix<Index, 2, 1>&,
                                                   const std::function<bool(const TreeCell<2>&)>&);
template std::vector<TreeCell<3>> balanced_tree<3>(const Eigen::Matrix<Index, 3, 1>&,
                                                   const std::function<bool(const TreeCell<3>&)>&);

}  // namespace fpm::detail
