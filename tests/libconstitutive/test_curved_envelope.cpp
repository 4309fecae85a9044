#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>

#include "constitutive/spectral.hpp"
#include "constitutive/strength_reduction.hpp"
#include "points.hpp"

// Hoek-Brown and power-law envelopes: strengths in closed form, Koiter's rule, tangents.
namespace {

using namespace constitutive;
using detail::MohrCoulombRegime;
using detail::return_principal;

CurvedEnvelope envelope(const char* model, double dilation_ratio, double factor = 1) {
  MaterialParameters p = points::soil(model);
  p.dilation_ratio = dilation_ratio;
  return std::get<CurvedEnvelope>(make_material(with_strength_over(p, factor)));
}

constexpr std::array<const char*, 2> models{"hoek_brown", "power_law"};

// A stress that the models above are of.
constexpr double scale = 1e6;

// Hoek, Carranza-Torres & Corkum 2002, eqs 3 to 5: GSI = 100 is intact rock, a = 1/2 there and
// almost 2/3 at 0; at D = 1 the divisors are 14 and 6.
TEST(HoekBrown, HasTheConstantsOfItsGeologicalStrengthIndex) {
  MaterialParameters p = points::soil("hoek_brown");
  const auto made = [&](double gsi, double disturbance) {
    p.gsi = gsi;
    p.disturbance = disturbance;
    return std::get<CurvedEnvelope>(make_material(p));
  };
  const CurvedEnvelope intact = made(100, 0.5);
  EXPECT_DOUBLE_EQ(intact.coefficient, p.m_i);
  EXPECT_DOUBLE_EQ(intact.cohesive, 1);
  EXPECT_NEAR(intact.exponent, 0.5, 1e-15);
  const CurvedEnvelope weak = made(0, 0);
  EXPECT_NEAR(weak.exponent, 0.5 + (1 - std::exp(-20.0 / 3)) / 6, 1e-15);
  EXPECT_NEAR(weak.coefficient, p.m_i * std::exp(-100.0 / 28), 1e-14);
  EXPECT_NEAR(weak.cohesive, std::exp(-100.0 / 9), 1e-18);
  const CurvedEnvelope blasted = made(44, 1);
  EXPECT_NEAR(blasted.coefficient, p.m_i * std::exp(-4.0), 1e-14);
  EXPECT_NEAR(blasted.cohesive, std::exp(-56.0 / 6), 1e-16);
}

// sigma_1 = sigma_3 + sigma_ci (m_b sigma_3 / sigma_ci + s)^a, whatever the intermediate stress;
// tau = A p_r ((sigma_n + T) / p_r)^b is touched by the circle and exceeded nowhere on it.
TEST(CurvedEnvelopes, HaveTheStrengthsOfTheirFormulas) {
  const CurvedEnvelope rock = envelope("hoek_brown", 0.3);
  for (const double cell : {0.0, 0.1 * scale, 10 * scale}) {
    const double strength =
        cell + rock.stress *
                   std::pow(rock.coefficient * cell / rock.stress + rock.cohesive, rock.exponent);
    for (const double share : {0.0, 0.5, 1.0}) {
      const double middle = cell + share * (strength - cell);
      const Eigen::Vector3d at(-cell, -middle, -strength);
      constexpr double close = 1e-9;
      EXPECT_EQ(return_principal(rock, (1 - close) * at).regime, MohrCoulombRegime::elastic);
      EXPECT_NE(return_principal(rock, (1 + close) * at).regime, MohrCoulombRegime::elastic);
    }
  }
  const CurvedEnvelope soil = envelope("power_law", 0.3);
  const auto r = return_principal(soil, Eigen::Vector3d(0, -2 * scale, -5 * scale));
  ASSERT_EQ(r.regime, MohrCoulombRegime::plane);
  const double centre = -(r.stress[0] + r.stress[2]) / 2, radius = (r.stress[0] - r.stress[2]) / 2;
  double most = -scale;
  for (int i = 1; i < 20000; ++i) {
    const double angle = i * 1.5707963267948966 / 20000;
    const double normal = centre - radius * std::cos(angle);
    if (normal <= -soil.apex()) continue;
    most = std::max(most, radius * std::sin(angle) -
                              soil.coefficient * soil.stress *
                                  std::pow((normal + soil.apex()) / soil.stress, soil.exponent));
  }
  // The largest of a parabola of curvature about 1 / radius sampled every radius / 12 700.
  EXPECT_NEAR(most, 0, 1e-8 * radius);
}

// Shear strengths over the factor under every normal stress: a power law with A over it.
TEST(CurvedEnvelopes, AreDividedAlongEveryNormalStress) {
  const CurvedEnvelope divided = envelope("power_law", 0.5, 1.7);
  CurvedEnvelope weaker = envelope("power_law", 0.5);
  weaker.coefficient /= 1.7;
  points::RandomStress<3> random(3 * scale);
  for (int i = 0; i < 200; ++i) {
    Eigen::Vector3d trial = random().head<3>();
    std::sort(trial.data(), trial.data() + 3, std::greater<>());
    const auto one = return_principal(divided, trial), other = return_principal(weaker, trial);
    EXPECT_LE((one.stress - other.stress).norm(), 1e-12 * (trial.norm() + scale));
  }
}

Eigen::Vector3d elastic(const CurvedEnvelope& m, const Eigen::Vector3d& strain) {
  return 2 * m.moduli.shear * strain + Eigen::Vector3d::Constant(m.moduli.lame * strain.sum());
}

// What is removed is D times flows (K_psi, 0, -1) of the planes that meet there, by multipliers
// that are not negative: K by differences of the envelope.
TEST(CurvedReturn, ObeysKoitersRuleAndKeepsTheOrderInEveryRegime) {
  for (const char* model : models) {
    for (const double ratio : {0.0, 0.4, 1.0}) {
      for (const double factor : {1.0, 2.0}) {
        const CurvedEnvelope m = envelope(model, ratio, factor);
        points::RandomStress<3> random(3 * scale);
        std::array<int, 5> met{};
        for (int i = 0; i < 2000; ++i) {
          Eigen::Vector3d trial = random().head<3>();
          if (i % 3 == 0) trial.array() += trial.norm();
          std::sort(trial.data(), trial.data() + 3, std::greater<>());
          const auto r = return_principal(m, trial);
          ++met[static_cast<std::size_t>(r.regime)];
          if (r.regime == MohrCoulombRegime::elastic) continue;
          const double tolerance = 1e-9 * (trial.norm() + scale);
          ASSERT_GE(r.stress[0], r.stress[1] - tolerance);
          ASSERT_GE(r.stress[1], r.stress[2] - tolerance);
          const Eigen::Vector3d removed = trial - r.stress;
          const double bulk = removed.sum() / (9 * m.moduli.bulk);
          const Eigen::Vector3d strain =
              (removed.array() - removed.mean()) / (2 * m.moduli.shear) + bulk;
          ASSERT_LE((elastic(m, strain) - removed).norm(), tolerance);
          const double size = strain.norm();
          if (r.regime == MohrCoulombRegime::apex) {
            // Every strain of the apex's cone opens all three; without dilation none is of it.
            EXPECT_GT(strain.sum(), 0);
            if (ratio == 1) {
              EXPECT_GE(strain.minCoeff(), -1e-6 * size) << trial.transpose();
            }
            continue;
          }
          const auto root = detail::curved_root(
              [&](double u) {
                const auto point = detail::curved_point(m, u);
                return detail::ValueAndSlope{-r.stress[0] - point.least, -point.least_by};
              },
              1.0);
          ASSERT_TRUE(root.found);
          const auto before = detail::curved_point(m, root.u * (1 - 1e-6)),
                     here = detail::curved_point(m, root.u),
                     after = detail::curved_point(m, root.u * (1 + 1e-6));
          EXPECT_NEAR(here.most, -r.stress[2], 1e-7 * (trial.norm() + scale));
          const double k =
              1 + ratio * ((after.most - before.most) / (after.least - before.least) - 1);
          const double more =
              strain[0] + (r.regime == MohrCoulombRegime::compression_edge ? strain[1] : 0);
          const double less =
              strain[2] + (r.regime == MohrCoulombRegime::extension_edge ? strain[1] : 0);
          EXPECT_NEAR(more, -k * less, 1e-6 * k * size) << static_cast<int>(r.regime);
          EXPECT_GE(strain[0], -1e-9 * size);
          EXPECT_LE(strain[2], 1e-9 * size);
          if (r.regime == MohrCoulombRegime::plane) {
            EXPECT_NEAR(strain[1], 0, 1e-8 * size);
          }
          if (r.regime == MohrCoulombRegime::compression_edge) {
            EXPECT_GE(strain[1], -1e-9 * size);
          }
          if (r.regime == MohrCoulombRegime::extension_edge) {
            EXPECT_LE(strain[1], 1e-9 * size);
          }
        }
        for (std::size_t k = 0; k < 5; ++k) EXPECT_GT(met[k], 15) << model << ratio << " " << k;
      }
    }
  }
}

template <int Dim>
StressVector<Dim> stress_of(const Material& material, const StressVector<Dim>& trial) {
  PointState<Dim> s0, s1;
  (void)update(material, trial, s0, s1);
  return s1.stress;
}

// Against central differences with two steps, whose difference is three quarters of the coarser
// one's error; what crosses into another regime is seen by that, too, and left out.
// tau = A sqrt(p_r (sigma_n + T)) has the radius A^2 p_r / 2 at its end: circles that are smaller
// touch it there alone, and their largest stress is T, as at a tension cut-off.
TEST(CurvedReturn, OfAParabolaIsToItsEndWhereCirclesAreSmallerThanItIsRound) {
  MaterialParameters p = points::soil("power_law");
  p.power_exponent = 0.5;
  for (const double ratio : {0.0, 0.5, 1.0}) {
    p.dilation_ratio = ratio;
    const auto m = std::get<CurvedEnvelope>(make_material(p));
    const double tension = m.apex(), end = m.coefficient * m.coefficient * m.stress - tension;
    constexpr double round_off = 1e-9;
    // On it, whatever the smallest is down to the end, and not beyond.
    for (const double minor : {0.0, -0.5 * end, -0.99 * end}) {
      EXPECT_LE(detail::curved_excess(m, tension, minor), round_off * end);
    }
    EXPECT_GT(detail::curved_excess(m, tension, -1.01 * end), 0.0);

    const double share = m.moduli.lame / (m.moduli.lame + 2 * m.moduli.shear);
    const Eigen::Vector3d one(1.5 * tension, -0.2 * end, -0.6 * end);
    const auto to_one = return_principal(m, one);
    EXPECT_EQ(to_one.regime, MohrCoulombRegime::tension);
    const double falls = share * 0.5 * tension;
    EXPECT_LT((to_one.stress - Eigen::Vector3d(tension, one[1] - falls, one[2] - falls)).norm(),
              round_off * end);
    const auto to_two = return_principal(m, {1.5 * tension, 1.5 * tension, -0.6 * end});
    EXPECT_EQ(to_two.regime, MohrCoulombRegime::tension);
    EXPECT_NEAR(to_two.stress[1], tension, round_off * end);
    EXPECT_LT(to_two.stress[2], -0.6 * end);
    EXPECT_EQ(return_principal(m, {2 * tension, 1.9 * tension, 1.8 * tension}).regime,
              MohrCoulombRegime::apex);
    EXPECT_EQ(return_principal(m, {1.1 * tension, -end, -3 * end}).regime,
              MohrCoulombRegime::plane);
  }
}

template <int Dim>
void compare_tangents() {
  for (const char* model : models) {
    for (const double ratio : {0.0, 0.4, 1.0}) {
      const CurvedEnvelope m = envelope(model, ratio);
      const Material material = m;
      points::RandomStress<Dim> random(3 * scale);
      std::array<int, 5> met{};
      for (int i = 0; i < 1000; ++i) {
        StressVector<Dim> trial = random();
        if (i % 3 == 0) trial += isotropic<Dim>(2 * trial.norm());
        const Eigen::Vector3d x = spectrum(trial).values;
        const auto regime = return_principal(m, x).regime;
        if (x[0] - x[1] < 0.05 * trial.norm() || x[1] - x[2] < 0.05 * trial.norm()) continue;
        const double h = 1e-4 * trial.norm();
        TangentMatrix<Dim> coarse, fine;
        bool stays = true;
        for (int column = 0; column < stress_size<Dim>; ++column) {
          const StressVector<Dim> unit = StressVector<Dim>::Unit(column);
          for (const double sign : {-1.0, 1.0}) {
            const StressVector<Dim> beside = trial + sign * h * unit;
            stays = stays && return_principal(m, spectrum(beside).values).regime == regime;
          }
          const auto difference = [&](double step) -> StressVector<Dim> {
            return (stress_of<Dim>(material, trial + step * unit) -
                    stress_of<Dim>(material, trial - step * unit)) /
                   (2 * step);
          };
          coarse.col(column) = difference(h);
          fine.col(column) = difference(h / 2);
        }
        if (!stays) continue;
        const double error = (coarse - fine).norm();
        if (error > 1e-2) continue;
        ++met[static_cast<std::size_t>(regime)];
        const TangentMatrix<Dim> t = trial_tangent(material, trial, PointState<Dim>{});
        // Richardson's remainder, a third of the difference, and the round-off of the returns.
        EXPECT_LE((t - fine).norm(), 0.5 * error + 1e-8)
            << model << ratio << " " << static_cast<int>(regime) << " " << trial.transpose();
      }
      // But for the elastic one, whose tangent is the identity.
      for (std::size_t k = 1; k < 5; ++k) EXPECT_GT(met[k], 10) << model << ratio << " " << k;
    }
  }
}

TEST(CurvedTangent, EqualsDifferencesInPlaneStrain) {
  compare_tangents<2>();
}

TEST(CurvedTangent, EqualsDifferencesInSpace) {
  compare_tangents<3>();
}

TEST(CurvedTangent, IsSymmetricForAssociatedFlow) {
  for (const char* model : models) {
    const Material material = envelope(model, 1);
    points::RandomStress<2> random(3 * scale);
    for (int i = 0; i < 300; ++i) {
      const StressVector<2> trial = random();
      const TangentMatrix<2> t = tangent(material, trial, PointState<2>{});
      ASSERT_LE((t - t.transpose()).norm(), 1e-7 * moduli(material).bulk) << trial.transpose();
    }
  }
}

}  // namespace
