#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <memory>

#include "model/model.hpp"

namespace equilibrium {

/// The springs of the interfaces in a preconditioner of diagonal blocks D: with B the gaps of a
/// displacement and K the springs' stiffness,
///   (D + B^T K B)^-1 = D^-1 - D^-1 B^T (K^-1 + B D^-1 B^T)^-1 B D^-1,
/// so that stiff springs cost no iterations. All points stick, but for those without any strength
/// along the face.
template <int Dim>
class InterfaceSprings {
 public:
  using Blocks = Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>;

  InterfaceSprings() = default;
  /// @param block_inverse  D^-1, of each particle; the identity at prescribed unknowns
  InterfaceSprings(const model::Model<Dim>& model, const Blocks& block_inverse);

  bool empty() const { return gap_.rows() == 0; }

  /// From D^-1 r to (D + B^T K B)^-1 r.
  void correct(Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;

  Sparse gap_;     // B
  Sparse spread_;  // D^-1 B^T
  std::shared_ptr<const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>>> factor_;
  Eigen::VectorXd gaps_;
  // Of the springs below plates that are free: their gaps by the plates' motions M, then
  // S^-1 M and (M^T S^-1 M)^-1, where S is the springs' flexibility. A plate bears no load.
  Eigen::MatrixXd motions_;
  Eigen::MatrixXd response_;
  Eigen::MatrixXd release_;
};

}  // namespace equilibrium
