// The consistency correction through a re-search: a constant stress loads nobody anew.
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <fpm/carried_consistency.hpp>
#include <numbers>

#include "corrected_body.hpp"

namespace {

using namespace fpm_test;

/// A corrected body that has been deformed, and the force of a constant Cauchy stress in it.
template <int Dim>
struct Deformed {
  Corrected<Dim> body;
  Field<Dim> position;
  Eigen::VectorXd volume;
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> gradient;  // since each row's reference

  Deformed(const LatticeOptions<Dim>& box, const Field<Dim>& displaced, bool symmetric)
      : body(box, symmetric) {
    move_to(displaced);
  }

  void move_to(const Field<Dim>& displaced) {
    position = displaced;
    const Eigen::MatrixXd moments = gathered(body.op, position);
    gradient = moments.transpose();
    volume = body.model.rows.reference_volume();
    for (Index a = 0; a < body.size(); ++a) volume[a] *= of(a).determinant();
  }

  Tensor<Dim> of(Index a) const { return Eigen::Map<const Tensor<Dim>>(gradient.col(a).data()); }

  Field<Dim> force(const Tensor<Dim>& stress) const {
    Eigen::MatrixXd all(body.size(), Dim * Dim);
    for (Index a = 0; a < body.size(); ++a) {
      const Tensor<Dim> piola = volume[a] * stress * of(a).inverse().transpose();
      all.row(a) = piola.reshaped().transpose();
    }
    const Field<Dim> zero = Field<Dim>::Zero(body.size(), Dim);
    return scattered(body.op, all, zero, zero);
  }

  /// Searches rows anew; with `carried`, the correction is carried through.
  double re_search(const std::vector<Index>& rows, bool carried) {
    auto& model = body.model;
    const std::vector<char> excluded(static_cast<std::size_t>(body.size()), 0);
    const auto rebuilt = model.rows.research(rows, position, volume, excluded);
    EXPECT_EQ(rebuilt.size(), rows.size());
    const double left =
        carried
            ? carry_consistency(body.op, model.ghosts, rebuilt, {volume, gradient}, model.rows).left
            : 0.0;
    body.op = MomentOperator<Dim>(model.rows, model.ghosts, {}, body.correction);
    for (const Index a : rebuilt) {
      Eigen::Map<Tensor<Dim>>(gradient.col(a).data()).setIdentity();
    }
    return left;
  }
};

/// Particles in the lower left quarter (eighth), faces included.
template <int Dim>
std::vector<Index> in_a_corner(const Corrected<Dim>& body) {
  std::vector<Index> rows;
  const Vector<Dim> middle = 0.5 * (body.box.min + body.box.max);
  for (Index a = 0; a < body.size(); ++a) {
    const Vector<Dim> x = body.model.set.position.row(a).transpose();
    if ((x.array() < middle.array()).all()) rows.push_back(a);
  }
  return rows;
}

/// A stretch and, unless a plane of symmetry forbids, a shear and a rotation.
template <int Dim>
Tensor<Dim> some_deformation(bool symmetric) {
  Tensor<Dim> f = Tensor<Dim>::Identity();
  f(0, 0) = 1.25;
  f(1, 1) = 0.8;
  if (!symmetric) f(0, 1) = 0.3;
  if (symmetric) return f;
  Tensor<Dim> turn = Tensor<Dim>::Identity();
  const double angle = std::numbers::pi / 6.0;
  turn(0, 0) = turn(1, 1) = std::cos(angle);
  turn(0, 1) = -std::sin(angle);
  turn(1, 0) = std::sin(angle);
  return turn * f;
}

template <int Dim>
void expect_balance_kept(const LatticeOptions<Dim>& box, bool symmetric) {
  const Tensor<Dim> f = some_deformation<Dim>(symmetric);
  const auto place = [&](const Field<Dim>& x) { return affine<Dim>(x, f, Vector<Dim>::Zero()); };
  const Tensor<Dim> stress = some_stress<Dim>(symmetric);
  const Corrected<Dim> initial(box, symmetric);
  Deformed<Dim> deformed(box, place(initial.model.set.position), symmetric);
  // The area vectors go with the cofactor, so the force is that of the tractions there.
  const Tensor<Dim> cofactor = f.determinant() * f.inverse().transpose();
  const Field<Dim> external = initial.area * cofactor.transpose() * stress.transpose();
  constexpr double tolerance = 1e-9;
  ASSERT_LE((deformed.force(stress) - external).norm(), tolerance * external.norm());

  Deformed<Dim> dropped = deformed;
  dropped.re_search(in_a_corner(initial), false);
  EXPECT_GT((dropped.force(stress) - external).norm(), 1e-3 * external.norm());
  for (int k = 0; k < 2; ++k) {  // rows that are corrected already, the second time
    EXPECT_LE(deformed.re_search(in_a_corner(initial), true), tolerance);
    EXPECT_LE((deformed.force(stress) - external).norm(), tolerance * external.norm());
    // Linear fields are still exact, in each row's reference.
    const Eigen::MatrixXd moments = gathered(deformed.body.op, deformed.position);
    EXPECT_LE((moments.transpose() - deformed.gradient).cwiseAbs().maxCoeff(), tolerance);
  }
}

TEST(CarriedConsistency, AConstantStressStaysInBalance) {
  for (const bool symmetric : {false, true}) {
    for (const double jitter : {0.0, 0.2, 0.4}) {
      for (const auto layout : {LatticeLayout::cell, LatticeLayout::vertex}) {
        SCOPED_TRACE(testing::Message() << "symmetric " << symmetric << ", jitter " << jitter
                                        << ", vertices " << (layout == LatticeLayout::vertex));
        expect_balance_kept<2>(lattice<2>({18, 12}, 0.1, layout, jitter), symmetric);
        expect_balance_kept<3>(lattice<3>({7, 6, 6}, 0.1, layout, jitter), symmetric);
      }
    }
  }
}

TEST(CarriedConsistency, WhereTheDeformationVariesTheForceOfAConstantStressStays) {
  const auto box = lattice<2>({20, 16}, 0.1, LatticeLayout::cell, 0.1);
  const Corrected<2> initial(box, false);
  Field<2> position = initial.model.set.position;
  for (Index a = 0; a < initial.size(); ++a) {  // bent: gradients vary by 0.3 over the body
    const double x = position(a, 0), y = position(a, 1);
    position(a, 0) += 0.1 * x * y;
    position(a, 1) -= 0.1 * x * x;
  }
  Deformed<2> deformed(box, position, false);
  const Tensor<2> stress = some_stress<2>(false);
  const Field<2> before = deformed.force(stress);
  const double left = deformed.re_search(in_a_corner(initial), true);
  // What no linear field explains of a bent neighbourhood is of order spacing times curvature.
  EXPECT_LE(left, 0.1 * 0.2);
  EXPECT_LE((deformed.force(stress) - before).norm(), 1e-3 * before.norm());
}

TEST(CarriedConsistency, TouchesNoRowFarFromTheRebuiltOnes) {
  const auto box = lattice<2>({24, 20}, 0.1, LatticeLayout::cell, 0.2);
  const Corrected<2> initial(box, false);
  Deformed<2> deformed(box, initial.model.set.position * 1.1, false);
  const Index middle = 10 * 24 + 12;
  deformed.re_search({middle}, true);
  Index touched = 0;
  for (Index a = 0; a < initial.size(); ++a) {
    const auto offset = initial.model.set.position.row(a) - initial.model.set.position.row(middle);
    const bool met = offset.norm() <= support * box.spacing;
    const bool same = gradient_weights(deformed.body.op, a) == gradient_weights(initial.op, a);
    if (!same) ++touched;
    EXPECT_TRUE(met || same) << a;
  }
  EXPECT_GT(touched, 1);
}

TEST(CarriedConsistency, RefusesArraysOfAnotherSize) {
  Corrected<2> body(lattice<2>({8, 8}), false);
  const Eigen::Matrix<double, 4, Eigen::Dynamic> few(4, 63);
  EXPECT_THROW(carry_consistency<2>(body.op, body.model.ghosts, {0}, {body.model.set.volume, few},
                                    body.model.rows),
               fpm::ShapeError);
}

}  // namespace
