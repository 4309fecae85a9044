#include "fpm/consistency.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <stdexcept>

#include "fpm/stencil.hpp"

namespace fpm {
namespace {

// Row a of S: V_a^2 T^T diag(kappa) T on [a, neighbours], dense and symmetric.
template <int Dim>
Eigen::MatrixXd row_matrix(const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights) {
  const Eigen::Index count = geometry.size();
  Tensor<Dim> spread = Tensor<Dim>::Zero();
  for (Eigen::Index k = 0; k < count; ++k) {
    const auto x = geometry.offset.col(k);
    spread += weights.kappa[k] * x * x.transpose();
  }
  // On differences d: T = I - X^T spread^-1 X diag(kappa), so diag(kappa) T is symmetric.
  const Eigen::MatrixXd weighted = geometry.offset * weights.kappa.asDiagonal();
  Eigen::MatrixXd on_differences = -(weighted.transpose() * spread.inverse() * weighted);
  on_differences.diagonal() += weights.kappa;
  on_differences *= geometry.own_volume * geometry.own_volume;

  Eigen::MatrixXd matrix(count + 1, count + 1);
  matrix.bottomRightCorner(count, count) = on_differences;
  matrix.bottomLeftCorner(count, 1) = -on_differences.rowwise().sum();
  matrix.topRightCorner(1, count) = matrix.bottomLeftCorner(count, 1).transpose();
  matrix(0, 0) = on_differences.sum();
  return matrix;
}

// S for one component; an image enters as its source, with the sign of that component.
template <int Dim>
Eigen::SparseMatrix<double> assemble(const Rows<Dim>& rows, const MirrorGhosts<Dim>& ghosts,
                                     int component) {
  const Index n = rows.size();
  std::vector<Eigen::Triplet<double>> entries;
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  std::vector<Index> id;
  std::vector<double> sign;
  for (Index a = 0; a < n; ++a) {
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    id.assign(1, a);
    sign.assign(1, 1.0);
    for (const Index b : rows.neighbours(a)) {
      id.push_back(b < n ? b : ghosts.source(b - n));
      sign.push_back(b < n ? 1.0 : ghosts.sign(b - n, component));
    }
    const Eigen::MatrixXd matrix = row_matrix(geometry, weights);
    for (std::size_t i = 0; i < id.size(); ++i) {
      for (std::size_t j = 0; j < id.size(); ++j) {
        if (id[i] < id[j]) continue;  // lower triangle
        entries.emplace_back(
            id[i], id[j],
            sign[i] * sign[j] * matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
      }
    }
  }
  Eigen::SparseMatrix<double> s(n, n);
  s.setFromTriplets(entries.begin(), entries.end());
  return s;
}

// S has the affine fields in its null space, to which the right-hand side is orthogonal: a small
// multiple of the diagonal makes it definite and iterative refinement removes its trace.
Eigen::VectorXd solve_regularised(const Eigen::SparseMatrix<double>& lower,
                                  const Eigen::VectorXd& right_hand_side) {
  constexpr double regularisation = 1e-10;
  constexpr int refinements = 3;
  Eigen::SparseMatrix<double> shifted = lower;
  const double scale = regularisation * lower.diagonal().maxCoeff();
  for (Eigen::Index a = 0; a < shifted.rows(); ++a) shifted.coeffRef(a, a) += scale;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(shifted);
  if (factor.info() != Eigen::Success) {
    throw std::runtime_error("the consistency correction's matrix could not be factorised");
  }
  Eigen::VectorXd x = factor.solve(right_hand_side);
  for (int k = 0; k < refinements; ++k) {
    const Eigen::VectorXd residual = right_hand_side - lower.selfadjointView<Eigen::Lower>() * x;
    x += factor.solve(residual);
  }
  return x;
}

}  // namespace

template <int Dim>
Field<Dim> consistency_defect(const Rows<Dim>& rows, const MirrorGhosts<Dim>& ghosts,
                              const Field<Dim>& area_vector) {
  const Index n = rows.size();
  require_size("area vectors", area_vector.rows(), n);
  Field<Dim> defect = -area_vector;
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  for (Index a = 0; a < n; ++a) {
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    Eigen::Index k = 0;
    for (const Index b : rows.neighbours(a)) {
      const Vector<Dim> area = geometry.own_volume * weights.gradient.col(k++);
      defect.row(a) -= area.transpose();
      const Index node = b < n ? b : ghosts.source(b - n);
      for (int i = 0; i < Dim; ++i) {
        defect(node, i) += (b < n ? 1.0 : ghosts.sign(b - n, i)) * area[i];
      }
    }
  }
  return defect;
}

template <int Dim>
Field<Dim> consistency_potential(const Rows<Dim>& rows, const MirrorGhosts<Dim>& ghosts,
                                 const Field<Dim>& area_vector) {
  const Field<Dim> missing = -consistency_defect(rows, ghosts, area_vector);
  Field<Dim> potential(rows.size(), Dim);
  for (int i = 0; i < Dim; ++i) {
    potential.col(i) = solve_regularised(assemble(rows, ghosts, i), missing.col(i));
  }
  return potential;
}

template Field<2> consistency_defect<2>(const Rows<2>&, const MirrorGhosts<2>&, const Field<2>&);
template Field<3> consistency_defect<3>(const Rows<3>&, const MirrorGhosts<3>&, const Field<3>&);
template Field<2> consistency_potential<2>(const Rows<2>&, const MirrorGhosts<2>&, const Field<2>&);
template Field<3> consistency_potential<3>(const Rows<3>&, const MirrorGhosts<3>&, const Field<3>&);

}  // namespace fpm
