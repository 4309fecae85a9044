#include <gtest/gtest.h>

#include <map>

#include "points.hpp"

// Modified Cam Clay: what its surface, its two lines of compression and its flow rule say.
namespace {

using namespace constitutive;

const MaterialParameters clay = points::clay();
const double lambda = clay.compression_index, kappa = clay.swelling_index;
const double slope = clay.critical_stress_ratio, preconsolidation = clay.preconsolidation_pressure;

const ModifiedCamClay& law() {
  static const Material material = make_material(clay);
  return std::get<ModifiedCamClay>(material);
}

template <int Dim>
double q_of(const StressVector<Dim>& stress) {
  return std::sqrt(3 * j2(stress));
}

template <int Dim>
PointState<Dim> at_pressure(double p) {
  PointState<Dim> s;
  s.stress = isotropic<Dim>(-p);
  return s;
}

template <int Dim>
UpdateOutcome strained(const StrainVector<Dim>& strain, PointState<Dim>& s) {
  return update(law(), StressVector<Dim>(s.stress + elastic_stress<Dim>(law().moduli, strain)), s,
                s);
}

StrainVector<3> compaction(double volume_strain) {
  StrainVector<3> strain = StrainVector<3>::Zero();
  strain.head<3>().setConstant(-volume_strain / 3);
  return strain;
}

// Each number of a return is known to some tens of roundings; the logarithms it is made of are
// about twenty.
constexpr double round_off = 1000 * points::eps;

// kappa ln p up to p_c, lambda ln p beyond, in however many steps.
TEST(ModifiedCamClay, FollowsTheLinesOfIsotropicCompressionAndSwelling) {
  const double end = 800e3, begin = 50e3;
  const double volume =
      kappa * std::log(preconsolidation / begin) + lambda * std::log(end / preconsolidation);
  for (const int steps : {1, 10}) {
    PointState<3> s = at_pressure<3>(begin);
    for (int i = 0; i < steps; ++i) ASSERT_FALSE(strained<3>(compaction(volume / steps), s).failed);
    EXPECT_NEAR(-mean_stress(s.stress), end, steps * round_off * end);
    EXPECT_NEAR(law().preconsolidation_at(s.plastic_volume_strain), end, steps * round_off * end);
    ASSERT_FALSE(strained<3>(compaction(-kappa * std::log(end / begin)), s).failed);
    EXPECT_NEAR(-mean_stress(s.stress), begin, steps * round_off * end) << "swelling";
    EXPECT_NEAR(law().preconsolidation_at(s.plastic_volume_strain), end, steps * round_off * end);
  }
}

// Without volume strain kappa ln(p_f / p_0) + (lambda - kappa) ln(2 p_f / p_c0) = 0 in the critical
// state, q_f = M p_f: p_f / p_0 = (R / 2)^((lambda - kappa) / lambda), R = p_c0 / p_0.
TEST(ModifiedCamClay, EndsUndrainedShearInTheCriticalStateOfItsVolume) {
  for (const double ratio : {1.0, 1.5, 2.0, 4.0, 10.0}) {
    const double begin = preconsolidation / ratio;
    const double expected = begin * std::pow(ratio / 2, (lambda - kappa) / lambda);
    PointState<3> s = at_pressure<3>(begin);
    StrainVector<3> strain = StrainVector<3>::Zero();
    strain.head<3>() << 0.5e-3, -1e-3, 0.5e-3;
    for (int i = 0; i < 1000; ++i) ASSERT_FALSE(strained<3>(strain, s).failed);
    // Of a relaxation that ends exponentially with the shear, by exp(-100) and more here.
    EXPECT_NEAR(-mean_stress(s.stress), expected, 1e-9 * expected) << "R " << ratio;
    EXPECT_NEAR(q_of<3>(s.stress), slope * expected, 1e-9 * expected) << "R " << ratio;
    EXPECT_NEAR(law().preconsolidation_at(s.plastic_volume_strain), 2 * expected, 1e-9 * expected);
  }
}

template <int Dim>
double yield_function(const PointState<Dim>& s) {
  const double p = -mean_stress(s.stress), q = q_of<Dim>(s.stress);
  const double pc = law().preconsolidation_at(s.plastic_volume_strain);
  return q * q / (slope * slope) + p * (p - pc);
}

template <class Dimension>
class CamClay : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(CamClay, Dimensions);

/// A state inside its surface and a strain from it, small to a fifth, wet and dry.
template <int Dim>
class Samples {
 public:
  void draw() {
    std::uniform_real_distribution<double> share(0.02, 0.95);
    begin = at_pressure<Dim>(preconsolidation * share(engine_));
    const double p = -mean_stress(begin.stress);
    const double room = slope * std::sqrt(p * (preconsolidation - p));
    StressVector<Dim> direction = deviator(stress_());
    begin.stress += direction * (0.8 * share(engine_) * room / q_of<Dim>(direction));
    std::uniform_real_distribution<double> decades(-4, -0.7);
    strain = stress_();
    strain *= std::pow(10, decades(engine_)) / strain.norm();
    trial = begin.stress + elastic_stress<Dim>(law().moduli, strain);
  }
  PointState<Dim> begin;
  StrainVector<Dim> strain;
  StressVector<Dim> trial;

 private:
  std::mt19937_64 engine_{7};
  points::RandomStress<Dim> stress_{1.0};
};

// On the surface at the end; flow along its gradient there; elasticity between what is not plastic.
TYPED_TEST(CamClay, EndsOnItsSurfaceByAssociatedFlow) {
  constexpr int Dim = TypeParam::value;
  Samples<Dim> of;
  int wet = 0, dry = 0;
  for (int i = 0; i < 3000; ++i) {
    of.draw();
    PointState<Dim> end;
    const UpdateOutcome outcome = update(law(), of.trial, of.begin, end);
    ASSERT_FALSE(outcome.failed);
    if (!outcome.plastic || outcome.apex) continue;
    const double p = -mean_stress(end.stress), q = q_of<Dim>(end.stress);
    const double pc = law().preconsolidation_at(end.plastic_volume_strain);
    EXPECT_NEAR(yield_function<Dim>(end), 0, round_off * (q * q / (slope * slope) + p * (p + pc)));
    const double x = of.begin.plastic_volume_strain - end.plastic_volume_strain;
    const double shear = (q_of<Dim>(of.trial) - q) / (3 * law().moduli.shear);
    // (dq : dp) = (2 q / M^2) : (2 p - p_c).
    const double size = std::hypot(2 * q / (slope * slope), 2 * p - pc);
    const double off = (shear * (2 * p - pc) - x * 2 * q / (slope * slope)) / size;
    const double strains = of.strain.norm() + of.begin.stress.norm() / law().moduli.shear;
    EXPECT_NEAR(off, 0, round_off * strains);
    const double elastic = -trace(of.strain) - x;
    EXPECT_NEAR(std::log(p / -mean_stress(of.begin.stress)), elastic / kappa,
                round_off * (1 + strains / kappa));
    (2 * p > pc ? wet : dry) += 1;
  }
  EXPECT_GT(wet, 200);
  EXPECT_GT(dry, 200);
}

TYPED_TEST(CamClay, HasTheTangentOfDifferences) {
  constexpr int Dim = TypeParam::value;
  Samples<Dim> of;
  std::map<std::string, int> met;
  for (int i = 0; i < 2000; ++i) {
    of.draw();
    // The pressure doubles with kappa ln 2 of strain: differences are small beside that.
    const double h = 1e-5 * std::min(of.trial.norm(), 0.03 * kappa * law().moduli.bulk);
    const auto kind = [&](const StressVector<Dim>& trial) {
      PointState<Dim> end;
      const UpdateOutcome outcome = update(law(), trial, of.begin, end);
      const std::string where = outcome.apex ? "open " : "closed ";
      return where + (outcome.plastic ? "plastic" : "elastic");
    };
    const std::string here = kind(of.trial);
    TangentMatrix<Dim> expected;
    bool smooth = q_of<Dim>(of.trial) > 0.05 * preconsolidation;
    for (int column = 0; column < stress_size<Dim>; ++column) {
      const StressVector<Dim> move = h * StressVector<Dim>::Unit(column);
      PointState<Dim> a, b;
      (void)update(law(), StressVector<Dim>(of.trial + move), of.begin, a);
      (void)update(law(), StressVector<Dim>(of.trial - move), of.begin, b);
      smooth = smooth && kind(of.trial + move) == here && kind(of.trial - move) == here;
      expected.col(column) = (a.stress - b.stress) / (2 * h);
    }
    if (!smooth) continue;
    ++met[here];
    // Truncation 1e-10 times third derivatives over h; round-off of the stresses over h is 1e-9.
    EXPECT_LE((trial_tangent(law(), of.trial, of.begin) - expected).norm(),
              1e-6 * (1 + expected.norm()))
        << here << " trial " << of.trial.transpose() << " begin " << of.begin.stress.transpose();
  }
  for (const char* where : {"closed elastic", "closed plastic"})
    EXPECT_GT(met[where], 100) << where;
}

TEST(ModifiedCamClay, ReturnsAnAdmissibleTrialWithoutVolumeStrainBitForBit) {
  PointState<3> s0 = at_pressure<3>(100e3), s1;
  StressVector<3> trial = s0.stress;
  trial[3] = 10e3;
  EXPECT_FALSE(update(law(), trial, s0, s1).plastic);
  EXPECT_EQ(s1.stress, trial);
}

// Found by random_increments: a step that takes away all but a millionth of a pressure. The trial
// has the pressure of its beginning, whose round-off is 1e-10 of the deviator at the end; with that
// much of a trace in it the end was off the surface, in a state that softens faster than it
// unloads.
TEST(ModifiedCamClay, EndsOnItsSurfaceFarBelowThePressureOfItsBeginning) {
  ModifiedCamClay soft;
  soft.moduli.shear = 956585998.43538988;
  soft.moduli.bulk = 1718431200.5956302;
  soft.slope = 0.75286138461694252;
  soft.compression = 0.040932046307207801;
  soft.swelling = 0.019087567771819899;
  soft.preconsolidation = 6407630.6684317458;
  PointState<2> s, again;
  s.stress << -3611589610534607, -3611592870274629, -3611592883895245, 808979475.90428388;
  s.plastic_volume_strain = -0.51788704402513619;
  StressVector<2> trial;
  trial << -3611587748385355.5, -3611591290609703.5, -3611590531034928, 372058655.34452176;
  ASSERT_TRUE(update(soft, trial, s, s).plastic);
  ASSERT_LT(-mean_stress(s.stress), -1e-6 * mean_stress(trial));
  EXPECT_FALSE(update(soft, s.stress, s, again).plastic);
  EXPECT_EQ(again.stress, s.stress);
}

TEST(ModifiedCamClay, BearsNoTension) {
  PointState<3> s = at_pressure<3>(100e3);
  const UpdateOutcome outcome = strained<3>(compaction(-0.5), s);
  EXPECT_EQ(outcome.status(), UpdateStatus::apex);
  // The deviator of the trial, which is none, is a difference of numbers of its size.
  const double allowed = points::round_off * law().moduli.bulk;
  EXPECT_NEAR(-mean_stress(s.stress), law().least_pressure(), allowed);
  ASSERT_FALSE(strained<3>(compaction(0.1), s).failed);
  EXPECT_LT(mean_stress(s.stress), 0);
}

TEST(ModifiedCamClay, LeavesTheStateWhereThePressureIsNoNumber) {
  const PointState<3> s0 = at_pressure<3>(100e3);
  PointState<3> s1;
  StressVector<3> trial = s0.stress;
  trial[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(update(law(), trial, s0, s1).status(), UpdateStatus::failed);
  EXPECT_EQ(s1.stress, s0.stress);
}

}  // namespace
