#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <memory>
#include <vector>

#include "fpm/moment_operator.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// The inverse of the stiffness of the elastic body on its initial positions, by Cholesky factors
/// of the matrix itself: hourglass control, sub-points, penalties and the springs of interfaces
/// included, free plates held. Of a linear body it is all that the solver has to do, next to
/// incompressibility, too, where blocks of particles and a grid find no direction. A body that is
/// free to move is taken, as by the grid. Two
/// neighbourhoods couple, so that it is for the plane or for few particles.
///
/// Unknowns that are prescribed get z = 0.
template <int Dim>
class StiffnessFactors {
 public:
  /// @param op  on the initial rows, with the consistency correction if it is on
  /// @throws std::runtime_error if the stiffness is not positive
  StiffnessFactors(const model::Model<Dim>& model, const fpm::MomentOperator<Dim>& op);

  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& z);

  std::size_t bytes() const;

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  std::vector<Eigen::Index> given_;  // the prescribed unknowns
  std::shared_ptr<const Eigen::SimplicialLLT<Sparse>> factor_;
};

}  // namespace equilibrium
