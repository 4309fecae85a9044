#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <vector>

#include "equilibrium/grid_element.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// Equal elements that fill a box.
template <int Dim>
class BoxMesh {
 public:
  /// @param spacing  [m], rounded so that whole elements fill the box of the model
  BoxMesh(const model::Model<Dim>& model, double spacing);

  fpm::Index nodes() const { return nodes_; }
  /// Nodes that have unknowns: the first ones.
  fpm::Index free_nodes() const { return nodes_; }

  /// [m] Place of a node.
  fpm::Vector<Dim> place(fpm::Index node) const;

  /// Where a place is; of one outside the box, in the nearest element.
  GridPoint<Dim> at(const Eigen::Matrix<double, 1, Dim>& place) const;

  /// Whether a node belongs to a plane: it is the nearest to it.
  bool is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const;

  /// Calls visit(point, share of the volume) where a particle is integrated: at itself.
  template <class Visitor>
  void for_each_quadrature_point(const GridPoint<Dim>& own,
                                 const Eigen::Matrix<double, 1, Dim>& /*place*/, double /*spacing*/,
                                 Visitor&& visit) const {
    visit(own, 1.0);
  }

  /// Sums the blocks of pairs of nodes. A node meets its 3^Dim neighbours only: their blocks are
  /// summed in place, for a list of every particle's contributions would be the largest thing in
  /// memory.
  class Stiffness {
   public:
    explicit Stiffness(const BoxMesh& mesh)
        : mesh_(mesh), blocks_(Eigen::MatrixXd::Zero(slots * block_size, mesh.nodes_)) {}
    void add(const GridPoint<Dim>& point, int p, int q, const fpm::Tensor<Dim>& block);
    std::vector<Eigen::Triplet<double>> entries() const;

   private:
    static constexpr int block_size = Dim * Dim;
    static constexpr int slots = Dim == 2 ? 9 : 27;
    const BoxMesh& mesh_;
    Eigen::MatrixXd blocks_;
  };

  /// Nothing: no node depends on others.
  void eliminate(std::vector<Eigen::Triplet<double>>& /*entries*/) const {}
  template <class Visitor>
  void for_each_dependence(Visitor&& /*visit*/) const {}

 private:
  fpm::Vector<Dim> origin_, cell_;
  Eigen::Matrix<fpm::Index, Dim, 1> cells_;
  fpm::Index nodes_ = 0;
};

}  // namespace equilibrium
