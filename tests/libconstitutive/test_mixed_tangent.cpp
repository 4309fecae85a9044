#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <constitutive/mixed.hpp>
#include <map>

#include "points.hpp"

// The tangent of a block against central differences of its return.
namespace {

using namespace constitutive;
using Block = MixedTrial<4>;
using Weights = std::array<double, 4>;

constexpr Weights weights{0.1, 0.4, 0.2, 0.3};
constexpr double cohesion = 15e3;

/// Step relative to the sizes of the block; truncation step^2 times the curvature 1 / J^2 of s / J,
/// with J kept above `least_size` of the block: (1e-5 / 0.05)^2 = 4e-8 times a factor of order 10.
constexpr double step = 1e-5;
constexpr double least_size = 0.05;
constexpr double difference_error = 4e-7;

template <class Visitor>
void each_number(Block& b, Visitor&& visit) {
  visit(b.pressure);
  for (auto& s : b.deviator) {
    for (double& component : s) visit(component);
  }
}

Block combine(const Block& a, double factor, const Block& b) {
  Block c{a.pressure + factor * b.pressure, {}};
  for (std::size_t k = 0; k < 4; ++k) c.deviator[k] = a.deviator[k] + factor * b.deviator[k];
  return c;
}

double norm(Block b) {
  double square = 0;
  each_number(b, [&](double x) { square += x * x; });
  return std::sqrt(square);
}

template <class M>
Block stress_of(const M& m, const Block& trial, double volume) {
  const auto r = mixed_return(m, trial, weights, volume);
  return {r.pressure, r.deviator};
}

/// Regime of a block: its yielding points as bits, or 16 for the apex.
template <class M>
int regime(const M& m, const Block& trial, double volume) {
  const auto r = mixed_return(m, trial, weights, volume);
  if (r.outcome.status() == UpdateStatus::apex) return 16;
  int bits = 0;
  for (std::size_t k = 0; k < 4; ++k) bits |= r.yields[k] ? 1 << k : 0;
  return bits;
}

/// Number of yielding points, 5 for the apex.
int kind(int regime) {
  return regime == 16 ? 5 : std::popcount(static_cast<unsigned>(regime));
}

template <class M>
std::map<int, int> compare(const M& m, double volume) {
  points::RandomStress<2> random(cohesion), direction_of(cohesion, 9);
  std::map<int, int> met;
  for (int i = 0; i < 4000; ++i) {
    Block trial{mean_stress(random()), {}}, direction{mean_stress(direction_of()), {}};
    if (i % 5 == 0) trial.pressure += 20 * cohesion;  // towards the apex
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
      trial.deviator[k] = deviator(random());
      direction.deviator[k] = deviator(direction_of());
      smallest = std::min(smallest, sqrt_j2_of_deviator(trial.deviator[k]));
    }
    if (smallest < least_size * norm(trial)) continue;
    const double h = step * norm(trial) / norm(direction);
    const Block plus = combine(trial, h, direction), minus = combine(trial, -h, direction);
    const int here = regime(m, trial, volume);
    if (regime(m, plus, volume) != here || regime(m, minus, volume) != here) continue;
    ++met[kind(here)];
    const Block change = combine(stress_of(m, plus, volume), -1, stress_of(m, minus, volume));
    const auto r = mixed_return(m, trial, weights, volume);
    Block derivative;
    mixed_tangent(m, trial, weights, volume, r).apply_to_trial(direction, derivative);
    EXPECT_LE(norm(combine(derivative, -1 / (2 * h), change)), difference_error * norm(direction))
        << "yielding points as bits: " << here;
  }
  return met;
}

TEST(MixedTangent, EqualsDifferencesForEveryNumberOfYieldingPointsAndTheApex) {
  for (const double psi : {0.0, 10.0, 30.0}) {
    const auto m = std::get<DruckerPrager>(make_material(points::soil("drucker_prager", 30, psi)));
    const auto met = compare(m, 0);
    for (int number = 0; number <= 5; ++number) {
      ASSERT_TRUE(met.contains(number)) << "the sample must meet every case";
      EXPECT_GE(met.at(number), 5);
    }
  }
}

TEST(MixedTangent, EqualsDifferencesBeyondTheDilationCutOff) {
  auto m = std::get<DruckerPrager>(make_material(points::soil("drucker_prager", 30, 20)));
  m.dilation_cutoff = 0.05;
  const auto met = compare(m, 0.06);
  EXPECT_GE(met.at(2), 5);
}

TEST(MixedTangent, EqualsDifferencesForVonMisesAndElastic) {
  const ElasticModuli moduli = elastic_moduli(5e6, 0.4);
  EXPECT_GE(compare(VonMises{moduli, cohesion}, 0).at(3), 5);
  EXPECT_EQ(compare(Elastic{moduli}, 0).size(), 1u);
}

TEST(MixedTangent, AppliedToStrainIsItsApplicationToTheElasticTrial) {
  const auto m = std::get<DruckerPrager>(make_material(points::soil("drucker_prager", 30, 10)));
  points::RandomStress<2> random(3 * cohesion);
  Block trial{mean_stress(random()), {}}, elastic, by_trial, by_strain;
  std::array<StrainVector<2>, 4> strain;
  const double volume_strain = 0.3;
  elastic.pressure = m.moduli.bulk * volume_strain;
  for (std::size_t k = 0; k < 4; ++k) {
    trial.deviator[k] = deviator(random());
    strain[k] = deviator(random()) / cohesion;
    elastic.deviator[k] = elastic_stress<2>(m.moduli, strain[k]);
  }
  const auto r = mixed_return(m, trial, weights, 0.0);
  ASSERT_TRUE(r.outcome.plastic);
  const auto tangent = mixed_tangent(m, trial, weights, 0.0, r);
  tangent.apply_to_trial(elastic, by_trial);
  tangent.apply_to_strain(volume_strain, strain, by_strain);
  EXPECT_LE(norm(combine(by_trial, -1, by_strain)), points::round_off * norm(elastic));
}

TEST(MixedTangent, IsSymmetricInTheWeightedWorkForAssociatedFlow) {
  const auto m = std::get<DruckerPrager>(make_material(points::soil("drucker_prager", 30, 30)));
  points::RandomStress<2> random(3 * cohesion);
  for (int i = 0; i < 500; ++i) {
    Block trial{mean_stress(random()), {}};
    std::array<std::array<StrainVector<2>, 4>, 2> strain;
    for (std::size_t k = 0; k < 4; ++k) {
      trial.deviator[k] = deviator(random());
      for (auto& direction : strain) direction[k] = deviator(random()) / cohesion;
    }
    const std::array<double, 2> volume{0.7, -0.2};
    const auto r = mixed_return(m, trial, weights, 0.0);
    const auto tangent = mixed_tangent(m, trial, weights, 0.0, r);
    const auto work = [&](std::size_t a, std::size_t b) {
      Block stress;
      tangent.apply_to_strain(volume[a], strain[a], stress);
      double sum = stress.pressure * volume[b];
      for (std::size_t k = 0; k < 4; ++k) sum += weights[k] * stress.deviator[k].dot(strain[b][k]);
      return sum;
    };
    double size = 1;
    for (std::size_t k = 0; k < 4; ++k) size += strain[0][k].norm() * strain[1][k].norm();
    ASSERT_NEAR(work(0, 1), work(1, 0), points::round_off * m.moduli.bulk * size);
  }
}

}  // namespace
