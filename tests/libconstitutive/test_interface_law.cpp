// Coulomb's law at a face: sticking, sliding, opening, and consistent tangents.
#include <gtest/gtest.h>
#include <constitutive/interface_law.hpp>
#include <numbers>

namespace {

using constitutive::interface_response;
using constitutive::InterfaceLaw;
using constitutive::InterfaceResponse;
using constitutive::InterfaceState;
using constitutive::sticks;

template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;

constexpr double stiffness = 1e8;   // [Pa/m]
constexpr double round_off = 1e-9;  // [Pa], of tractions of 1e5
constexpr double friction = 0.4;    // tan delta
constexpr double adhesion = 2e3;    // [Pa]

InterfaceLaw coulomb(bool tension = false) {
  return {.tied = false, .friction_tangent = friction, .adhesion = adhesion, .tension = tension};
}

// Clay that is bonded, whose springs are softer along the face.
InterfaceLaw bond() {
  return {.tied = false, .shear_stiffness = 0.1, .adhesion = adhesion, .tension = true};
}

template <int Dim>
Vector<Dim> some_normal() {
  Vector<Dim> normal = Vector<Dim>::LinSpaced(1.0, 2.0);
  normal[0] = -0.7;
  return normal.normalized();
}

// A gap of a given pull and shear, at an initial traction and slip of their own.
template <int Dim>
struct Point {
  Vector<Dim> normal = some_normal<Dim>();
  Vector<Dim> along = Vector<Dim>(Vector<Dim>::Unit(0) - normal[0] * normal).normalized();
  Vector<Dim> initial = -3e3 * normal + 500.0 * along;
  Vector<Dim> slip = 2e-5 * along;

  InterfaceResponse<Dim> at(const InterfaceLaw& law, double pull, double shear) const {
    return of(law, gap(pull, shear));
  }
  Vector<Dim> gap(double pull, double shear) const {
    return (pull * normal + shear * along - initial) / stiffness + slip;
  }
  InterfaceResponse<Dim> of(const InterfaceLaw& law, const Vector<Dim>& gap) const {
    return interface_response<Dim>(law, stiffness, normal, initial, gap, slip);
  }
};

template <int Dim>
void expect_law() {
  const Point<Dim> p;
  const double pressure = 1e4, strength = adhesion + friction * pressure;
  auto r = p.at(coulomb(), -pressure, 0.99 * strength);
  EXPECT_EQ(r.state, InterfaceState::sticking);
  EXPECT_LE((r.traction - (-pressure * p.normal + 0.99 * strength * p.along)).norm(), round_off);
  EXPECT_EQ(r.slip, p.slip);

  r = p.at(coulomb(), -pressure, -3.0 * strength);
  EXPECT_EQ(r.state, InterfaceState::sliding);
  EXPECT_LE((r.traction - (-pressure * p.normal - strength * p.along)).norm(), round_off);
  EXPECT_LE((r.slip - p.slip + 2.0 * strength / stiffness * p.along).norm(), 1e-15);

  // As it opens its adhesion fades, and its pressure is none.
  r = p.at(coulomb(), 0.25 * adhesion, 0.7 * adhesion);
  EXPECT_EQ(r.state, InterfaceState::sticking);
  EXPECT_LE((r.traction - 0.7 * adhesion * p.along).norm(), round_off);
  r = p.at(coulomb(), 0.25 * adhesion, 3.0 * adhesion);
  EXPECT_EQ(r.state, InterfaceState::sliding);
  EXPECT_LE((r.traction - 0.75 * adhesion * p.along).norm(), round_off);

  r = p.at(coulomb(), 1.01 * adhesion, 100.0);
  EXPECT_EQ(r.state, InterfaceState::open);
  EXPECT_EQ(r.traction.norm(), 0.0);
  // What it bore along the face is forgotten: closed again, it bears pressure alone.
  const auto closed = interface_response<Dim>(coulomb(), stiffness, p.normal, p.initial,
                                              p.gap(-pressure, 100.0), r.slip);
  EXPECT_LE((closed.traction + pressure * p.normal).norm(), round_off);

  // With tension it holds, with what adhesion it has.
  r = p.at(coulomb(true), 5e3, 3.0 * adhesion);
  EXPECT_EQ(r.state, InterfaceState::sliding);
  EXPECT_LE((r.traction - (5e3 * p.normal + adhesion * p.along)).norm(), round_off);

  r = p.at({}, 5e3, 1e6);  // tied
  EXPECT_LE((r.traction - (5e3 * p.normal + 1e6 * p.along)).norm(), round_off);
}

TEST(InterfaceLaw, SticksSlidesAndOpens) {
  expect_law<2>();
  expect_law<3>();
}

// Along the face its springs are softer by a factor; what they bear does not depend on it.
template <int Dim>
void expect_bond() {
  const Point<Dim> p;
  const double across = p.initial.dot(p.normal), along = p.initial.dot(p.along);
  for (const double pull : {-1e4, 5e3}) {
    const auto at = [&](double shear) {
      const Vector<Dim> springs =
          (pull - across) * p.normal + (shear - along) / bond().shear_stiffness * p.along;
      return p.of(bond(), springs / stiffness + p.slip);
    };
    auto r = at(0.99 * adhesion);
    EXPECT_EQ(r.state, InterfaceState::sticking);
    EXPECT_LE((r.traction - (pull * p.normal + 0.99 * adhesion * p.along)).norm(), round_off);
    r = at(1.5 * adhesion);
    EXPECT_EQ(r.state, InterfaceState::sliding);
    EXPECT_LE((r.traction - (pull * p.normal + adhesion * p.along)).norm(), round_off);
    EXPECT_LE((r.slip - p.slip - 5.0 * adhesion / stiffness * p.along).norm(), 1e-15);
  }
}

TEST(InterfaceLaw, OfABondSlidesInSofterSprings) {
  expect_bond<2>();
  expect_bond<3>();
}

TEST(InterfaceLaw, SticksIfItHasAnyStrengthAlongTheFace) {
  EXPECT_TRUE(sticks({}));  // tied
  EXPECT_TRUE(sticks(coulomb()));
  EXPECT_TRUE(sticks({.tied = false, .adhesion = 1.0}));
  EXPECT_FALSE(sticks({.tied = false}));
}

TEST(InterfaceLaw, SlidingAgainstItsSlipLosesWork) {
  const Point<3> p;
  const auto r = p.at(coulomb(), -1e4, 2e4);
  EXPECT_GT(r.traction.dot(r.slip - p.slip), 0.0);
}

template <int Dim>
void expect_tangent(const InterfaceLaw& law, double pull, double shear) {
  const Point<Dim> p;
  const Vector<Dim> gap = p.gap(pull, shear);
  const auto r = p.of(law, gap);
  constexpr double h =
      1e-9;  // [m]; the law's pieces are smooth: the error is of order h and rounding
  for (int i = 0; i < Dim; ++i) {
    const Vector<Dim> step = h * Vector<Dim>::Unit(i);
    const Vector<Dim> difference =
        (p.of(law, gap + step).traction - p.of(law, gap - step).traction) / (2.0 * h);
    EXPECT_LE((r.tangent.col(i) - difference).norm(), 1e-5 * stiffness);
  }
}

TEST(InterfaceLaw, TangentsAreThoseOfTheReturn) {
  for (const bool tension : {false, true}) {
    for (const double pull : {-1e4, 0.5 * adhesion, 5e3}) {
      for (const double shear : {500.0, 4e4, -4e4}) {
        expect_tangent<2>(coulomb(tension), pull, shear);
        expect_tangent<3>(coulomb(tension), pull, shear);
      }
    }
  }
  expect_tangent<3>({.tied = false}, -1e4, 3e3);  // smooth
  for (const double pull : {-1e4, 5e3}) {
    for (const double shear : {1e2, 4e5}) {
      expect_tangent<2>(bond(), pull, shear);
      expect_tangent<3>(bond(), pull, shear);
    }
  }
}

TEST(InterfaceLaw, TiedHasSofterSpringsAlongTheFaceIfAsked) {
  const Point<2> p;
  const auto r = p.of({.shear_stiffness = 0.1}, p.gap(5e3, 1e6));
  const Vector<2> shear = p.initial - p.initial.dot(p.normal) * p.normal;
  const double along = 0.1 * (1e6 - shear.dot(p.along)) + shear.dot(p.along);
  EXPECT_LE((r.traction - (5e3 * p.normal + along * p.along)).norm(), round_off);
  expect_tangent<3>({.shear_stiffness = 0.1}, -1e4, 3e3);
}

}  // namespace
