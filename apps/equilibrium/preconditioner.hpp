#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "fpm/moment_operator.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// Approximate inverse of the stiffness, built once from the elastic body on its initial positions
/// and kept through plasticity and re-search:
///   z = D^-1 r + P A_c^-1 P^T r.
/// D holds the Dim x Dim diagonal blocks of the elastic particle stiffness with its hourglass part;
/// A_c is the elastic stiffness of a background grid of bilinear (trilinear) elements integrated at
/// the particles, and P interpolates from the grid. Iterations stay bounded as particles grow.
///
/// Unknowns that are prescribed get z = 0.
/// Departure: Chen, Huang & Lyamin 2020 use none (share/doc/decisions/preconditioner.md).
template <int Dim>
class TwoLevelPreconditioner {
 public:
  /// @param coarse_over_spacing  grid spacing over particle spacing; 0 leaves the grid out
  ///   (block-Jacobi)
  /// @throws std::runtime_error if the coarse factorisation fails (a body without support)
  TwoLevelPreconditioner(const model::Model<Dim>& model, const fpm::MomentOperator<Dim>& op,
                         double coarse_over_spacing);

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  using FloatMatrix = Eigen::SparseMatrix<float>;
  using Blocks = Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>;
  void build_blocks(const model::Model<Dim>& model, const fpm::MomentOperator<Dim>& op);
  void build_grid(const model::Model<Dim>& model, double grid_spacing);
  std::vector<Eigen::Triplet<double>> grid_stiffness(const model::Model<Dim>& model);
  void add_penalty_blocks(const model::Model<Dim>& model, Blocks& sum) const;
  void invert_blocks(const Blocks& sum);
  void add_grid_supports(const model::Model<Dim>& model,
                         std::vector<Eigen::Triplet<double>>& entries) const;
  void interpolation_of(const Eigen::Matrix<double, 1, Dim>& position,
                        Eigen::Matrix<fpm::Index, 1 << Dim, 1>& nodes,
                        Eigen::Matrix<double, 1 << Dim, 1>& values,
                        Eigen::Matrix<double, Dim, 1 << Dim>& gradients) const;

  Eigen::Index size_ = 0;
  std::vector<char> prescribed_;
  Blocks block_inverse_;

  // The grid.
  fpm::Vector<Dim> origin_, cell_;
  Eigen::Matrix<fpm::Index, Dim, 1> cells_;
  fpm::Index nodes_ = 0;
  Eigen::Matrix<fpm::Index, 1 << Dim, Eigen::Dynamic> corner_;  // of each particle's cell
  Eigen::Matrix<float, 1 << Dim, Eigen::Dynamic> weight_;       // interpolation
  FloatMatrix factor_;                                          // lower, single precision
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation_;
  Eigen::VectorXd coarse_;
  Eigen::VectorXf coarse_single_;
};

}  // namespace equilibrium
