#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <constitutive/mixed.hpp>
#include <set>

#include "points.hpp"

// The block of sub-points that share one mean stress.
namespace {

using namespace constitutive;
using Block = MixedTrial<4>;
using Weights = std::array<double, 4>;

constexpr Weights quarters{0.25, 0.25, 0.25, 0.25};
constexpr Weights uneven{0.1, 0.4, 0.2, 0.3};
constexpr double cohesion = 15e3;

DruckerPrager drucker_prager(double phi, double psi) {
  return std::get<DruckerPrager>(make_material(points::soil("drucker_prager", phi, psi)));
}

class RandomBlock {
 public:
  explicit RandomBlock(double scale, unsigned seed = 5) : random_(scale, seed) {}

  Block operator()() {
    Block b;
    b.pressure = mean_stress(random_());
    for (auto& s : b.deviator) s = deviator(random_());
    return b;
  }

 private:
  points::RandomStress<2> random_;
};

double size(const Block& b) {
  double sum = cohesion + std::abs(b.pressure);
  for (const auto& s : b.deviator) sum += s.norm();
  return sum;
}

/// Left side of the pressure equation, as on paper.
double pressure_equation(const DruckerPrager& m, const Block& b, const Weights& w, double p) {
  double multiplier = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const double f = sqrt_j2_of_deviator(b.deviator[k]) - m.cone.radius(p);
    multiplier += w[k] * std::max(0.0, f) / m.moduli.shear;
  }
  return p - b.pressure + 3 * m.moduli.bulk * m.cone.beta * multiplier;
}

TEST(MixedReturn, OfOnePointIsTheOrdinaryUpdateBitForBit) {
  const DruckerPrager m = drucker_prager(30, 10);
  points::RandomStress<2> random(3 * cohesion);
  for (int i = 0; i < 1000; ++i) {
    const StressVector<2> trial = random();
    PointState<2> s0, s1;
    const UpdateOutcome ordinary = update(m, trial, s0, s1);
    const MixedTrial<1> block{mean_stress(trial), {deviator(trial)}};
    const MixedResult<1> r = mixed_return(m, block, std::array{1.0}, 0.0);
    ASSERT_EQ(r.outcome.plastic, ordinary.plastic);
    ASSERT_EQ(r.outcome.status(), ordinary.status());
    ASSERT_EQ(r.plastic_strain_increment, s1.plastic_strain);
    if (!r.outcome.plastic) continue;
    ASSERT_EQ(StressVector<2>(r.deviator[0] + isotropic<2>(r.pressure)), s1.stress);
  }
}

TEST(MixedReturn, OfEquallyStressedPointsIsTheOrdinaryUpdateOfEach) {
  // Equal sizes J_k suffice; the directions may differ.
  const DruckerPrager m = drucker_prager(30, 10);
  points::RandomStress<2> random(3 * cohesion);
  for (int i = 0; i < 1000; ++i) {
    const double p = mean_stress(random()), j = std::abs(mean_stress(random()));
    Block block{p, {}};
    for (auto& s : block.deviator) {
      s = deviator(random());
      s *= j / sqrt_j2_of_deviator(s);
    }
    const MixedResult<4> r = mixed_return(m, block, uneven, 0.0);
    for (std::size_t k = 0; k < 4; ++k) {
      PointState<2> s0, s1;
      (void)update(m, StressVector<2>(block.deviator[k] + isotropic<2>(p)), s0, s1);
      const double allowed = points::round_off * size(block);
      ASSERT_NEAR(r.pressure, mean_stress(s1.stress), allowed);
      ASSERT_LE((r.deviator[k] - deviator(s1.stress)).norm(), allowed);
      ASSERT_NEAR(r.plastic_strain_increment, s1.plastic_strain, allowed / m.moduli.shear);
      ASSERT_NEAR(r.plastic_volume_increment, s1.plastic_volume_strain, allowed / m.moduli.bulk);
    }
  }
}

TEST(MixedReturn, SolvesThePressureEquationExactlyForEveryNumberOfYieldingPoints) {
  for (const double psi : {0.0, 10.0, 30.0}) {
    const DruckerPrager m = drucker_prager(30, psi);
    RandomBlock random(cohesion);
    std::set<long> numbers;
    for (int i = 0; i < 3000; ++i) {
      const Block block = random();
      const MixedResult<4> r = mixed_return(m, block, uneven, 0.0);
      const auto yielding = std::count(r.yields.begin(), r.yields.end(), true);
      numbers.insert(yielding);
      ASSERT_EQ(r.outcome.plastic, yielding > 0);
      const double slope = 1 + 9 * m.moduli.bulk * m.cone.alpha * m.cone.beta / m.moduli.shear;
      const double allowed = points::round_off * slope * size(block);
      if (r.outcome.status() == UpdateStatus::apex) {
        ASSERT_DOUBLE_EQ(r.pressure, m.cone.apex_pressure());
        // Increasing left side, still negative at the apex: the root lies beyond it.
        ASSERT_LE(pressure_equation(m, block, uneven, r.pressure), allowed);
        continue;
      }
      ASSERT_NEAR(pressure_equation(m, block, uneven, r.pressure), 0, allowed);
      double dilation = 0;
      for (std::size_t k = 0; k < 4; ++k) {
        const double j = sqrt_j2_of_deviator(r.deviator[k]);
        ASSERT_LE(j, m.cone.radius(r.pressure) + points::round_off * size(block));
        dilation += uneven[k] * 3 * m.cone.beta * (sqrt_j2_of_deviator(block.deviator[k]) - j) /
                    m.moduli.shear;
      }
      ASSERT_NEAR(r.plastic_volume_increment, dilation, allowed / m.moduli.shear);
    }
    EXPECT_EQ(numbers, (std::set<long>{0, 1, 2, 3, 4})) << "the sample must meet every case";
  }
}

TEST(MixedReturn, DoesNotDependOnTheOrderOfItsPoints) {
  const DruckerPrager m = drucker_prager(30, 20);
  RandomBlock random(3 * cohesion);
  for (int i = 0; i < 300; ++i) {
    const Block block = random();
    const MixedResult<4> r = mixed_return(m, block, uneven, 0.0);
    std::array<std::size_t, 4> order{0, 1, 2, 3};
    while (std::next_permutation(order.begin(), order.end())) {
      Block turned = block;
      Weights weights;
      for (std::size_t k = 0; k < 4; ++k) {
        turned.deviator[k] = block.deviator[order[k]];
        weights[k] = uneven[order[k]];
      }
      const MixedResult<4> t = mixed_return(m, turned, weights, 0.0);
      ASSERT_EQ(t.pressure, r.pressure);
      for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(t.deviator[k], r.deviator[order[k]]);
    }
  }
}

TEST(MixedReturn, KeepsAnUnstressedPointAtZero) {
  const DruckerPrager m = drucker_prager(30, 10);
  Block block;
  for (auto& s : block.deviator) s.setZero();
  block.deviator[2] << 3 * cohesion, -3 * cohesion, 0, cohesion;
  const MixedResult<4> r = mixed_return(m, block, quarters, 0.0);
  EXPECT_EQ(r.yields, (std::array{false, false, true, false}));
  EXPECT_TRUE(r.deviator[0].isZero(0));
  block.pressure = 100 * cohesion;
  for (auto& s : block.deviator) s.setZero();
  const MixedResult<4> apex = mixed_return(m, block, quarters, 0.0);
  EXPECT_EQ(apex.outcome.status(), UpdateStatus::apex);
  EXPECT_TRUE(std::isfinite(apex.plastic_strain_increment));
}

TEST(MixedReturn, AveragesTheRemovedStrainOverItsPointsAtTheApex) {
  const DruckerPrager m = drucker_prager(30, 10);
  RandomBlock random(cohesion);
  Block block = random();
  block.pressure = 1e3 * cohesion;
  const MixedResult<4> r = mixed_return(m, block, uneven, 0.0);
  ASSERT_EQ(r.outcome.status(), UpdateStatus::apex);
  double expected = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    PointState<2> s0, s1;
    (void)update(m, StressVector<2>(block.deviator[k] + isotropic<2>(block.pressure)), s0, s1);
    expected += uneven[k] * s1.plastic_strain;
  }
  EXPECT_NEAR(r.plastic_strain_increment, expected, points::round_off * expected);
}

TEST(MixedReturn, DoesNotDilateBeyondTheCutOff) {
  DruckerPrager m = drucker_prager(30, 20);
  m.dilation_cutoff = 0.05;
  Block block{-cohesion, {}};
  for (auto& s : block.deviator) s << 4 * cohesion, -4 * cohesion, 0, 0;
  EXPECT_GT(mixed_return(m, block, quarters, 0.049).plastic_volume_increment, 0);
  const MixedResult<4> beyond = mixed_return(m, block, quarters, 0.05);
  EXPECT_TRUE(beyond.outcome.plastic);
  EXPECT_EQ(beyond.plastic_volume_increment, 0);
  EXPECT_EQ(beyond.pressure, block.pressure);
}

TEST(MixedReturn, ReportsANonFiniteTrialAsFailed) {
  const DruckerPrager dp = drucker_prager(30, 20);
  const VonMises vm{dp.moduli, cohesion};
  const Elastic elastic{dp.moduli};
  for (std::size_t k = 0; k < 5; ++k) {
    Block block;
    for (auto& s : block.deviator) s.setZero();
    (k < 4 ? block.deviator[k][3] : block.pressure) = std::nan("");
    EXPECT_EQ(mixed_return(dp, block, quarters, 0.0).outcome.status(), UpdateStatus::failed);
    EXPECT_EQ(mixed_return(vm, block, quarters, 0.0).outcome.status(), UpdateStatus::failed);
    EXPECT_EQ(mixed_return(elastic, block, quarters, 0.0).outcome.status(), UpdateStatus::failed);
  }
}

}  // namespace
