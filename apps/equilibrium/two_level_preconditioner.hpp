#pragma once

#include <Eigen/Core>
#include <vector>

#include "equilibrium/background_grid.hpp"
#include "equilibrium/interface_springs.hpp"
#include "fpm/moment_operator.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// Approximate inverse of the stiffness, built once from the elastic body on its initial positions
/// and kept through plasticity and re-search:
///   z = D^-1 r + P A_c^-1 P^T r.
/// D, with the springs of the interfaces (interface_springs.hpp), holds the Dim x Dim diagonal
/// blocks of the elastic particle stiffness with its hourglass part; A_c is the elastic stiffness
/// of a background grid of bilinear (trilinear) elements integrated at the particles, and P
/// interpolates from the grid. Iterations stay bounded as particles grow.
///
/// Unknowns that are prescribed get z = 0.
/// Departure: Chen, Huang & Lyamin 2020 use none (share/doc/decisions/preconditioner.md).
template <int Dim>
class TwoLevelPreconditioner {
 public:
  /// @param coarse_over_spacing  grid spacing over particle spacing; 0 leaves the grid out
  ///   (block-Jacobi)
  /// @throws std::runtime_error if the coarse factorisation fails (a body without support)
  TwoLevelPreconditioner(const model::Model<Dim>& model, const fpm::Rows<Dim>& initial_rows,
                         double coarse_over_spacing);

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  using Blocks = Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>;
  void build_blocks(const model::Model<Dim>& model, const fpm::Rows<Dim>& initial_rows);
  void add_penalty_blocks(const model::Model<Dim>& model, Blocks& sum) const;
  void invert_blocks(const Blocks& sum);
  void apply_block(Eigen::Index a, const Eigen::VectorXd& r, Eigen::VectorXd& z) const;

  Eigen::Index size_ = 0;
  std::vector<char> prescribed_;
  std::vector<Eigen::Index> given_;  // the prescribed unknowns
  Blocks block_inverse_;
  InterfaceSprings<Dim> springs_;
  BackgroundGrid<Dim> grid_;
};

}  // namespace equilibrium
