// Exactness of the corrected weights on every row of a set.
#include <gtest/gtest.h>

#include <fpm/stencil.hpp>
#include <ostream>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::second_gradient_size;

struct SetKind {
  const char* name;
  LatticeLayout layout;
  double jitter;
  fpm::Kernel kernel;

  friend void PrintTo(const SetKind& kind, std::ostream* out) { *out << kind.name; }
};

class Weights : public testing::TestWithParam<SetKind> {
 protected:
  template <int Dim>
  static Model<Dim> model() {
    const Counts<Dim> cells = Dim == 2 ? Counts<Dim>::Constant(12) : Counts<Dim>::Constant(6);
    auto options = row_options<Dim>(0.1, true);
    options.kernel = GetParam().kernel;
    return Model<Dim>(
        fpm::make_lattice(lattice<Dim>(cells, 0.1, GetParam().layout, GetParam().jitter, 3.0)),
        options);
  }

  /// Visits the weights of every row.
  template <int Dim, class Visitor>
  static void for_each_row(const Model<Dim>& m, Visitor&& visit) {
    fpm::RowGeometry<Dim> row;
    fpm::RowWeights<Dim> weights;
    for (Index a = 0; a < m.rows.size(); ++a) {
      m.rows.geometry(a, row);
      compute_weights(row, m.rows.options().kernel, true, weights);
      visit(row, weights);
    }
  }
};

INSTANTIATE_TEST_SUITE_P(
    Sets, Weights,
    testing::Values(
        SetKind{"cells", LatticeLayout::cell, 0.0, fpm::Kernel::cubic_spline},
        SetKind{"vertices", LatticeLayout::vertex, 0.0, fpm::Kernel::cubic_spline},
        SetKind{"jitter", LatticeLayout::cell, 0.2, fpm::Kernel::cubic_spline},
        SetKind{"jittered_vertices", LatticeLayout::vertex, 0.2, fpm::Kernel::wendland_c2},
        SetKind{"quintic_jitter", LatticeLayout::cell, 0.2, fpm::Kernel::quintic_spline}),
    [](const auto& info) { return info.param.name; });

// Solving with a matrix of condition number c costs up to a small multiple of c epsilon, relative
// to the sum of the absolute terms.
double solve_error(double condition, double terms, double absolute_sum) {
  return (4.0 * condition + terms) * epsilon * absolute_sum;
}

template <int Dim>
void expect_linear_exactness(const fpm::RowGeometry<Dim>& row,
                             const fpm::RowWeights<Dim>& weights) {
  const auto terms = static_cast<double>(row.size());
  const double value_sum = std::abs(weights.own_value) + weights.value.cwiseAbs().sum();
  EXPECT_NEAR(weights.own_value + weights.value.sum(), 1.0,
              solve_error(weights.condition, terms, value_sum));
  const double reach = row.support_radius;
  const Vector<Dim> centre = row.offset * weights.value;
  EXPECT_LE(centre.cwiseAbs().maxCoeff(), solve_error(weights.condition, terms, value_sum * reach));
  const Tensor<Dim> unit = row.offset * weights.gradient.transpose();
  const double gradient_sum = weights.gradient.cwiseAbs().sum() * reach;
  EXPECT_LE((unit - Tensor<Dim>::Identity()).cwiseAbs().maxCoeff(),
            solve_error(weights.condition, terms, gradient_sum));
}

template <int Dim>
void expect_quadratic_exactness(const fpm::RowGeometry<Dim>& row,
                                const fpm::RowWeights<Dim>& weights) {
  // Column k of `monomials`: X_i and X_i X_j / (1 + delta_ij) at neighbour k.
  constexpr int second = second_gradient_size<Dim>;
  Eigen::Matrix<double, Dim + second, Eigen::Dynamic> monomials(Dim + second, row.size());
  monomials.template topRows<Dim>() = row.offset;
  int k = Dim;
  for (int i = 0; i < Dim; ++i) {
    for (int j = i; j < Dim; ++j) {
      monomials.row(k++) = row.offset.row(i).cwiseProduct(row.offset.row(j)) * (i == j ? 0.5 : 1.0);
    }
  }
  const Eigen::Matrix<double, second, Dim + second> found = weights.second * monomials.transpose();
  Eigen::Matrix<double, second, Dim + second> expected;
  expected.setZero();
  expected.template rightCols<second>().setIdentity();
  const double reach = row.support_radius;
  const double absolute_sum = weights.second.cwiseAbs().sum() * reach;
  const auto terms = static_cast<double>(row.size());
  for (int c = 0; c < Dim + second; ++c) {
    const double scale = c < Dim ? absolute_sum : absolute_sum * reach;
    EXPECT_LE((found.col(c) - expected.col(c)).cwiseAbs().maxCoeff(),
              solve_error(weights.second_condition, terms, scale));
  }
}

TEST_P(Weights, ReproduceLinearFieldsInEveryRow) {
  for_each_row<2>(model<2>(), expect_linear_exactness<2>);
  for_each_row<3>(model<3>(), expect_linear_exactness<3>);
}

TEST_P(Weights, ReproduceSecondGradientsOfQuadraticFieldsInEveryRow) {
  for_each_row<2>(model<2>(), expect_quadratic_exactness<2>);
  for_each_row<3>(model<3>(), expect_quadratic_exactness<3>);
}

TEST_P(Weights, PairWeightsAreNormalisedByTheirSpread) {
  for_each_row<2>(model<2>(), [](const auto& row, const auto& weights) {
    const double spread = weights.kappa.dot(row.offset.colwise().squaredNorm().transpose());
    EXPECT_NEAR(spread, 1.0, static_cast<double>(row.size()) * 4.0 * epsilon);
    EXPECT_GT(weights.kappa.minCoeff(), 0.0);
  });
}

TEST_P(Weights, DoNotDependOnTheUnitOfLength) {
  // Powers of two, so that the scaled numbers round alike.
  const Model<2> m = model<2>();
  constexpr double scale = 1024.0;
  for_each_row<2>(m, [&](fpm::RowGeometry<2> row, const auto& weights) {
    row.offset *= scale;
    row.volume *= scale * scale;
    row.own_volume *= scale * scale;
    row.support_radius *= scale;
    fpm::RowWeights<2> scaled;
    compute_weights(row, m.rows.options().kernel, true, scaled);
    EXPECT_EQ(scaled.value, weights.value);
    EXPECT_EQ(scaled.gradient * scale, weights.gradient);
    EXPECT_EQ(scaled.second * scale * scale, weights.second);
    EXPECT_EQ(scaled.condition, weights.condition);
  });
}

TEST(Weights, AreWellConditionedOnLatticesCornersAndJitter) {
  // 23 in the 2-norm is known for R = 2.4 spacings in the plane; the 1-norm's number is at most
  // three times that for a 3 x 3 matrix.
  constexpr double largest = 3.0 * 23.0;
  for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
    for (const double jitter : {0.0, 0.2}) {
      const Model<2> m(lattice<2>({15, 15}, 0.1, layout, jitter));
      fpm::RowGeometry<2> row;
      fpm::RowWeights<2> weights;
      for (Index a = 0; a < m.rows.size(); ++a) {
        m.rows.geometry(a, row);
        compute_weights(row, fpm::Kernel::cubic_spline, false, weights);
        EXPECT_LE(weights.condition, largest) << "particle " << a << ", jitter " << jitter;
      }
    }
  }
}

TEST(Weights, ShowACollinearNeighbourhoodByItsConditionNumber) {
  fpm::RowGeometry<2> row;
  row.offset = Eigen::Matrix2Xd::Zero(2, 6);
  for (int k = 0; k < 6; ++k) row.offset(0, k) = 0.1 * (k < 3 ? k - 3 : k - 2);
  row.volume = Eigen::VectorXd::Constant(6, 0.01);
  row.own_volume = 0.01;
  row.support_radius = 0.5;
  fpm::RowWeights<2> weights;
  compute_weights(row, fpm::Kernel::cubic_spline, true, weights);
  EXPECT_FALSE(weights.condition <= 1e12);
  EXPECT_FALSE(weights.second_condition <= 1e12);
}

TEST(Weights, RefuseVolumesThatDoNotFitTheNeighbours) {
  fpm::RowGeometry<2> row;
  row.offset = Eigen::Matrix2Xd::Ones(2, 6);
  row.volume = Eigen::VectorXd::Ones(5);
  fpm::RowWeights<2> weights;
  EXPECT_THROW(compute_weights(row, fpm::Kernel::cubic_spline, false, weights), fpm::ShapeError);
}

}  // namespace
