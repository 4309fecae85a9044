// What internal forces conserve.
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "operator_reference.hpp"

namespace {

using namespace fpm_test;
using fpm::MomentOperator;

template <int Dim>
class Body {
 public:
  explicit Body(double jitter)
      : model(lattice<Dim>(Dim == 2 ? Counts<Dim>::Constant(11) : Counts<Dim>::Constant(5), 0.1,
                           LatticeLayout::cell, jitter),
              true),
        op(model.rows, model.ghosts, {.pair = false, .second = true}) {}

  Model<Dim> model;
  MomentOperator<Dim> op;
};

// A force is the sum of `widest` products and the total a sum of n forces that cancel.
constexpr double widest = 90.0;

template <int Dim>
void expect_no_resultant(double jitter) {
  const Body<Dim> body(jitter);
  const Index n = body.op.size();
  const Eigen::MatrixXd stress =
      random_vector(n * body.op.stress_count(), 51).reshaped(n, body.op.stress_count());
  const Field<Dim> zero = Field<Dim>::Zero(n, Dim);
  const Field<Dim> force = scattered(body.op, stress, zero, zero);
  EXPECT_GT(force.cwiseAbs().maxCoeff(), 1.0);
  EXPECT_LE(force.colwise().sum().cwiseAbs().maxCoeff(),
            (widest + n) * epsilon * force.cwiseAbs().sum());
}

TEST(InternalForce, HasNoResultantForAnyStress) {
  for (const double jitter : {0.0, 0.2}) {
    expect_no_resultant<2>(jitter);
    expect_no_resultant<3>(jitter);
  }
}

template <int Dim>
void expect_no_moment(double jitter) {
  // Any motion, any symmetric Cauchy stress: P_a = V_a sigma F_a^-T.
  const Body<Dim> body(jitter);
  const Index n = body.op.size();
  const Field<Dim> x =
      affine<Dim>(body.model.set.position, some_tensor<Dim>(), Vector<Dim>::Ones()) +
      0.01 * random_field<Dim>(n, 52);
  const Eigen::MatrixXd f = gathered(body.op, x);
  Eigen::MatrixXd stress = Eigen::MatrixXd::Zero(n, body.op.stress_count());
  for (Index a = 0; a < n; ++a) {
    const Tensor<Dim> fa = f.row(a).head(Dim * Dim).reshaped(Dim, Dim);
    const Tensor<Dim> any =
        random_vector(Dim * Dim, 100 + static_cast<unsigned>(a)).reshaped(Dim, Dim);
    const Tensor<Dim> cauchy = any + any.transpose();
    const Tensor<Dim> nominal = cauchy * fa.inverse().transpose();
    stress.row(a).head(Dim * Dim) = nominal.reshaped().transpose();
  }
  const Field<Dim> zero = Field<Dim>::Zero(n, Dim);
  const Field<Dim> force = scattered(body.op, stress, zero, zero);
  const Tensor<Dim> moment = x.transpose() * force;
  const double absolute = x.cwiseAbs().maxCoeff() * force.cwiseAbs().sum();
  EXPECT_LE((moment - moment.transpose()).cwiseAbs().maxCoeff(),
            (2.0 * widest + n) * epsilon * absolute);
}

TEST(InternalForce, HasNoMomentForAnySymmetricCauchyStress) {
  for (const double jitter : {0.0, 0.2}) {
    expect_no_moment<2>(jitter);
    expect_no_moment<3>(jitter);
  }
}

TEST(Gradient, IsThatOfAnAffineMotionOnEveryRow) {
  for (const double jitter : {0.0, 0.2}) {
    const Body<3> body(jitter);
    const Tensor<3> f = some_tensor<3>();
    const Eigen::MatrixXd moments =
        gathered(body.op, affine<3>(body.model.set.position, f, Vector<3>::Constant(2.0)));
    // Condition numbers of M here are below 100; rows have 90 terms; F X / X = O(1).
    constexpr double condition = 100.0;
    for (Index a = 0; a < body.op.size(); ++a) {
      const Tensor<3> found = moments.row(a).head(9).reshaped(3, 3);
      EXPECT_LE((found - f).cwiseAbs().maxCoeff(), (4.0 * condition + 90.0) * epsilon * 10.0);
    }
  }
}

}  // namespace
