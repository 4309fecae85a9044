#include <gmock/gmock.h>

#include <map>

#include "constitutive/spectral.hpp"
#include "points.hpp"

// Cohesion and friction that go to residual values with the plastic strain.
namespace {

using namespace constitutive;

struct Residual {
  double cohesion, friction;  // over those of the soil
};
constexpr Residual softer{0.4, 0.7}, harder{2.0, 1.3}, looser{0.5, 1.2};

MaterialParameters soil(const std::string& model, const Residual& residual, double strain = 0.05) {
  MaterialParameters p = points::soil(model, 25, 10);
  p.residual_strain = strain;
  p.residual_cohesion = residual.cohesion * p.cohesion;
  if (model != "von_mises") p.residual_friction_angle = residual.friction * p.friction_angle;
  return p;
}

std::vector<MaterialParameters> soils() {
  std::vector<MaterialParameters> all;
  for (const char* model :
       {"von_mises", "drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    for (const Residual& residual : {softer, harder, looser}) all.push_back(soil(model, residual));
  }
  return all;
}

/// The soil that is as strong for good as this one is at a plastic strain.
MaterialParameters frozen(MaterialParameters p, double k) {
  const double share = std::min(1.0, k / p.residual_strain);
  p.cohesion += share * (p.residual_cohesion - p.cohesion);
  if (std::isfinite(p.residual_friction_angle)) {
    p.friction_angle += share * (p.residual_friction_angle - p.friction_angle);
  }
  p.residual_strain = p.residual_cohesion = p.residual_friction_angle =
      std::numeric_limits<double>::infinity();
  return p;
}

template <class Dimension>
class Hardening : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Hardening, Dimensions);

// What an implicit return is: the return of the perfectly plastic soil of the strength at the end,
// with the plastic strain that makes that strength.
TYPED_TEST(Hardening, EndsOnTheSurfaceOfItsOwnEnd) {
  constexpr int Dim = TypeParam::value;
  int plastic = 0;
  for (const MaterialParameters& p : soils()) {
    const Material material = make_material(p);
    points::RandomStress<Dim> random(3 * p.cohesion);
    for (int i = 0; i < 1000; ++i) {
      PointState<Dim> s0, s1, end;
      s0.plastic_strain = (i % 5) * 0.015;  // from none to beyond the residual strain
      const StressVector<Dim> trial = random();
      const UpdateOutcome outcome = update(material, trial, s0, s1);
      ASSERT_FALSE(outcome.failed);
      if (!outcome.plastic) continue;
      ++plastic;
      (void)update(make_material(frozen(p, s1.plastic_strain)), trial, s0, end);
      // A difference of k moves the strength by its part of the residual strain; k is a root of an
      // equation whose slope is 1 / 20 at least in this sample.
      const double allowed =
          20 * points::round_off * (points::magnitude<Dim>(trial, p) + moduli(material).bulk);
      EXPECT_LE((s1.stress - end.stress).norm(), allowed) << points::label(p);
      EXPECT_NEAR(s1.plastic_strain, end.plastic_strain, allowed / moduli(material).shear)
          << points::label(p) << " trial " << trial.transpose();
      PointState<Dim> again;
      EXPECT_FALSE(update(material, s1.stress, s1, again).failed);
      EXPECT_LE((again.stress - s1.stress).norm(),
                points::round_off * points::magnitude<Dim>(trial, p))
          << points::label(p);
    }
  }
  EXPECT_GT(plastic, 5000);
}

TYPED_TEST(Hardening, WithResidualsEqualToThePeakIsPerfectlyPlastic) {
  constexpr int Dim = TypeParam::value;
  for (const char* model :
       {"von_mises", "drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    const MaterialParameters p = soil(model, {1, 1});
    const Material changing = make_material(p), perfect = make_material(frozen(p, 0));
    points::RandomStress<Dim> random(3 * p.cohesion);
    for (int i = 0; i < 1000; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, a, b;
      (void)update(changing, trial, s0, a);
      (void)update(perfect, trial, s0, b);
      const double allowed = points::round_off * points::magnitude<Dim>(trial, p);
      EXPECT_LE((a.stress - b.stress).norm(), allowed) << model;
      EXPECT_NEAR(a.plastic_strain, b.plastic_strain, allowed / moduli(perfect).shear) << model;
      EXPECT_NEAR(a.plastic_volume_strain, b.plastic_volume_strain, allowed / moduli(perfect).bulk)
          << model;
    }
  }
}

/// The smooth piece a trial returns on.
template <int Dim>
std::string regime(const HardeningSoil& m, const StressVector<Dim>& trial,
                   const PointState<Dim>& s0) {
  const auto step = detail::hardening_step_of(m, s0, spectrum(trial).values);
  if (!step.at.plastic) return "elastic";
  const std::string where = step.strain > m.residual_strain ? "residual " : "changing ";
  if (step.at.apex) return where + "apex";
  const bool first = step.at.stress[0] == step.at.stress[1];
  const bool last = step.at.stress[1] == step.at.stress[2];
  return where + (first ? "compression edge" : last ? "extension edge" : "smooth");
}

template <int Dim>
std::map<std::string, int> compare(const MaterialParameters& p) {
  constexpr double step = 1e-5, clearance = 0.05;
  // As in test_tangent, with the curvature of the strength's change beside it.
  constexpr double difference_error = 2e-6;
  const Material material = make_material(p);
  const auto& soil = std::get<HardeningSoil>(material);
  points::RandomStress<Dim> random(3 * p.cohesion);
  std::map<std::string, int> met;
  for (int i = 0; i < 3000; ++i) {
    StressVector<Dim> trial = random();
    if (i % 3 == 0) trial += isotropic<Dim>(2 * trial.norm());
    PointState<Dim> s0;
    s0.plastic_strain = (i % 4) * 0.02;
    const Eigen::Vector3d x = spectrum(trial).values;
    if (std::min(x[0] - x[1], x[1] - x[2]) < clearance * trial.norm()) continue;
    const std::string here = regime<Dim>(soil, trial, s0);
    TangentMatrix<Dim> expected;
    bool smooth = true;
    const double h = step * trial.norm();
    for (int column = 0; column < stress_size<Dim>; ++column) {
      const StressVector<Dim> move = h * StressVector<Dim>::Unit(column);
      smooth = smooth && regime<Dim>(soil, trial + move, s0) == here &&
               regime<Dim>(soil, trial - move, s0) == here;
      PointState<Dim> a, b;
      (void)update(material, StressVector<Dim>(trial + move), s0, a);
      (void)update(material, StressVector<Dim>(trial - move), s0, b);
      expected.col(column) = (a.stress - b.stress) / (2 * h);
    }
    if (!smooth) continue;
    ++met[here];
    EXPECT_LE((trial_tangent(material, trial, s0) - expected).norm(), difference_error)
        << points::label(p) << " " << here << " trial " << trial.transpose();
  }
  return met;
}

TYPED_TEST(Hardening, HasTheTangentOfDifferencesInEveryRegime) {
  constexpr int enough = 20;
  std::map<std::string, int> met;
  for (const MaterialParameters& p : soils()) {
    for (const auto& [where, count] : compare<TypeParam::value>(p)) met[where] += count;
  }
  for (const char* where :
       {"elastic", "changing smooth", "changing compression edge", "changing extension edge",
        "changing apex", "residual smooth", "residual compression edge", "residual extension edge",
        "residual apex"}) {
    EXPECT_GE(met[where], enough) << where;
  }
}

// tau = c(k) with k = gamma_p / sqrt 3, gamma_p = gamma - tau / G: linear in gamma up to the
// residual strain, and the same in one step as in many.
TEST(HardeningInShear, FollowsItsStraightLineInAnyNumberOfSteps) {
  for (const Residual& residual : {softer, harder}) {
    const MaterialParameters p = soil("von_mises", residual);
    const Material material = make_material(p);
    const double shear = moduli(material).shear;
    const double slope = (p.residual_cohesion - p.cohesion) / p.residual_strain / std::sqrt(3.0);
    for (const double gamma : {0.02, 0.06, 0.3}) {
      const double changing = (p.cohesion + slope * gamma) / (1 + slope / shear);
      const double k = (gamma - changing / shear) / std::sqrt(3.0);
      const double expected = k < p.residual_strain ? changing : p.residual_cohesion;
      for (const int steps : {1, 7}) {
        PointState<2> s;
        const StrainVector<2> part = StrainVector<2>::Unit(3) * (gamma / steps);
        for (int i = 0; i < steps; ++i) {
          const StressVector<2> trial = s.stress + elastic_stress<2>(moduli(material), part);
          ASSERT_FALSE(update(material, trial, s, s).failed);
        }
        EXPECT_NEAR(s.stress[3], expected, 1e-12 * shear) << gamma << " in " << steps;
      }
    }
  }
}

// A step whose plastic strain is lost in the rounding of what has accumulated ends all the same.
TEST(HardeningInShear, EndsAStepThatIsBelowRoundOff) {
  for (const Residual& residual : {softer, harder}) {
    MaterialParameters p = soil("von_mises", residual);
    p.youngs_modulus *= 1000;  // so that what the excess strains is far below 0.04 eps
    const Material material = make_material(p);
    PointState<2> s0;
    s0.plastic_strain = 0.04;
    const double strength = std::get<HardeningSoil>(material).cohesion_at(s0.plastic_strain);
    for (double excess = 0x1p-46; excess > 0x1p-60; excess /= 2) {
      const StressVector<2> trial = StressVector<2>::Unit(3) * (strength * (1 + excess));
      PointState<2> s1;
      ASSERT_FALSE(update(material, trial, s0, s1).failed);
      EXPECT_NEAR(s1.stress[3], strength, points::round_off * strength);
    }
  }
}

// Where strength is lost faster than elasticity gives way no state lies near the one before; the
// step still ends on a surface of its own end.
TEST(HardeningInShear, ThatFallsSteeplyEndsAtTheResidualStrength) {
  const MaterialParameters p = soil("von_mises", softer, 1e-6);
  const Material material = make_material(p);
  PointState<2> s;
  const StrainVector<2> strain = StrainVector<2>::Unit(3) * 0.02;
  ASSERT_FALSE(update(material, elastic_stress<2>(moduli(material), strain), s, s).failed);
  EXPECT_NEAR(s.stress[3], p.residual_cohesion, 1e-12 * moduli(material).shear);
}

TEST(HardeningSoil, LeavesSubpointsToOthers) {
  const Material material = make_material(soil("von_mises", softer));
  MixedTrial<4> trial;
  for (auto& s : trial.deviator) s.setZero();
  const auto r = mixed_return(std::get<HardeningSoil>(material), trial,
                              std::array<double, 4>{0.25, 0.25, 0.25, 0.25}, 0.0);
  EXPECT_TRUE(r.outcome.failed);
}

}  // namespace
