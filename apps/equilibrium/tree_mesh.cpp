#include "equilibrium/tree_mesh.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace equilibrium {
namespace {

// Places in the order of a lattice.
template <int Dim>
struct Before {
  bool operator()(const Eigen::Matrix<fpm::Index, Dim, 1>& a,
                  const Eigen::Matrix<fpm::Index, Dim, 1>& b) const {
    for (int i = Dim - 1; i > 0; --i) {
      if (a[i] != b[i]) return a[i] < b[i];
    }
    return a[0] < b[0];
  }
};

template <int Dim>
Eigen::Matrix<fpm::Index, Dim, 1> corner_of(const fpm::Cells<Dim>& cells, fpm::Index cell,
                                            int corner) {
  auto place = cells.place(cell);
  for (int i = 0; i < Dim; ++i) place[i] += ((corner >> i) & 1) * cells.steps(cell);
  return place;
}

}  // namespace

template <int Dim>
TreeMesh<Dim>::TreeMesh(fpm::Cells<Dim> cells) : cells_(std::move(cells)) {
  constexpr int corners = GridPoint<Dim>::corners;
  std::set<Place, Before<Dim>> places;
  for (fpm::Index e = 0; e < cells_.size(); ++e) {
    for (int c = 0; c < corners; ++c) places.insert(corner_of(cells_, e, c));
  }
  std::vector<Place> hanging;
  std::vector<std::vector<Place>> between;
  for (const Place& place : places) {
    auto around = corners_around(place);
    if (around.empty()) {
      place_.push_back(place);
    } else {
      hanging.push_back(place);
      between.push_back(std::move(around));
    }
  }
  place_.insert(place_.end(), hanging.begin(), hanging.end());
  std::map<Place, fpm::Index, Before<Dim>> number;
  for (std::size_t k = 0; k < place_.size(); ++k) number[place_[k]] = static_cast<fpm::Index>(k);
  element_nodes_.resize(corners, cells_.size());
  for (fpm::Index e = 0; e < cells_.size(); ++e) {
    for (int c = 0; c < corners; ++c) element_nodes_(c, e) = number.at(corner_of(cells_, e, c));
  }
  for (const auto& places_of_parents : between) {
    auto& parents = parents_.emplace_back();
    for (const Place& parent : places_of_parents) parents.push_back(number.at(parent));
  }
}

// The corners that a node is midway between, if it is no corner of every element around it. As
// elements that touch differ by a factor of two at most, these corners do not hang themselves.
template <int Dim>
std::vector<typename TreeMesh<Dim>::Place> TreeMesh<Dim>::corners_around(const Place& node) const {
  for (int k = 0; k < GridPoint<Dim>::corners; ++k) {
    Place finest = node;
    for (int i = 0; i < Dim; ++i) finest[i] -= (k >> i) & 1;
    const fpm::Index e = cells_.holding(finest);
    if (e < 0) continue;
    const Place low = cells_.place(e);
    const fpm::Index steps = cells_.steps(e);
    std::vector<Place> corners{node};
    for (int i = 0; i < Dim; ++i) {
      if (node[i] == low[i] || node[i] == low[i] + steps) continue;
      const std::size_t count = corners.size();
      for (std::size_t c = 0; c < count; ++c) {
        corners.push_back(corners[c]);
        corners[c][i] = low[i];
        corners.back()[i] = low[i] + steps;
      }
    }
    if (corners.size() > 1) return corners;
  }
  return {};
}

template <int Dim>
GridPoint<Dim> TreeMesh<Dim>::at(const Eigen::Matrix<double, 1, Dim>& place) const {
  GridPoint<Dim> point;
  point.element = cells_.containing(place.transpose());
  point.nodes = element_nodes_.col(point.element);
  const double width = cells_.width(point.element);
  const fpm::Vector<Dim> xi = (place.transpose() - cells_.lower(point.element)) / width;
  point.interpolate(xi, fpm::Vector<Dim>::Constant(width));
  return point;
}

template <int Dim>
bool TreeMesh<Dim>::is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const {
  const fpm::Vector<Dim> at = place(node);
  for (int i = 0; i < Dim; ++i) {
    const bool on = i == plane.axis
                        ? std::abs(at[i] - plane.position) < 0.5 * cells_.lattice().spacing
                        : at[i] >= plane.range_min[i] && at[i] <= plane.range_max[i];
    if (!on) return false;
  }
  return true;
}

template <int Dim>
TreeMesh<Dim>::Stiffness::Stiffness(const TreeMesh& mesh)
    : mesh_(mesh), elements_(Eigen::MatrixXd::Zero(size * size, mesh.element_nodes_.cols())) {}

template <int Dim>
void TreeMesh<Dim>::Stiffness::add(const GridPoint<Dim>& point, int p, int q,
                                   const fpm::Tensor<Dim>& block) {
  Eigen::Map<Eigen::Matrix<double, size, size>> element(elements_.col(point.element).data());
  element.template block<Dim, Dim>(p * Dim, q * Dim) += block;
}

template <int Dim>
std::vector<Eigen::Triplet<double>> TreeMesh<Dim>::Stiffness::entries() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(elements_.size()));
  for (Eigen::Index e = 0; e < elements_.cols(); ++e) {
    const auto nodes = mesh_.element_nodes_.col(e);
    for (int r = 0; r < size; ++r) {
      for (int c = 0; c < size; ++c) {
        const double value = elements_(c * size + r, e);
        if (value == 0.0) continue;
        entries.emplace_back(nodes[r / Dim] * Dim + r % Dim, nodes[c / Dim] * Dim + c % Dim, value);
      }
    }
  }
  return entries;
}

template <int Dim>
void TreeMesh<Dim>::eliminate(std::vector<Eigen::Triplet<double>>& entries) const {
  // The unknowns that stand for one, with their shares.
  const auto masters = [&](fpm::Index unknown) {
    const fpm::Index node = unknown / Dim;
    if (node < free_nodes()) return std::vector<fpm::Index>{unknown};
    std::vector<fpm::Index> unknowns;
    for (const fpm::Index parent : parents_[static_cast<std::size_t>(node - free_nodes())]) {
      unknowns.push_back(parent * Dim + unknown % Dim);
    }
    return unknowns;
  };
  std::vector<Eigen::Triplet<double>> free;
  free.reserve(entries.size());
  for (const auto& entry : entries) {
    const auto rows = masters(entry.row()), columns = masters(entry.col());
    const double share = entry.value() / static_cast<double>(rows.size() * columns.size());
    for (const fpm::Index row : rows) {
      for (const fpm::Index column : columns) free.emplace_back(row, column, share);
    }
  }
  entries = std::move(free);
}

template class TreeMesh<2>;
template class TreeMesh<3>;

}  // namespace equilibrium
