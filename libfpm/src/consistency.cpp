#include "fpm/consistency.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "consistency_solver.hpp"
#include "consistency_system.hpp"
#include "fpm/stencil.hpp"

namespace fpm {
namespace {

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
  detail::ConsistencySystem<Dim> normal(n);
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  std::vector<Index> id;
  std::vector<double> sign;
  for (Index a = 0; a < n; ++a) {
    if (corrected[static_cast<std::size_t>(a)] == 0) continue;
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    id.assign(1, a);
    sign.assign(1, 1.0);
    for (const Index b : rows.neighbours(a)) {
      id.push_back(b < n ? b : ghosts.source(b - n));
      sign.push_back(b < n ? 1.0 : ghosts.sign(b - n, component));
    }
    normal.add(id, sign, geometry, weights, geometry.own_volume * geometry.own_volume);
  }
  return normal.lower();
}

// Round-off of the defect in the 2-norm: that of a sum of areas V_a G_ab, and that of the boundary,
// whose coordinates differ from those that would close it by their own round-off.
template <int Dim>
double defect_round_off(const Rows<Dim>& rows, const Field<Dim>& area_vector) {
  double sum = 0.0;
  RowGeometry<Dim> geometry;
  RowWeights<Dim> weights;
  for (Index a = 0; a < rows.size(); ++a) {
    rows.geometry(a, geometry);
    compute_weights(geometry, rows.options().kernel, false, weights);
    sum += geometry.own_volume * geometry.own_volume * weights.gradient.squaredNorm();
  }
  const double misplaced = rows.coordinate_round_off() / rows.options().support_radius;
  return detail::area_round_off * std::sqrt(sum) + misplaced * area_vector.norm();
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
  constexpr auto method =
      Dim == 2 ? detail::SolutionMethod::factors : detail::SolutionMethod::conjugate_gradients;
  std::optional<detail::ConsistencySolver> solver;
  for (int i = 0; i < Dim; ++i) {
    // Without images S is the same for all components.
    if (i == 0 || ghosts.size() > 0) {
      solver.emplace(assemble(rows, ghosts, corrected, i), method);
    }
    const auto solution = solver->solve(missing.col(i), round_off);
    if (!solution.reached) return std::nullopt;
    potential.col(i) = solution.x;
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
template ConsistencyCorrection<2> consistency_correction<2>(const Rows<2>&, const Ghosts<2>&,
                                                            const Field<2>&);
template ConsistencyCorrection<3> consistency_correction<3>(const Rows<3>&, const Ghosts<3>&,
                                                            const Field<3>&);

}  // namespace fpm
