#include "fpm/consistency.hpp"

#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

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

// Whether the first moment of a neighbourhood vanishes, as it does inside a lattice.
template <int Dim>
bool is_balanced(const RowGeometry<Dim>& geometry, const RowWeights<Dim>& weights) {
  constexpr double round_off = 1e3 * std::numeric_limits<double>::epsilon();
  const Vector<Dim> first = geometry.offset * weights.kappa;
  return first.norm() <= round_off * weights.kappa.sum() * geometry.support_radius;
}

// The rows whose neighbourhoods are cut by a face or irregular.
template <int Dim>
std::vector<char> unbalanced_rows(const Rows<Dim>& rows) {
  std::vector<char> unbalanced(static_cast<std::size_t>(rows.size()));
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  for (Index a = 0; a < rows.size(); ++a) {
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    unbalanced[static_cast<std::size_t>(a)] = is_balanced(geometry, weights) ? 0 : 1;
  }
  return unbalanced;
}

// S of the corrected rows for one component; an image enters as its source, with the sign of that
// component.
template <int Dim>
Eigen::SparseMatrix<double> assemble(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                     const std::vector<char>& corrected, int component) {
  const Index n = rows.size();
  std::vector<Eigen::Triplet<double>> entries;
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  std::vector<Index> id;
  std::vector<double> sign;
  for (Index a = 0; a < n; ++a) {
    entries.emplace_back(a, a, 0.0);  // the diagonal is there, whatever is corrected
    if (corrected[static_cast<std::size_t>(a)] == 0) continue;
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

// Solves S x = b. S has the affine fields in its null space, to which b is orthogonal: a small
// multiple of the diagonal makes it definite, and iterative refinement removes its trace. The
// smoothest modes need the most of it, their eigenvalues are about (spacing / length)^4 of the
// largest.
class RegularisedSolver {
 public:
  explicit RegularisedSolver(const Eigen::SparseMatrix<double>& lower) : lower_(lower) {
    constexpr double regularisation = 1e-10;
    Eigen::SparseMatrix<double> shifted = lower_;
    shifted.diagonal().array() += regularisation * lower_.diagonal().maxCoeff();
    factor_.compute(shifted);
    if (factor_.info() != Eigen::Success) {
      throw std::runtime_error("the consistency correction's matrix could not be factorised");
    }
  }

  /// @param round_off  residual below which the right-hand side means nothing
  /// @returns nothing if the right-hand side is not in the range of S
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& right_hand_side, double round_off) const {
    constexpr double tolerance = 1e-10;  // of the residual, relative; the loads' error in a patch
    constexpr int max_refinements = 50;
    const double target = std::max(tolerance * right_hand_side.norm(), round_off);
    Eigen::VectorXd x = factor_.solve(right_hand_side);
    for (int k = 0; k < max_refinements; ++k) {
      const Eigen::VectorXd residual = right_hand_side - lower_.selfadjointView<Eigen::Lower>() * x;
      if (residual.norm() <= target) return x;
      x += factor_.solve(residual);
    }
    return std::nullopt;
  }

 private:
  Eigen::SparseMatrix<double> lower_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

// Round-off of the defect in the 2-norm: that of a sum of areas V_a G_ab whose weights come from
// moment matrices with condition numbers up to some hundreds, and that of the boundary, whose
// coordinates differ from those that would close it by their own round-off.
template <int Dim>
double defect_round_off(const Rows<Dim>& rows, const Field<Dim>& area_vector) {
  constexpr double relative = 1e3 * std::numeric_limits<double>::epsilon();
  double sum = 0.0;
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  for (Index a = 0; a < rows.size(); ++a) {
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    sum += geometry.own_volume * geometry.own_volume * weights.gradient.squaredNorm();
  }
  const double misplaced = rows.coordinate_round_off() / rows.options().support_radius;
  return relative * std::sqrt(sum) + misplaced * area_vector.norm();
}

}  // namespace

template <int Dim>
Field<Dim> consistency_defect(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
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

namespace {

template <int Dim>
std::optional<Field<Dim>> solve_for_potential(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                              const std::vector<char>& corrected,
                                              const Field<Dim>& missing, double round_off) {
  Field<Dim> potential(rows.size(), Dim);
  std::optional<const RegularisedSolver> solver;
  for (int i = 0; i < Dim; ++i) {
    // Without images S is the same for all components.
    if (i == 0 || ghosts.size() > 0) solver.emplace(assemble(rows, ghosts, corrected, i));
    const auto column = solver->solve(missing.col(i), round_off);
    if (!column) return std::nullopt;
    potential.col(i) = *column;
  }
  return potential;
}

}  // namespace

template <int Dim>
ConsistencyCorrection<Dim> consistency_correction(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                                  const Field<Dim>& area_vector) {
  const Field<Dim> missing = -consistency_defect(rows, ghosts, area_vector);
  const double round_off = defect_round_off(rows, area_vector);
  ConsistencyCorrection<Dim> correction;
  if (missing.colwise().norm().maxCoeff() <= round_off) return correction;
  correction.corrected = unbalanced_rows(rows);
  auto potential = solve_for_potential(rows, ghosts, correction.corrected, missing, round_off);
  if (!potential) {
    correction.corrected.assign(correction.corrected.size(), 1);
    potential = solve_for_potential(rows, ghosts, correction.corrected, missing, round_off);
  }
  if (!potential) {
    throw std::runtime_error(
        "the consistency correction did not reach its tolerance; do the area vectors close the "
        "surface of the particles' volume?");
  }
  correction.potential = std::move(*potential);
  return correction;
}

template Field<2> consistency_defect<2>(const Rows<2>&, const Ghosts<2>&, const Field<2>&);
template Field<3> consistency_defect<3>(const Rows<3>&, const Ghosts<3>&, const Field<3>&);
template ConsistencyCorrection<2> consistency_correction<2>(const Rows<2>&, const Ghosts<2>&, const Field<2>&);
template ConsistencyCorrection<3> consistency_correction<3>(const Rows<3>&, const Ghosts<3>&, const Field<3>&);

}  // namespace fpm
