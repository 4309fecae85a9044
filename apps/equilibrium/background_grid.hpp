#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "model/model.hpp"

namespace equilibrium {

/// The elastic body on a background grid of bilinear (trilinear) elements integrated at the
/// particles, factorised: the coarse level of the preconditioner. The grid of graded particles is
/// graded as they are.
template <int Dim>
class BackgroundGrid {
 public:
  /// No grid: `add_solution` must not be called.
  BackgroundGrid() = default;
  /// @param grid_over_spacing  width of an element over the spacing of the particles in it, rounded
  ///   so that whole elements fill the box, or down to a power of two, but 2, where they are graded
  /// @throws std::runtime_error if the factorisation fails (a body without support)
  BackgroundGrid(const model::Model<Dim>& model, double grid_over_spacing);

  bool empty() const { return free_nodes_ == 0; }

  /// z += P A_c^-1 P^T r, with r taken as 0 at prescribed unknowns; in single precision.
  void add_solution(const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  // A hanging node moves by shares of others' displacements.
  struct Dependence {
    fpm::Index node, parent;
    double share;
  };
  using FloatMatrix = Eigen::SparseMatrix<float>;
  template <class Mesh>
  void build(const model::Model<Dim>& model, const Mesh& mesh);
  template <class Mesh>
  std::vector<Eigen::Triplet<double>> grid_stiffness(const model::Model<Dim>& model,
                                                     const Mesh& mesh);
  Eigen::VectorXd node_moduli(const model::Model<Dim>& model, fpm::Index nodes) const;
  template <class Mesh>
  void add_grid_supports(const model::Model<Dim>& model, const Mesh& mesh,
                         std::vector<Eigen::Triplet<double>>& entries) const;

  std::vector<char> prescribed_;
  fpm::Index free_nodes_ = 0;
  std::vector<Dependence> dependences_;
  Eigen::Matrix<fpm::Index, 1 << Dim, Eigen::Dynamic> corner_;  // of each particle's cell
  Eigen::Matrix<float, 1 << Dim, Eigen::Dynamic> weight_;       // interpolation
  FloatMatrix factor_;                                          // lower, single precision
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation_;
  Eigen::VectorXd coarse_;
  Eigen::VectorXf coarse_single_;
};

}  // namespace equilibrium
