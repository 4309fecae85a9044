// Tractions, following pressure and penalty supports.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/LU>
#include <fpm/boundary_loads.hpp>

#include "sets.hpp"

namespace {

using namespace fpm_test;
using fpm::BoundaryPoints;
using fpm::BoundaryQuadratureOptions;
using fpm::Face;
using fpm::PenaltyOptions;
using fpm::PointOperator;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

// Round-off of sums over boundary points whose weights come from matrices of condition <= 500.
constexpr double relative = (4.0 * 500.0 + 90.0) * epsilon;

template <int Dim>
struct Block {
  LatticeOptions<Dim> box;
  Model<Dim> model;
  BoundaryPoints<Dim> points;
  PointOperator<Dim> op;

  explicit Block(const std::vector<Face>& faces, double jitter = 0.1)
      : box(lattice<Dim>(Counts<Dim>::Constant(Dim == 2 ? 8 : 5), 0.1, LatticeLayout::cell,
                         jitter)),
        model(box),
        points(boundary_quadrature(
            BoundaryQuadratureOptions<Dim>{.min = box.min, .max = box.max, .spacing = box.spacing},
            faces)),
        op(model.set, model.ghosts, points.position, row_options<Dim>()) {}

  Index size() const { return model.set.size(); }
  Field<Dim> zero() const { return Field<Dim>::Zero(size(), Dim); }
};

template <int Dim>
Tensor<Dim> moment(const Field<Dim>& force, const Field<Dim>& position) {
  return force.transpose() * position;
}

TEST(Traction, HasTheResultantAndMomentOfItsIntegral) {
  const Block<3> block({{1, true}});
  const Vector<3> t{2.0, -3.0, 5.0};
  Field<3> force = block.zero();
  add_uniform_traction(block.op, block.points, t, force);
  const double area = 0.25;
  EXPECT_LE((force.colwise().sum().transpose() - area * t).norm(),
            relative * force.cwiseAbs().sum());
  const Vector<3> centre{0.25, 0.5, 0.25};
  EXPECT_LE((moment<3>(force, block.model.set.position) - area * t * centre.transpose()).norm(),
            relative * force.cwiseAbs().sum());
}

TEST(Traction, MayDifferFromPointToPoint) {
  const Block<2> block({{1, true}});
  Field<2> traction = Field<2>::Zero(block.op.size(), 2);
  traction.col(1) = block.points.position.col(0);
  Field<2> force = block.zero();
  add_traction(block.op, block.points, traction, force);
  EXPECT_NEAR(force.col(1).sum(), 0.5 * 0.8 * 0.8, relative * force.cwiseAbs().sum());
  EXPECT_EQ(force.col(0).norm(), 0.0);
}

TEST(Traction, OnParticlesIsLumpedToThem) {
  const auto box = lattice<2>({4, 3}, 0.5, LatticeLayout::vertex);
  const Model<2> m(box);
  const auto tributary = fpm::tributary_points(box, Face{1, true});
  const auto op =
      PointOperator<2>::at_particles(m.set, m.ghosts, tributary.particle, row_options<2>(0.5));
  Field<2> force = Field<2>::Zero(20, 2);
  add_uniform_traction(op, tributary.points, {0.0, -4.0}, force);
  Field<2> expected = Field<2>::Zero(20, 2);
  expected.col(1).tail(5) << -1.0, -2.0, -2.0, -2.0, -1.0;
  EXPECT_EQ(force, expected);
}

template <int Dim>
void expect_nanson(const std::vector<Face>& faces) {
  // Affine motion: the current face is plane, and its area vector is cof(F) N A.
  const Block<Dim> block(faces);
  const Tensor<Dim> f = some_tensor<Dim>();
  const Field<Dim> u =
      affine<Dim>(block.model.set.position, f - Tensor<Dim>::Identity(), Vector<Dim>::Ones());
  Vector<Dim> reference_area = Vector<Dim>::Zero();
  for (Index c = 0; c < block.points.size(); ++c) {
    reference_area += block.points.weight[c] * block.points.normal.row(c).transpose();
  }
  const Vector<Dim> area = f.determinant() * f.inverse().transpose() * reference_area;
  constexpr double pressure = 7.0;
  Field<Dim> force = block.zero();
  EXPECT_FALSE(add_following_pressure(block.op, block.points, pressure, u, force));
  EXPECT_LE((force.colwise().sum().transpose() + pressure * area).norm(),
            10.0 * relative * force.cwiseAbs().sum());  // F has the round-off of weights / spacing
}

TEST(FollowingPressure, ActsOnTheCurrentAreaAlongTheCurrentNormal) {
  expect_nanson<2>({{0, true}});
  expect_nanson<2>({{1, false}, {0, true}});
  expect_nanson<3>({{2, true}});
  expect_nanson<3>({{0, false}, {1, true}});
}

template <int Dim>
void expect_no_resultant_on_a_closed_surface() {
  const Block<Dim> block(fpm::all_faces<Dim>());
  const Field<Dim> u =
      affine<Dim>(block.model.set.position, 0.3 * some_tensor<Dim>(), Vector<Dim>::Zero());
  Field<Dim> force = block.zero();
  EXPECT_FALSE(add_following_pressure(block.op, block.points, 7.0, u, force));
  EXPECT_LE(force.colwise().sum().norm(), 10.0 * relative * force.cwiseAbs().sum());
}

TEST(FollowingPressure, HasNoResultantOnAClosedSurface) {
  expect_no_resultant_on_a_closed_surface<2>();
  expect_no_resultant_on_a_closed_surface<3>();
}

template <int Dim>
void expect_exact_derivative() {
  // The force is a polynomial of degree Dim - 1 in u: central differences are exact up to
  // round-off, which is epsilon |force| / h.
  const Block<Dim> block({{0, true}, {1, true}});
  const Field<Dim> u = 0.01 * random_field<Dim>(block.size(), 95);
  const Field<Dim> v = 0.01 * random_field<Dim>(block.size(), 96);
  Field<Dim> plus = block.zero();
  Field<Dim> minus = block.zero();
  Field<Dim> action = block.zero();
  ASSERT_FALSE(add_following_pressure(block.op, block.points, 7.0, Field<Dim>(u + v), plus));
  ASSERT_FALSE(add_following_pressure(block.op, block.points, 7.0, Field<Dim>(u - v), minus));
  add_following_pressure_action(block.op, block.points, 7.0, u, v, action);
  EXPECT_GT(action.norm(), 1e-3);
  EXPECT_LE((action - 0.5 * (plus - minus)).cwiseAbs().maxCoeff(),
            round_off(90.0, plus.cwiseAbs().maxCoeff()));
}

TEST(FollowingPressure, ActionIsTheDerivativeOfTheForce) {
  expect_exact_derivative<2>();
  expect_exact_derivative<3>();
}

TEST(FollowingPressure, NamesThePointThatIsTurnedInsideOut) {
  const Block<2> block({{1, true}});
  Tensor<2> mirror = Tensor<2>::Zero();
  mirror(0, 0) = -2.0;  // x -> -x
  const Field<2> u = affine<2>(block.model.set.position, mirror, Vector<2>::Zero());
  Field<2> force = block.zero();
  EXPECT_EQ(add_following_pressure(block.op, block.points, 1.0, u, force), std::optional<Index>(0));
  EXPECT_EQ(add_following_pressure(block.op, block.points, 1.0,
                                   Field<2>(Field<2>::Constant(block.size(), 2, NAN)), force),
            std::optional<Index>(0));
}

template <int Dim>
void expect_gradient_of_energy(const PenaltyOptions<Dim>& options) {
  const Block<Dim> block({{0, false}});
  const Field<Dim> target = random_field<Dim>(block.op.size(), 97);
  const Field<Dim> u = random_field<Dim>(block.size(), 98);
  const Field<Dim> v = random_field<Dim>(block.size(), 99);
  Field<Dim> force = block.zero();
  const Vector<Dim> reaction = add_penalty_force(block.op, block.points, options, target, u, force);
  // The energy is quadratic, so central differences are exact up to round-off.
  const auto energy = [&](double h) {
    return penalty_energy(block.op, block.points, options, target, Field<Dim>(u + h * v));
  };
  EXPECT_NEAR(force.cwiseProduct(v).sum(), 0.5 * (energy(1.0) - energy(-1.0)),
              round_off(90.0, energy(1.0) + energy(-1.0)));
  EXPECT_LE((reaction + force.colwise().sum().transpose()).norm(),
            relative * force.cwiseAbs().sum());

  Field<Dim> of_v = block.zero();
  Field<Dim> of_u = block.zero();
  add_penalty_action(block.op, block.points, options, v, of_v);
  add_penalty_action(block.op, block.points, options, u, of_u);
  EXPECT_NEAR(of_v.cwiseProduct(u).sum(), of_u.cwiseProduct(v).sum(),
              round_off(90.0, of_v.cwiseProduct(u).cwiseAbs().sum()));
  EXPECT_GT(of_v.cwiseProduct(v).sum(), 0.0);
  Field<Dim> moved = block.zero();
  add_penalty_force(block.op, block.points, options, target, Field<Dim>(u + v), moved);
  EXPECT_LE((moved - force - of_v).cwiseAbs().maxCoeff(),
            round_off(90.0, moved.cwiseAbs().maxCoeff()));
  for (int i = 0; i < Dim; ++i) {
    const bool acts = options.prescribed[static_cast<std::size_t>(i)];
    EXPECT_EQ(force.col(i).norm() > 0.0, acts);
    EXPECT_EQ(reaction[i] != 0.0, acts);
  }
}

TEST(Penalty, ForceIsTheGradientOfItsEnergyAndItsActionIsSymmetric) {
  expect_gradient_of_energy<2>({.penalty = 30.0});
  expect_gradient_of_energy<2>({.penalty = 30.0, .prescribed = {false, true}});
  expect_gradient_of_energy<3>({.penalty = 30.0, .prescribed = {true, false, true}});
}

TEST(Penalty, VanishesOnTheTargetWhereNReproducesIt) {
  const Block<2> block({{0, false}});
  const Tensor<2> a = some_tensor<2>();
  const Field<2> u = affine<2>(block.model.set.position, a, Vector<2>::Ones());
  const Field<2> target = affine<2>(block.points.position, a, Vector<2>::Ones());
  Field<2> force = block.zero();
  const PenaltyOptions<2> options{.penalty = 1.0};
  add_penalty_force(block.op, block.points, options, target, u, force);
  EXPECT_LE(force.cwiseAbs().maxCoeff(), 10.0 * relative * block.points.weight.maxCoeff());
}

TEST(Penalty, ValidateSaysWhatIsWrong) {
  EXPECT_THAT(validate(PenaltyOptions<2>{}), Contains(HasSubstr("must be positive")));
  EXPECT_THAT(validate(PenaltyOptions<2>{.penalty = NAN}), Contains(HasSubstr("must be positive")));
  EXPECT_THAT(validate(PenaltyOptions<2>{.penalty = 1.0, .prescribed = {false, false}}),
              Contains(HasSubstr("no component")));
  EXPECT_THAT(validate(PenaltyOptions<2>{.penalty = 1.0}), IsEmpty());
}

TEST(BoundaryLoads, RefuseSizesThatDisagree) {
  const Block<2> block({{1, true}});
  const Field<2> u = block.zero();
  const Field<2> target = Field<2>::Zero(block.op.size(), 2);
  Field<2> force = block.zero();
  Field<2> short_force = force.topRows(3);
  const Field<2> short_field = u.topRows(3);
  BoundaryPoints<2> fewer = block.points;
  fewer.weight.conservativeResize(3);
  const PenaltyOptions<2> penalty{.penalty = 1.0};
  using fpm::ShapeError;
  EXPECT_THROW(add_traction(block.op, fewer, target, force), ShapeError);
  EXPECT_THROW(add_traction(block.op, block.points, short_field, force), ShapeError);
  EXPECT_THROW(add_uniform_traction(block.op, block.points, {1.0, 0.0}, short_force), ShapeError);
  EXPECT_THROW((void)add_following_pressure(block.op, block.points, 1.0, short_field, force),
               ShapeError);
  EXPECT_THROW(add_following_pressure_action(block.op, block.points, 1.0, u, short_field, force),
               ShapeError);
  EXPECT_THROW(add_penalty_force(block.op, block.points, penalty, short_field, u, force),
               ShapeError);
  EXPECT_THROW(add_penalty_action(block.op, block.points, penalty, short_field, force), ShapeError);
  EXPECT_THROW(penalty_energy(block.op, block.points, penalty, target, short_field), ShapeError);
}

}  // namespace
