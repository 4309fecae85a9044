#include "fpm/cells.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "cell_tree.hpp"
#include "jitter.hpp"

namespace fpm {

template <int Dim>
Cells<Dim>::Cells(const LatticeOptions<Dim>& lattice)
    : lattice_(lattice), count_(lattice_cells(lattice)) {
  if (vertex()) count_.array() += 1;
}

template <int Dim>
Cells<Dim>::Cells(const LatticeOptions<Dim>& finest, const WantedSpacing<Dim>& wanted)
    : Cells(finest) {
  if (vertex())
    throw std::invalid_argument("the cells of a tree have their particles at the centre");
  constexpr Index most = Index{1} << detail::coordinate_bits<Dim>;
  if (count_.maxCoeff() >= most) {
    throw std::invalid_argument("the box is " + std::to_string(count_.maxCoeff()) +
                                " finest spacings wide; a tree has less than " +
                                std::to_string(most));
  }
  build([&](const detail::TreeCell<Dim>& cell) {
    constexpr double round_off = 1e-9;
    const double width = cell.steps() * lattice_.spacing;
    const Vector<Dim> low = lattice_.min + lattice_.spacing * cell.place.template cast<double>();
    return width > (1.0 + round_off) * wanted(low, low.array() + width);
  });
}

template <int Dim>
template <class Split>
void Cells<Dim>::build(Split&& split) {
  const auto leaves = detail::balanced_tree<Dim>(count_, split);
  graded_ = true;
  place_.reserve(leaves.size());
  level_.reserve(leaves.size());
  index_.reserve(leaves.size());
  for (const auto& leaf : leaves) {
    index_.emplace(detail::key_of<Dim>(leaf.place, leaf.level), static_cast<Index>(place_.size()));
    place_.push_back(leaf.place);
    level_.push_back(static_cast<std::int8_t>(leaf.level));
    top_level_ = std::max(top_level_, leaf.level);
  }
}

template <int Dim>
Cells<Dim> Cells<Dim>::coarsened(int levels) const {
  if (vertex()) throw std::invalid_argument("the cells of a vertex lattice have no tree");
  // Narrowest cell in each cell that is split.
  std::unordered_map<std::uint64_t, int> narrowest;
  for (Index a = 0; a < size(); ++a) {
    const Place at = place(a);
    const int own = graded_ ? level_[static_cast<std::size_t>(a)] : 0;
    for (int level = own + 1; level <= detail::coordinate_bits<Dim>; ++level) {
      const auto key = detail::key_of<Dim>(detail::corner_at<Dim>(at, level), level);
      const auto [known, is_new] = narrowest.try_emplace(key, own);
      if (!is_new && known->second <= own) break;  // and so are those around it
      known->second = own;
    }
  }
  Cells tree;
  tree.lattice_ = lattice_;
  tree.count_ = count_;
  tree.build([&](const detail::TreeCell<Dim>& cell) {
    const auto known = narrowest.find(detail::key_of<Dim>(cell.place, cell.level));
    return known != narrowest.end() && known->second + levels < cell.level;
  });
  return tree;
}

template <int Dim>
typename Cells<Dim>::Place Cells<Dim>::place(Index cell) const {
  if (graded_) return place_[static_cast<std::size_t>(cell)];
  Place at;
  for (int i = 0; i < Dim; ++i) {
    at[i] = cell % count_[i];
    cell /= count_[i];
  }
  return at;
}

template <int Dim>
Vector<Dim> Cells<Dim>::lower(Index cell) const {
  Vector<Dim> corner = place(cell).template cast<double>();
  if (vertex()) corner.array() -= 0.5;
  return lattice_.min.cwiseMax(lattice_.min + corner * lattice_.spacing);
}

template <int Dim>
Vector<Dim> Cells<Dim>::upper(Index cell) const {
  Vector<Dim> corner = place(cell).template cast<double>().array() + steps(cell);
  if (vertex()) corner.array() -= 0.5;
  return lattice_.max.cwiseMin(lattice_.min + corner * lattice_.spacing);
}

template <int Dim>
Vector<Dim> Cells<Dim>::site(Index cell) const {
  Vector<Dim> at = place(cell).template cast<double>();
  if (!vertex()) at.array() += 0.5 * steps(cell);
  return lattice_.min + at * lattice_.spacing;
}

template <int Dim>
Index Cells<Dim>::holding(const Place& finest) const {
  if ((finest.array() < 0).any() || (finest.array() >= count_.array()).any()) return -1;
  if (!graded_) {
    Index cell = 0;
    for (int i = Dim - 1; i >= 0; --i) cell = cell * count_[i] + finest[i];
    return cell;
  }
  for (int level = 0; level <= top_level_; ++level) {
    const auto known =
        index_.find(detail::key_of<Dim>(detail::corner_at<Dim>(finest, level), level));
    if (known != index_.end()) return known->second;
  }
  return -1;
}

template <int Dim>
Index Cells<Dim>::containing(const Vector<Dim>& point) const {
  Place finest;
  for (int i = 0; i < Dim; ++i) {
    const double steps = (point[i] - lattice_.min[i]) / lattice_.spacing + (vertex() ? 0.5 : 0.0);
    finest[i] = static_cast<Index>(std::clamp(std::floor(steps), 0.0, count_[i] - 1.0));
  }
  return holding(finest);
}

template <int Dim>
Index Cells<Dim>::beside(Index cell, int axis, bool upper) const {
  Place finest = place(cell);
  finest[axis] += upper ? steps(cell) : -1;
  return holding(finest);
}

template <int Dim>
ParticleSet<Dim> make_particles(const Cells<Dim>& cells) {
  const LatticeOptions<Dim>& lattice = cells.lattice();
  if (!cells.graded()) return make_lattice(lattice);
  detail::check_jitter(lattice.jitter);
  const Index n = cells.size();
  ParticleSet<Dim> set;
  set.position.resize(n, Dim);
  set.volume.resize(n);
  set.spacing.resize(n);
  std::uint64_t state = lattice.seed;
  for (Index a = 0; a < n; ++a) {
    const Index steps = cells.steps(a);
    const auto place = cells.place(a);
    for (int i = 0; i < Dim; ++i) {
      const double move = detail::uniform_minus_one_to_one(state) * lattice.jitter;
      // In the order of a lattice's: equal to the last bit.
      const double step = place[i] + 0.5 * steps + move * steps;
      set.position(a, i) = lattice.min[i] + step * lattice.spacing;
    }
    set.spacing[a] = cells.width(a);
    set.volume[a] = std::pow(set.spacing[a], Dim);
  }
  return set;
}

template class Cells<2>;
template class Cells<3>;
template ParticleSet<2> make_particles<2>(const Cells<2>&);
template ParticleSet<3> make_particles<3>(const Cells<3>&);

}  // namespace fpm
