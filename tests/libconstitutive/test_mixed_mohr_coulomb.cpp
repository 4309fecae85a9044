#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <constitutive/mixed_mohr_coulomb.hpp>
#include <map>

#include "points.hpp"

// The block of sub-points that share one mean stress, on a surface with edges.
namespace {

using namespace constitutive;
template <int Dim>
using Block = MixedTrial<4, Dim>;

constexpr std::array<double, 4> weights{0.1, 0.4, 0.2, 0.3};
constexpr double cohesion = 15e3;

// A block's equation is solved through sums of stresses and multipliers times K over mu, here 4.7.
constexpr double block_round_off = 16 * points::round_off;

MohrCoulomb soil(double phi, double psi) {
  return std::get<MohrCoulomb>(make_material(points::soil("mohr_coulomb", phi, psi)));
}

template <int Dim>
class RandomBlock {
 public:
  explicit RandomBlock(double scale, unsigned seed = 5) : random_(scale, seed) {}
  Block<Dim> operator()() {
    Block<Dim> b;
    b.pressure = mean_stress(random_());
    for (auto& s : b.deviator) s = deviator(random_());
    return b;
  }

 private:
  points::RandomStress<Dim> random_;
};

template <int Dim>
double norm(const Block<Dim>& b) {
  double square = b.pressure * b.pressure;
  for (const auto& s : b.deviator) square += s.squaredNorm();
  return std::sqrt(square);
}

template <int Dim>
Block<Dim> combine(const Block<Dim>& a, double factor, const Block<Dim>& b) {
  Block<Dim> c{a.pressure + factor * b.pressure, {}};
  for (std::size_t k = 0; k < 4; ++k) c.deviator[k] = a.deviator[k] + factor * b.deviator[k];
  return c;
}

template <int Dim>
void expect_ordinary_update(double phi, double psi) {
  const MohrCoulomb m = soil(phi, psi);
  points::RandomStress<Dim> random(3 * cohesion);
  for (int i = 0; i < 2000; ++i) {
    StressVector<Dim> trial = random();
    if (i % 4 == 0) trial += isotropic<Dim>(5 * cohesion);
    PointState<Dim> s1;
    const UpdateOutcome outcome = update(m, trial, PointState<Dim>{}, s1);
    const MixedTrial<1, Dim> block{mean_stress(trial), {deviator(trial)}};
    const auto r = mixed_return(m, block, std::array<double, 1>{1.0}, 0.0);
    const double allowed = block_round_off * (trial.norm() + cohesion);
    ASSERT_EQ(r.outcome.plastic, outcome.plastic) << trial.transpose();
    ASSERT_NEAR(r.pressure, mean_stress(s1.stress), allowed) << trial.transpose();
    ASSERT_LE((r.deviator[0] - deviator(s1.stress)).norm(), allowed) << trial.transpose();
    const double strain = allowed / m.moduli.shear;
    ASSERT_NEAR(r.plastic_strain_increment, s1.plastic_strain, strain);
    ASSERT_NEAR(r.plastic_volume_increment, s1.plastic_volume_strain, strain);
  }
}

TEST(MixedMohrCoulomb, OfOnePointIsTheOrdinaryUpdate) {
  for (const auto& [phi, psi] :
       {std::pair{0.0, 0.0}, std::pair{30.0, 0.0}, std::pair{30.0, 10.0}, std::pair{40.0, 40.0}}) {
    expect_ordinary_update<2>(phi, psi);
    expect_ordinary_update<3>(phi, psi);
  }
}

// Each sub-point on or inside the surface at the block's pressure; what the sub-points dilate is
// what the pressure has changed by.
TEST(MixedMohrCoulomb, ReturnsToTheSurfaceWithOnePressure) {
  const MohrCoulomb m = soil(30, 10);
  RandomBlock<3> random(3 * cohesion);
  int apexes = 0, partial = 0;
  for (int i = 0; i < 2000; ++i) {
    Block<3> trial = random();
    if (i % 4 == 0) trial.pressure += 5 * cohesion;
    const auto r = mixed_return(m, trial, weights, 0.0);
    const double allowed = block_round_off * (norm(trial) + cohesion);
    double dilation = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const StressVector<3> stress = r.deviator[k] + isotropic<3>(r.pressure);
      ASSERT_LE(points::yield_function<3>(Material(m), stress), allowed);
      ASSERT_NEAR(trace(r.deviator[k]), 0.0, allowed);
      if (!r.yields[k]) {
        ASSERT_EQ(r.deviator[k], trial.deviator[k]);
      }
      dilation += 2 * m.moduli.bulk * m.sin_dilation * weights[k] * r.point[k].multiplier;
    }
    const bool all = std::ranges::all_of(r.yields, [](bool yields) { return yields; });
    apexes += r.outcome.apex ? 1 : 0;
    partial += r.outcome.plastic && !all ? 1 : 0;
    if (!r.outcome.apex) {
      ASSERT_NEAR(trial.pressure - r.pressure, dilation, allowed);
    }
  }
  EXPECT_GT(apexes, 50);
  EXPECT_GT(partial, 50);
}

TEST(MixedMohrCoulomb, DoesNotDilateBeyondTheCutOff) {
  MohrCoulomb m = soil(30, 10);
  m.dilation_cutoff = 0.05;
  Block<2> trial = RandomBlock<2>(3 * cohesion)();
  trial.pressure = -cohesion;
  EXPECT_EQ(mixed_return(m, trial, weights, 0.05).pressure, trial.pressure);
  EXPECT_LT(mixed_return(m, trial, weights, 0.04).pressure, trial.pressure);
}

TEST(MixedMohrCoulomb, RefusesWhatIsNotFinite) {
  Block<2> trial = RandomBlock<2>(cohesion)();
  trial.deviator[2][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(mixed_return(soil(30, 10), trial, weights, 0.0).outcome.failed);
}

/// Step relative to the size of the block. A return along planes is linear in the principal
/// stresses, whose directions turn at 1 / gap: truncation (step / least gap)^2.
constexpr double step = 1e-6;
constexpr double least_gap = 0.02;
constexpr double difference_error = 4e-7;

/// The regime of each sub-point and whether the block is at its apex: where it changes there is no
/// derivative.
template <int Dim>
std::array<int, 5> regimes(const MohrCoulomb& m, const Block<Dim>& trial) {
  const auto r = mixed_return(m, trial, weights, 0.0);
  std::array<int, 5> of{};
  of[4] = r.outcome.apex ? 1 : 0;
  for (std::size_t k = 0; k < 4; ++k) of[k] = static_cast<int>(r.point[k].returned.regime);
  return of;
}

template <int Dim>
bool has_gaps(const Block<Dim>& trial) {
  return std::ranges::all_of(trial.deviator, [&](const auto& s) {
    const Spectrum x = spectrum(s);
    return std::min(x.values[0] - x.values[1], x.values[1] - x.values[2]) > least_gap * norm(trial);
  });
}

template <int Dim>
std::map<int, int> compare(const MohrCoulomb& m) {
  RandomBlock<Dim> random(cohesion), direction_of(cohesion, 9);
  std::map<int, int> met;
  for (int i = 0; i < 6000; ++i) {
    Block<Dim> trial = random();
    const Block<Dim> direction = direction_of();
    if (i % 5 == 0) trial.pressure += 20 * cohesion;
    if (!has_gaps(trial)) continue;
    const double h = step * norm(trial) / norm(direction);
    const auto plus = combine(trial, h, direction), minus = combine(trial, -h, direction);
    const auto here = regimes(m, trial);
    if (regimes(m, plus) != here || regimes(m, minus) != here) continue;
    for (std::size_t k = 0; k < 4; ++k) ++met[here[4] == 1 ? 5 : here[k]];
    const auto at_plus = mixed_return(m, plus, weights, 0.0);
    const auto at_minus = mixed_return(m, minus, weights, 0.0);
    const auto change = combine(Block<Dim>{at_plus.pressure, at_plus.deviator}, -1,
                                Block<Dim>{at_minus.pressure, at_minus.deviator});
    const auto r = mixed_return(m, trial, weights, 0.0);
    Block<Dim> derivative;
    mixed_tangent(m, trial, weights, 0.0, r).apply_to_trial(direction, derivative);
    EXPECT_LE(norm(combine(derivative, -1 / (2 * h), change)), difference_error * norm(direction));
  }
  return met;
}

// Elastic, plane, both edges; the apex where there is one.
TEST(MixedMohrCoulomb, TangentEqualsDifferencesInEveryRegime) {
  for (const auto& [phi, psi] :
       {std::pair{0.0, 0.0}, std::pair{30.0, 0.0}, std::pair{30.0, 20.0}}) {
    for (const auto& met : {compare<2>(soil(phi, psi)), compare<3>(soil(phi, psi))}) {
      for (const int regime : {0, 1, 2, 3}) {
        ASSERT_TRUE(met.contains(regime)) << "the sample must meet every case, phi " << phi;
        EXPECT_GE(met.at(regime), 5);
      }
      EXPECT_EQ(met.contains(5), phi > 0.0);
    }
  }
}

}  // namespace
