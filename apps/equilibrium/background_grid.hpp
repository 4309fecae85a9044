#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <vector>

#include "model/model.hpp"

namespace equilibrium {

/// The elastic body on a background grid of bilinear (trilinear) elements integrated at the
/// particles, factorised: the coarse level of the preconditioner.
template <int Dim>
class BackgroundGrid {
 public:
  /// No grid: `add_solution` must not be called.
  BackgroundGrid() = default;
  /// @param grid_spacing  [m], rounded so that whole elements fill the box
  /// @throws std::runtime_error if the factorisation fails (a body without support)
  BackgroundGrid(const model::Model<Dim>& model, double grid_spacing);

  bool empty() const { return nodes_ == 0; }

  /// z += P A_c^-1 P^T r, with r taken as 0 at prescribed unknowns; in single precision.
  void add_solution(const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  bool is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const;
  using FloatMatrix = Eigen::SparseMatrix<float>;
  std::vector<Eigen::Triplet<double>> grid_stiffness(const model::Model<Dim>& model);
  Eigen::VectorXd node_moduli(const model::Model<Dim>& model) const;
  void add_grid_supports(const model::Model<Dim>& model,
                         std::vector<Eigen::Triplet<double>>& entries) const;
  void interpolation_of(const Eigen::Matrix<double, 1, Dim>& position,
                        Eigen::Matrix<fpm::Index, 1 << Dim, 1>& nodes,
                        Eigen::Matrix<double, 1 << Dim, 1>& values,
                        Eigen::Matrix<double, Dim, 1 << Dim>& gradients) const;

  std::vector<char> prescribed_;
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
