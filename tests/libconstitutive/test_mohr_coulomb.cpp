#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "points.hpp"

namespace {

using namespace constitutive;
using detail::MohrCoulombRegime;
using detail::return_principal;

constexpr double degree = std::numbers::pi / 180;

MohrCoulomb mohr_coulomb(double phi, double psi, double nu = 0.4) {
  MaterialParameters p = points::soil("mohr_coulomb", phi, psi);
  p.poissons_ratio = nu;
  return std::get<MohrCoulomb>(make_material(p));
}

StrainVector<3> principal_strain(const Eigen::Vector3d& principal) {
  StrainVector<3> strain = StrainVector<3>::Zero();
  strain.head<3>() = principal;
  return strain;
}

/// Smallest distance of `removed` to the cone of the flow directions of all planes active at
/// `stress`: 0 if Koiter's rule explains the return with multipliers >= 0. Every cone in three
/// dimensions is covered by its simplices of at most three directions.
double koiter_defect(const MohrCoulomb& m, const Eigen::Vector3d& stress,
                     const Eigen::Vector3d& removed, double tolerance) {
  std::vector<Eigen::Vector3d> flows;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (i == j) continue;
      const double f = (1 + m.sin_friction) * stress[i] - (1 - m.sin_friction) * stress[j] -
                       2 * m.cohesion * m.cos_friction;
      if (f < -tolerance) continue;
      Eigen::Vector3d potential = Eigen::Vector3d::Zero();
      potential[i] = 1 + m.sin_dilation;
      potential[j] = -(1 - m.sin_dilation);
      const StressVector<3> flow = elastic_stress<3>(m.moduli, principal_strain(potential));
      flows.push_back(flow.head<3>().normalized());
    }
  }
  double best = removed.norm();
  const std::size_t n = flows.size();
  for (std::size_t subset = 1; subset < (1u << n); ++subset) {
    std::vector<Eigen::Vector3d> chosen;
    for (std::size_t k = 0; k < n; ++k) {
      if (subset >> k & 1u) chosen.push_back(flows[k]);
    }
    if (chosen.size() > 3) continue;
    Eigen::MatrixXd a(3, static_cast<Eigen::Index>(chosen.size()));
    for (std::size_t k = 0; k < chosen.size(); ++k) a.col(static_cast<Eigen::Index>(k)) = chosen[k];
    const Eigen::VectorXd x = a.colPivHouseholderQr().solve(removed);
    if (x.minCoeff() >= -tolerance) best = std::min(best, (removed - a * x).norm());
  }
  return best;
}

Eigen::Vector3d sorted_trial(points::RandomStress<3>& random) {
  Eigen::Vector3d v = random().head<3>();
  std::sort(v.data(), v.data() + 3, std::greater<>());
  return v;
}

TEST(MohrCoulombReturn, ObeysKoitersRuleAndKeepsTheOrderInEveryRegime) {
  struct Case {
    double phi, psi, nu;
  };
  for (const Case c : {Case{20, 20, 0.4}, Case{30, 5, 0.2}, Case{45, 45, -0.5}, Case{10, 3, 0.49},
                       Case{0, 0, 0.3}, Case{80, 60, 0.1}}) {
    const MohrCoulomb m = mohr_coulomb(c.phi, c.psi, c.nu);
    points::RandomStress<3> random(3 * m.cohesion);
    std::array<int, 5> met{};
    for (int i = 0; i < 3000; ++i) {
      const Eigen::Vector3d trial = sorted_trial(random);
      const auto r = return_principal(m, m.sin_dilation, trial);
      ++met[static_cast<std::size_t>(r.regime)];
      // The system of an edge has the condition number of its two flow directions, at most about
      // 4 / ((1 - sin phi)(1 - sin psi)).
      const double condition = 4 / ((1 - m.sin_friction) * (1 - m.sin_dilation));
      const double tolerance = points::round_off * condition * (trial.norm() + m.cohesion);
      ASSERT_GE(r.stress[0] - r.stress[1], -tolerance);
      ASSERT_GE(r.stress[1] - r.stress[2], -tolerance);
      if (r.regime == MohrCoulombRegime::elastic) continue;
      if (r.regime == MohrCoulombRegime::apex && m.sin_dilation == 0) continue;
      ASSERT_LE(koiter_defect(m, r.stress, trial - r.stress, tolerance), tolerance)
          << "phi " << c.phi << " psi " << c.psi << " nu " << c.nu << " trial " << trial.transpose()
          << " regime " << static_cast<int>(r.regime);
    }
    for (std::size_t k = 0; k < (c.phi > 0 ? 5u : 4u); ++k) EXPECT_GT(met[k], 20) << k;
    if (c.phi == 0) {
      EXPECT_EQ(met[4], 0) << "Tresca has no apex";
    }
  }
}

TEST(MohrCoulombReturn, IsContinuousAcrossItsRegimes) {
  // The return along a fine straight walk may not jump: its Lipschitz constant is that of the
  // oblique projections, |I - r a^T| <= 1 + |a| |Db| / (a.Db).
  const MohrCoulomb m = mohr_coulomb(30, 10);
  const Eigen::Vector3d a = detail::plane_gradient(m.sin_friction, 0, 2);
  const Eigen::Vector3d flow = detail::principal_flow(m.moduli, m.sin_dilation, 0, 2);
  const double plane = 1 + a.norm() * flow.norm() / a.dot(flow);
  const double lipschitz = plane * plane;
  points::RandomStress<3> random(3 * m.cohesion);
  for (int walk = 0; walk < 200; ++walk) {
    const Eigen::Vector3d from = sorted_trial(random), to = sorted_trial(random);
    constexpr int steps = 500;
    Eigen::Vector3d last = return_principal(m, m.sin_dilation, from).stress;
    for (int i = 1; i <= steps; ++i) {
      const Eigen::Vector3d trial = from + (to - from) * i / steps;
      const Eigen::Vector3d next = return_principal(m, m.sin_dilation, trial).stress;
      ASSERT_LE((next - last).norm(), lipschitz * (to - from).norm() / steps) << trial.transpose();
      last = next;
    }
  }
}

TEST(MohrCoulomb, IsWithinForSureWhereverThePrincipalStressesSaySo) {
  std::mt19937 engine(5);
  std::normal_distribution<double> normal;
  for (const double phi : {0.0, 20.0, 45.0}) {
    for (const double tension : {std::numeric_limits<double>::infinity(), 4e3}) {
      MohrCoulomb m = mohr_coulomb(phi, phi / 2);
      m.tension = tension;
      int inside = 0, for_sure = 0;
      for (int sample = 0; sample < 20000; ++sample) {
        Eigen::Vector3d x = 10e3 * Eigen::Vector3d::NullaryExpr([&] { return normal(engine); });
        std::sort(x.data(), x.data() + 3, std::greater<>());
        const double size = std::sqrt((x.array() - x.mean()).square().sum() / 2);
        const bool is_inside =
            return_principal(m, m.sin_dilation, x).regime == MohrCoulombRegime::elastic;
        inside += is_inside ? 1 : 0;
        if (!detail::is_within_for_sure(m, x.mean(), size)) continue;
        ++for_sure;
        EXPECT_TRUE(is_inside) << x.transpose();
      }
      // A circle in the hexagon has 0.9 of Tresca's area, and less of slimmer ones.
      EXPECT_GT(for_sure, inside / 2);
      EXPECT_LT(for_sure, inside);
    }
  }
}

TEST(MohrCoulomb, HasTheTriaxialStrengthsOfTheTextbook) {
  const double phi = 30 * degree, c = 15e3;
  const MohrCoulomb m = mohr_coulomb(30, 10);
  const double passive = (1 + std::sin(phi)) / (1 - std::sin(phi));
  for (const double cell : {0.0, 50e3}) {
    const double compressive = cell * passive + 2 * c * std::sqrt(passive);
    // Compression: two lesser pressures equal. Extension: two greater pressures equal.
    const Eigen::Vector3d compression(-cell, -cell, -compressive);
    const Eigen::Vector3d extension(-cell, -compressive, -compressive);
    for (const Eigen::Vector3d& failure : {compression, extension}) {
      for (const double factor : {1 - 1e-12, 1 + 1e-12}) {
        const Eigen::Vector3d trial = failure * factor;
        const auto r = return_principal(m, m.sin_dilation, trial);
        EXPECT_EQ(r.regime == MohrCoulombRegime::elastic, factor < 1);
        EXPECT_LE((r.stress - failure).norm(), 1e-11 * compressive);
      }
    }
  }
}

TEST(MohrCoulomb, ReturnsTensionToTheApexAtCohesionTimesCotangentOfFriction) {
  for (const double psi : {0.0, 10.0, 30.0}) {
    const MohrCoulomb m = mohr_coulomb(30, psi);
    PointState<3> s0, s1;
    const StressVector<3> trial = isotropic<3>(20 * m.cohesion);
    const UpdateOutcome outcome = update(m, trial, s0, s1);
    EXPECT_EQ(outcome.status(), UpdateStatus::apex);
    const double apex = m.cohesion / std::tan(30 * degree);
    EXPECT_LE((s1.stress - isotropic<3>(apex)).norm(), points::round_off * trial.norm());
    EXPECT_TRUE(trial_tangent(m, trial, s0).isZero(0));
  }
}

TEST(MohrCoulomb, InPlaneStrainIsTheThreeDimensionalUpdateWithoutOutOfPlaneShear) {
  for (const double psi : {0.0, 30.0}) {
    const MohrCoulomb m = mohr_coulomb(30, psi);
    points::RandomStress<2> random(3 * m.cohesion);
    for (int i = 0; i < 2000; ++i) {
      const StressVector<2> flat = random();
      StressVector<3> solid = StressVector<3>::Zero();
      solid.head<4>() = flat;
      PointState<2> a;
      PointState<3> b;
      (void)update(m, flat, PointState<2>{}, a);
      (void)update(m, solid, PointState<3>{}, b);
      const double allowed = points::round_off * (flat.norm() + m.cohesion);
      ASSERT_LE((a.stress - b.stress.head<4>()).norm(), allowed);
      ASSERT_LE(b.stress.tail<2>().norm(), allowed);
      ASSERT_NEAR(a.plastic_strain, b.plastic_strain, allowed / m.moduli.shear);
    }
  }
}

}  // namespace
