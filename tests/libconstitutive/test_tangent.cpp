#include <gtest/gtest.h>

#include <map>

#include "constitutive/spectral.hpp"
#include "points.hpp"

// Consistent tangents against central differences of the update, in every regime.
namespace {

using namespace constitutive;

/// Step of the differences, relative to the trial.
constexpr double step = 1e-5;
/// Least relative distance of a sampled trial from the points where the update is not smooth or
/// strongly curved (equal principal stresses, vanishing deviator).
constexpr double clearance = 0.05;
/// Truncation of a central difference, (step / clearance)^2 = 4e-8 times third derivatives of
/// order 10 of the functions s / |s| and (y_i - y_j) / (x_i - x_j); round-off eps / step is 2e-11.
constexpr double difference_error = 4e-7;

/// A name of the smooth piece on which a trial returns.
template <int Dim>
std::string regime(const Material& material, const StressVector<Dim>& trial,
                   const PointState<Dim>& s0) {
  if (const auto* m = std::get_if<MohrCoulomb>(&material)) {
    constexpr std::array<const char*, 5> names{"elastic", "plane", "compression edge",
                                               "extension edge", "apex"};
    const auto r =
        detail::return_principal(*m, detail::sine_of_dilation(*m, s0), spectrum(trial).values);
    return names[static_cast<std::size_t>(r.regime)];
  }
  PointState<Dim> s1;
  const UpdateOutcome outcome = update(material, trial, s0, s1);
  if (outcome.status() == UpdateStatus::apex) return "apex";
  return outcome.plastic ? "cone" : "elastic";
}

template <int Dim>
bool is_clear(const StressVector<Dim>& trial) {
  const Eigen::Vector3d x = spectrum(trial).values;
  const double least = clearance * trial.norm();
  return x[0] - x[1] > least && x[1] - x[2] > least;
}

/// d(stress)/d(trial) by central differences; false if a difference crosses into another regime.
template <int Dim>
bool differences(const Material& material, const StressVector<Dim>& trial,
                 const PointState<Dim>& s0, TangentMatrix<Dim>& result) {
  const double h = step * trial.norm();
  const std::string here = regime(material, trial, s0);
  for (int column = 0; column < stress_size<Dim>; ++column) {
    const StressVector<Dim> plus = trial + h * StressVector<Dim>::Unit(column);
    const StressVector<Dim> minus = trial - h * StressVector<Dim>::Unit(column);
    if (regime(material, plus, s0) != here || regime(material, minus, s0) != here) return false;
    PointState<Dim> a, b;
    (void)update(material, plus, s0, a);
    (void)update(material, minus, s0, b);
    result.col(column) = (a.stress - b.stress) / (2 * h);
  }
  return true;
}

/// Compares tangent and differences over a random sample; returns how often each regime was met.
template <int Dim>
std::map<std::string, int> compare(const MaterialParameters& p, const PointState<Dim>& s0) {
  const Material material = make_material(p);
  points::RandomStress<Dim> random(3 * p.cohesion);
  std::map<std::string, int> met;
  for (int i = 0; i < 3000; ++i) {
    StressVector<Dim> trial = random();
    if (i % 3 == 0) trial += isotropic<Dim>(2 * trial.norm());  // towards the apex
    TangentMatrix<Dim> expected;
    if (!is_clear<Dim>(trial) || !differences<Dim>(material, trial, s0, expected)) continue;
    const std::string where = regime(material, trial, s0);
    ++met[where];
    EXPECT_LE((trial_tangent(material, trial, s0) - expected).norm(), difference_error)
        << points::label(p) << " " << where << " trial " << trial.transpose();
  }
  return met;
}

template <class Dimension>
class Tangent : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Tangent, Dimensions);

constexpr int enough = 20;

TYPED_TEST(Tangent, OfTheConesEqualsDifferencesInEveryRegime) {
  for (const char* model : {"drucker_prager", "drucker_prager_compression"}) {
    for (const double psi : {0.0, 10.0, 20.0}) {
      auto met = compare<TypeParam::value>(points::soil(model, 20, psi), {});
      for (const char* where : {"elastic", "cone", "apex"}) EXPECT_GE(met[where], enough) << where;
    }
  }
  auto met = compare<TypeParam::value>(points::soil("von_mises"), {});
  for (const char* where : {"elastic", "cone"}) EXPECT_GE(met[where], enough) << where;
  EXPECT_EQ(met["apex"], 0);
}

TYPED_TEST(Tangent, OfMohrCoulombEqualsDifferencesInEveryRegime) {
  for (const double psi : {0.0, 15.0, 30.0}) {
    auto met = compare<TypeParam::value>(points::soil("mohr_coulomb", 30, psi), {});
    for (const char* where : {"elastic", "plane", "compression edge", "extension edge", "apex"}) {
      EXPECT_GE(met[where], enough) << where;
    }
  }
  auto met = compare<TypeParam::value>(points::soil("mohr_coulomb", 0, 0), {});
  for (const char* where : {"elastic", "plane", "compression edge", "extension edge"}) {
    EXPECT_GE(met[where], enough) << where;
  }
  EXPECT_EQ(met["apex"], 0);
}

TYPED_TEST(Tangent, EqualsDifferencesBeyondTheDilationCutOff) {
  PointState<TypeParam::value> s0;
  s0.plastic_volume_strain = 0.02;
  for (const char* model : {"drucker_prager", "mohr_coulomb"}) {
    MaterialParameters p = points::soil(model, 30, 20);
    p.dilation_cutoff = 0.02;
    auto met = compare<TypeParam::value>(p, s0);
    EXPECT_GE(met["cone"] + met["plane"], enough);
  }
}

TYPED_TEST(Tangent, TimesStrainEqualsDifferencesOfTheSmallStrainUpdate) {
  constexpr int Dim = TypeParam::value;
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    const ElasticModuli& m = moduli(material);
    StressVector<Dim> trial = StressVector<Dim>::Constant(0.7 * p.cohesion);
    trial[0] = -4 * p.cohesion;
    trial[1] = 1 * p.cohesion;
    const PointState<Dim> s0;
    const double h = step * p.cohesion / m.shear;
    const TangentMatrix<Dim> t = tangent(material, trial, s0);
    for (int column = 0; column < stress_size<Dim>; ++column) {
      const StrainVector<Dim> strain = h * StrainVector<Dim>::Unit(column);
      PointState<Dim> a, b;
      (void)update(material, elastic_trial<Dim>(trial, strain, m), s0, a);
      (void)update(material, elastic_trial<Dim>(trial, StrainVector<Dim>(-strain), m), s0, b);
      ASSERT_NE(a.plastic_strain, 0);
      const StressVector<Dim> expected = (a.stress - b.stress) / (2 * h);
      EXPECT_LE((t.col(column) - expected).norm(), difference_error * m.bulk) << points::label(p);
    }
  }
}

TYPED_TEST(Tangent, IsSymmetricForAssociatedFlow) {
  constexpr int Dim = TypeParam::value;
  for (const char* model : {"drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    for (const double angle : {0.0, 25.0}) {
      const MaterialParameters p = points::soil(model, angle, angle);
      const Material material = make_material(p);
      points::RandomStress<Dim> random(3 * p.cohesion);
      for (int i = 0; i < 500; ++i) {
        const StressVector<Dim> trial = random();
        if (!is_clear<Dim>(trial)) continue;
        const TangentMatrix<Dim> t = tangent(material, trial, PointState<Dim>{});
        // Entries of the spin term carry the round-off of the directions divided by the clearance.
        ASSERT_LE((t - t.transpose()).norm(), points::round_off / clearance * moduli(material).bulk)
            << points::label(p) << " trial " << trial.transpose();
      }
    }
  }
}

TEST(MohrCoulombTangent, EqualsDifferencesAtEqualPrincipalStresses) {
  const Material material = make_material(points::soil("mohr_coulomb", 30, 10));
  const PointState<3> s0;
  const double c = 15e3;
  StressVector<3> compression, extension;
  compression << -c, -c, -9 * c, 0, 0, 0;
  extension << -9 * c, -9 * c, -c, 0, 0, 0;
  std::mt19937_64 engine(3);
  for (const StressVector<3>& principal : {compression, extension}) {
    const StressVector<3> trial = rotate(principal, points::random_rotation(engine));
    TangentMatrix<3> expected;
    ASSERT_TRUE(differences<3>(material, trial, s0, expected)) << regime(material, trial, s0);
    EXPECT_LE((trial_tangent(material, trial, s0) - expected).norm(), difference_error);
  }
}

TEST(MohrCoulombTangent, IsContinuousAsTwoPrincipalStressesMeet) {
  const Material material = make_material(points::soil("mohr_coulomb", 30, 10));
  const PointState<3> s0;
  const double c = 15e3;
  const auto at_gap = [&](double gap) {
    StressVector<3> trial;
    trial << -c, -c - gap * c, -9 * c, 0, 0, 0;
    return trial_tangent(material, trial, s0);
  };
  const TangentMatrix<3> limit = at_gap(0);
  // Both formulas for the spin, on either side of their switch at 2^-26 of the largest stress, lose
  // at most eps / 2^-26 = 1.5e-8 of O(1) entries; the tangent itself changes by O(gap).
  constexpr double loss = 4 * 0x1p-26;
  for (double gap = 1e-16; gap < 1e-3; gap *= 10) {
    EXPECT_LE((at_gap(gap) - limit).norm(), loss + 4 * gap) << gap;
  }
}

}  // namespace
