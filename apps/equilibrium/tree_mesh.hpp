#pragma once

#include <Eigen/SparseCore>
#include <vector>

#include "equilibrium/grid_element.hpp"
#include "fpm/cells.hpp"
#include "fpm/ghosts.hpp"

namespace equilibrium {

/// Elements that are the cells of a balanced tree. A node in the middle of an edge or face of a
/// wider element hangs: its displacement is the mean of those of the edge's or face's corners.
template <int Dim>
class TreeMesh {
 public:
  explicit TreeMesh(fpm::Cells<Dim> cells);

  fpm::Index nodes() const { return static_cast<fpm::Index>(place_.size()); }
  /// Nodes that have unknowns: the first ones.
  fpm::Index free_nodes() const { return nodes() - static_cast<fpm::Index>(parents_.size()); }

  /// [m] Place of a node.
  fpm::Vector<Dim> place(fpm::Index node) const {
    const auto& lattice = cells_.lattice();
    return lattice.min +
           lattice.spacing * place_[static_cast<std::size_t>(node)].template cast<double>();
  }

  /// Where a place is; of one outside the box, in the nearest element.
  GridPoint<Dim> at(const Eigen::Matrix<double, 1, Dim>& place) const;

  bool is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const;

  /// Calls visit(point, share of the volume) where a particle is integrated: at itself, or around
  /// it if it is alone in its element, which one point would leave without stiffness in bending.
  template <class Visitor>
  void for_each_quadrature_point(const GridPoint<Dim>& own,
                                 const Eigen::Matrix<double, 1, Dim>& place, double spacing,
                                 Visitor&& visit) const;

  /// Sums the blocks of pairs of nodes, element by element.
  class Stiffness {
   public:
    explicit Stiffness(const TreeMesh& mesh);
    void add(const GridPoint<Dim>& point, int p, int q, const fpm::Tensor<Dim>& block);
    std::vector<Eigen::Triplet<double>> entries() const;

   private:
    static constexpr int size = GridPoint<Dim>::corners * Dim;
    const TreeMesh& mesh_;
    Eigen::MatrixXd elements_;  // one column each
  };

  /// Turns entries of all nodes into those of the free ones.
  void eliminate(std::vector<Eigen::Triplet<double>>& entries) const;

  /// Calls visit(hanging node, parent, share).
  template <class Visitor>
  void for_each_dependence(Visitor&& visit) const {
    for (std::size_t k = 0; k < parents_.size(); ++k) {
      for (const fpm::Index parent : parents_[k]) {
        visit(free_nodes() + static_cast<fpm::Index>(k), parent,
              1.0 / static_cast<double>(parents_[k].size()));
      }
    }
  }

 private:
  using Place = typename fpm::Cells<Dim>::Place;
  std::vector<Place> corners_around(const Place& node) const;

  fpm::Cells<Dim> cells_;
  std::vector<Place> place_;  // of each node, in finest spacings
  Eigen::Matrix<fpm::Index, GridPoint<Dim>::corners, Eigen::Dynamic> element_nodes_;
  std::vector<std::vector<fpm::Index>> parents_;  // of the hanging nodes, which come last
};

template <int Dim>
template <class Visitor>
void TreeMesh<Dim>::for_each_quadrature_point(const GridPoint<Dim>& own,
                                              const Eigen::Matrix<double, 1, Dim>& place,
                                              double spacing, Visitor&& visit) const {
  constexpr double between_levels = 1.5;  // spacings; widths differ by factors of two
  if (cells_.width(own.element) > between_levels * spacing) {
    visit(own, 1.0);
    return;
  }
  constexpr int count = GridPoint<Dim>::corners;
  for (int k = 0; k < count; ++k) {
    Eigen::Matrix<double, 1, Dim> around = place;
    for (int i = 0; i < Dim; ++i) around[i] += (((k >> i) & 1) != 0 ? 0.25 : -0.25) * spacing;
    visit(at(around), 1.0 / count);
  }
}

}  // namespace equilibrium
