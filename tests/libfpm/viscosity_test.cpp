// The pseudo-viscosity of Chen, Huang & Lyamin 2020, Eq. 15-20.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <fpm/viscosity.hpp>

#include <Eigen/Geometry>
#include <cmath>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::MomentOperator;
using fpm::PairViscosity;
using testing::HasSubstr;

template <int Dim>
struct Body {
  Model<Dim> model;
  MomentOperator<Dim> op;
  Eigen::VectorXd modulus;
  Eigen::VectorXd smoothing_length;
  PairViscosity<Dim> viscosity;

  explicit Body(double jitter = 0.2, const std::vector<SymmetryPlane>& planes = {})
      : model(
            lattice<Dim>(Counts<Dim>::Constant(Dim == 2 ? 9 : 5), 0.1, LatticeLayout::cell, jitter),
            false, planes),
        op(model.rows, model.ghosts, {}),
        modulus((2.0 + random_vector(op.size(), 1).array()).matrix()),
        smoothing_length(smoothing_lengths(model.rows)),
        viscosity(op, modulus, smoothing_length) {}

  Index size() const { return op.size(); }
  const Field<Dim>& position() const { return model.set.position; }
  Field<Dim> force(const Field<Dim>& increment, const Field<Dim * Dim>& inverse_transposed) {
    Field<Dim> f = Field<Dim>::Zero(size(), Dim);
    viscosity.add_force(theta, position(), increment, inverse_transposed, model.set.volume, f);
    return f;
  }
  Field<Dim> force(const Field<Dim>& increment) {
    return force(increment, Field<Dim * Dim>(0, Dim * Dim));
  }

  static constexpr double theta = 0.3;
};

template <int Dim>
Field<Dim * Dim> some_inverses(Index n) {
  Field<Dim * Dim> inverse(n, Dim * Dim);
  for (Index a = 0; a < n; ++a) {
    inverse.row(a) = some_tensor<Dim>(static_cast<unsigned>(a)).reshaped().transpose();
  }
  return inverse;
}

// The formula, pair by pair.
template <int Dim>
Field<Dim> reference(const Body<Dim>& body, const Field<Dim>& increment,
                     const Field<Dim * Dim>& inverse) {
  const Index n = body.size();
  const auto& ghosts = body.model.ghosts;
  Field<Dim> x = body.position() + 0.5 * increment;
  x.conservativeResize(n + ghosts.size(), Dim);
  ghosts.extend_positions(x.data(), n, x.rows());
  Field<Dim> u = increment;
  u.conservativeResize(n + ghosts.size(), Dim);
  ghosts.extend_vectors(u.data(), n, u.rows());
  Field<Dim> force = Field<Dim>::Zero(n + ghosts.size(), Dim);
  for (Index a = 0; a < n; ++a) {
    body.op.for_each_entry(a, [&](Index b, const double* g) {
      const Index p = b < n ? b : ghosts.source(b - n);
      const Vector<Dim> x_ab = (x.row(a) - x.row(b)).transpose();
      const double e = 0.5 * (body.modulus[a] + body.modulus[p]);
      const double ls = 0.5 * (body.smoothing_length[a] + body.smoothing_length[p]);
      const double pi = body.theta * e * x_ab.dot((u.row(a) - u.row(b)).transpose()) /
                        (x_ab.squaredNorm() + 0.01 * ls * ls);
      const Tensor<Dim> push = inverse.row(a).reshaped(Dim, Dim);
      const Vector<Dim> t = body.model.set.volume[a] * pi * push * Eigen::Map<const Vector<Dim>>(g);
      force.row(b) += t.transpose();
      force.row(a) -= t.transpose();
    });
  }
  ghosts.fold_forces(force.data(), n, force.rows());
  return force.topRows(n);
}

template <int Dim>
void expect_as_written(Body<Dim> body) {
  const Field<Dim> du = 0.02 * random_field<Dim>(body.size(), 2);
  const Field<Dim* Dim> inverse = some_inverses<Dim>(body.size());
  const Field<Dim> expected = reference(body, du, inverse);
  EXPECT_LE((body.force(du, inverse) - expected).cwiseAbs().maxCoeff(),
            round_off(90.0, expected.cwiseAbs().maxCoeff()));
}

TEST(PairViscosity, IsTheFormulaPairByPair) {
  expect_as_written(Body<2>());
  expect_as_written(Body<2>(0.0, {{0, 0.0}, {1, 0.9}}));
  expect_as_written(Body<3>());
  expect_as_written(Body<3>(0.0, {{2, 0.0}}));
}

TEST(PairViscosity, HasNoResultant) {
  Body<2> plane;
  Body<3> space;
  const Field<2> f = plane.force(random_field<2>(plane.size(), 3), some_inverses<2>(plane.size()));
  EXPECT_LE(f.colwise().sum().norm(), 200.0 * epsilon * f.cwiseAbs().sum());
  const Field<3> g = space.force(random_field<3>(space.size(), 4), some_inverses<3>(space.size()));
  EXPECT_LE(g.colwise().sum().norm(), 400.0 * epsilon * g.cwiseAbs().sum());
}

// Round-off of x . du, relative to the force of a strain of order one.
template <int Dim>
void expect_blind_to(const Tensor<Dim>& rotation) {
  Body<Dim> body;
  const Field<Dim> rigid =
      affine<Dim>(body.position(), rotation - Tensor<Dim>::Identity(), Vector<Dim>::Constant(0.7));
  const double scale =
      body.force(affine<Dim>(body.position(), some_tensor<Dim>(), Vector<Dim>::Zero()))
          .cwiseAbs()
          .maxCoeff();
  EXPECT_GT(scale, 1e-3);
  EXPECT_LE(body.force(rigid).cwiseAbs().maxCoeff(), 500.0 * epsilon * scale);
}

TEST(PairViscosity, IsBlindToRigidMotionHoweverLarge) {
  for (const double angle : {1e-3, 0.5, 2.0}) {
    const Tensor<2> plane = Eigen::Rotation2Dd(angle).toRotationMatrix();
    expect_blind_to<2>(plane);
    const Tensor<3> space =
        Eigen::AngleAxisd(angle, Vector<3>(1.0, 2.0, -0.5).normalized()).toRotationMatrix();
    expect_blind_to<3>(space);
  }
}

TEST(PairViscosity, ResistsACheckerboardAndDissipates) {
  // u = (-1)^(i+j): the nodal gradient of the inner rows is zero, the pair differences are not.
  Body<2> body(0.0);
  Field<2> board(body.size(), 2);
  for (Index a = 0; a < body.size(); ++a)
    board.row(a).setConstant((a % 9 + a / 9) % 2 == 0 ? 1 : -1);
  board *= 1e-3;
  EXPECT_GT(body.force(board).cwiseProduct(board).sum(), 0.0);
  // Uniform extension: Pi > 0 (tension), so the work is positive.
  const Field<2> extension =
      affine<2>(body.position(), 0.01 * Tensor<2>::Identity(), Vector<2>::Zero());
  EXPECT_GT(body.force(extension).cwiseProduct(extension).sum(), 0.0);
}

TEST(PairViscosity, IsLinearInThetaAndInTheModulus) {
  Body<2> body;
  const Field<2> du = 0.01 * random_field<2>(body.size(), 5);
  const Field<2> once = body.force(du);
  PairViscosity<2> stiffer(body.op, 4.0 * body.modulus, body.smoothing_length);
  Field<2> f = Field<2>::Zero(body.size(), 2);
  stiffer.add_force(0.25 * body.theta, body.position(), du, Field<4>(0, 4), body.model.set.volume,
                    f);
  EXPECT_LE((f - once).cwiseAbs().maxCoeff(), 4.0 * epsilon * once.cwiseAbs().maxCoeff() * 50.0);
  Field<2> none = Field<2>::Zero(body.size(), 2);
  body.viscosity.add_force(0.0, body.position(), du, Field<4>(0, 4), body.model.set.volume, none);
  EXPECT_EQ(none.norm(), 0.0);
}

TEST(PairViscosity, AddsToTheForce) {
  Body<2> body;
  const Field<2> du = 0.01 * random_field<2>(body.size(), 6);
  const Field<2> once = body.force(du);
  Field<2> twice = once;
  body.viscosity.add_force(body.theta, body.position(), du, Field<4>(0, 4), body.model.set.volume,
                           twice);
  EXPECT_EQ(twice, Field<2>(2.0 * once));
}

TEST(PairViscosity, ActionIsLinearAndGivesTheForceOfTheIncrement) {
  Body<3> body;
  const Index n = body.size();
  const Field<3> du = 0.01 * random_field<3>(n, 7);
  const Field<3> v = random_field<3>(n, 8);
  const Field<9> inverse = some_inverses<3>(n);
  const auto action = [&](const Field<3>& direction) {
    Field<3> f = Field<3>::Zero(n, 3);
    body.viscosity.add_action(body.theta, body.position(), du, direction, inverse,
                              body.model.set.volume, f);
    return f;
  };
  EXPECT_EQ(action(du), body.force(du, inverse));
  const Field<3> sum = action(Field<3>(2.0 * v + du));
  EXPECT_LE((sum - 2.0 * action(v) - action(du)).cwiseAbs().maxCoeff(),
            round_off(90.0, sum.cwiseAbs().maxCoeff()));
}

TEST(PairViscosity, ActionIsTheDerivativeUpToTheIncrement) {
  // The midpoint moves with the increment: the neglected part is O(|du| / dx).
  Body<2> body(0.0);
  const Field<2> v = random_field<2>(body.size(), 9);
  for (const double size : {1e-3, 1e-4}) {
    const Field<2> du = size * 0.1 * random_field<2>(body.size(), 10);
    const double h = 1e-6;
    const Field<2> difference =
        (body.force(Field<2>(du + h * v)) - body.force(Field<2>(du - h * v))) / (2.0 * h);
    Field<2> action = Field<2>::Zero(body.size(), 2);
    body.viscosity.add_action(body.theta, body.position(), du, v, Field<4>(0, 4),
                              body.model.set.volume, action);
    // Each pair's Pi changes by less than 5 |du| / dx, relatively; rounding adds 1e-9.
    EXPECT_LE((difference - action).norm(), (5.0 * size + 1e-9) * action.norm());
  }
}

TEST(PairViscosity, SmoothingLengthsFollowTheSupports) {
  Body<2> body;
  for (const double ls : body.smoothing_length) EXPECT_GE(ls, 0.5 * support * 0.1);
  auto options = row_options<2>();
  options.kernel = fpm::Kernel::quintic_spline;
  const Model<2> m(fpm::make_lattice(lattice<2>({9, 9})), options);
  EXPECT_EQ(smoothing_lengths(m.rows)[40], support * 0.1 / 3.0);
}

TEST(PairViscosity, RefusesSizesAndParametersThatCannotBe) {
  Body<2> body;
  const Index n = body.size();
  const Eigen::VectorXd few = Eigen::VectorXd::Ones(3);
  using fpm::ShapeError;
  EXPECT_THROW(PairViscosity<2>(body.op, few, body.smoothing_length), ShapeError);
  EXPECT_THROW(PairViscosity<2>(body.op, body.modulus, few), ShapeError);
  const Field<2> good = Field<2>::Zero(n, 2);
  const Field<2> bad = Field<2>::Zero(3, 2);
  Field<2> f = good;
  Field<2> short_f = bad;
  const auto& volume = body.model.set.volume;
  const Field<4> identity(0, 4);
  auto& viscosity = body.viscosity;
  EXPECT_THROW(viscosity.add_force(0.1, bad, good, identity, volume, f), ShapeError);
  EXPECT_THROW(viscosity.add_force(0.1, good, bad, identity, volume, f), ShapeError);
  EXPECT_THROW(viscosity.add_force(0.1, good, good, Field<4>(3, 4), volume, f), ShapeError);
  EXPECT_THROW(viscosity.add_force(0.1, good, good, identity, few, f), ShapeError);
  EXPECT_THROW(viscosity.add_force(0.1, good, good, identity, volume, short_f), ShapeError);
  EXPECT_THROW(viscosity.add_action(0.1, good, good, bad, identity, volume, f), ShapeError);

  EXPECT_TRUE(fpm::validate(fpm::ViscosityOptions{}).empty());
  for (const double theta : {-1.0, std::nan("")}) {
    EXPECT_THAT(fpm::validate(fpm::ViscosityOptions{.theta = theta}),
                testing::ElementsAre(HasSubstr("must not be negative")));
  }
}

}  // namespace
