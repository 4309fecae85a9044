#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "points.hpp"

// Rankine's tension cut-off of Mohr-Coulomb's pyramid and of the cones.
namespace {

using namespace constitutive;

struct Cut {
  MaterialParameters p;
  Material material;
};

Cut cut(const std::string& model, double phi, double psi, double tension) {
  MaterialParameters p = points::soil(model, phi, psi);
  p.tension_cutoff = tension;
  return {p, make_material(p)};
}

constexpr double c = 15e3;  // of points::soil

std::vector<Cut> all_cut() {
  std::vector<Cut> all;
  for (const double tension : {0.0, 1e3, 10e3}) {
    all.push_back(cut("von_mises", 0, 0, tension));
    for (const char* model : {"drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
      for (const double psi : {0.0, 10.0, 20.0}) all.push_back(cut(model, 20, psi, tension));
      all.push_back(cut(model, 50, 50, tension));
      all.push_back(cut(model, 0, 0, tension));
    }
  }
  return all;
}

/// Stress and strain whose principal axes are the coordinates.
StressVector<3> principal(double x, double y, double z) {
  StressVector<3> v = StressVector<3>::Zero();
  v.head<3>() << x, y, z;
  return v;
}

StressVector<3> returned(const Material& material, const StressVector<3>& trial) {
  PointState<3> s;
  EXPECT_EQ(update<3>(material, trial, PointState<3>{}, s).failed, false);
  return s.stress;
}

/// D^-1 of a stress, as a stress-like vector of strains.
template <int Dim>
StressVector<Dim> compliance(const ElasticModuli& m, const StressVector<Dim>& v) {
  return deviator(v) / (2 * m.shear) + isotropic<Dim>(mean_stress(v) / (3 * m.bulk));
}

template <int Dim>
double tension_excess(const MaterialParameters& p, const StressVector<Dim>& v) {
  const Eigen::Matrix3d matrix = to_matrix(v);
  return matrix.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff() - p.tension_cutoff;
}

/// Yield function of what is cut, without the cut-off.
template <int Dim>
double yield_excess(const Cut& cut, const StressVector<Dim>& v) {
  MaterialParameters whole = cut.p;
  whole.tension_cutoff = std::numeric_limits<double>::infinity();
  return points::yield_function<Dim>(make_material(whole), v);
}

/// As in test_extremes: two flows that are nearly parallel multiply round-off.
double condition(const MaterialParameters& p) {
  const double phi = radians(p.friction_angle), psi = radians(p.dilation_angle);
  return 4 / ((1 - std::sin(phi)) * (1 - std::sin(psi)));
}

// Strains that only pull along x, on a material with lambda and mu: each part of the surface has
// its closed form.
TEST(TensionCutoff, ReturnsPrincipalTrialsToPlaneEdgeAndApexExactly) {
  for (const char* model : {"mohr_coulomb", "drucker_prager", "von_mises"}) {
    const Cut one = cut(model, 20, 10, 1e3);
    const ElasticModuli& m = moduli(one.material);
    const double t = 1e3, share = m.lame / (m.lame + 2 * m.shear);

    // The plane: the other two lose lambda / (lambda + 2 mu) of what the first does.
    const StressVector<3> plane = returned(one.material, principal(5e3, -1e3, -2e3));
    EXPECT_EQ(plane[0], t) << model;
    EXPECT_NEAR(plane[1], -1e3 - share * 4e3, 5e3 * points::round_off) << model;
    EXPECT_NEAR(plane[2], -2e3 - share * 4e3, 5e3 * points::round_off) << model;

    // The edge: plane strain along z, lambda / (2 (lambda + mu)) of the sum of both.
    const StressVector<3> edge = returned(one.material, principal(5e3, 4e3, -2e3));
    EXPECT_EQ(edge[0], t) << model;
    EXPECT_EQ(edge[1], t) << model;
    EXPECT_NEAR(edge[2], -2e3 - m.lame / (2 * (m.lame + m.shear)) * (4e3 + 3e3),
                5e3 * points::round_off)
        << model;

    // The apex of the cut-off.
    const StressVector<3> apex = returned(one.material, principal(5e3, 4.5e3, 4e3));
    // Recomposed of its axes, a sphere is one to round-off.
    EXPECT_LE((apex - principal(t, t, t)).norm(), t * points::round_off) << model;
  }
}

// Where the cut-off meets the pyramid: sigma_3 = ((1 + s) T - 2 c cos phi) / (1 - s).
TEST(TensionCutoff, MeetsMohrCoulombAtItsEdgeAndTwoPoints) {
  const double phi = radians(20), t = 1e3, s = std::sin(phi);
  const double least = ((1 + s) * t - 2 * c * std::cos(phi)) / (1 - s);
  const Cut one = cut("mohr_coulomb", 20, 20, t);
  const ElasticModuli& m = moduli(one.material);
  const double rounding = 1e5 * points::round_off * condition(one.p);
  // Flows of the main plane and of the cut-off, added to a point of their edge.
  const auto flow = [&](double x, double y, double z) {
    return StressVector<3>(2 * m.shear * principal(x, y, z) + isotropic<3>(m.lame * (x + y + z)));
  };
  const StressVector<3> on_edge = principal(t, (t + least) / 2, least);
  const StressVector<3> beyond =
      on_edge + flow(2e-3 * (1 + s), 0, -2e-3 * (1 - s)) + flow(1e-3, 0, 0);
  EXPECT_LE((returned(one.material, beyond) - on_edge).norm(), rounding);

  const StressVector<3> both_large = principal(t, t, least);
  const StressVector<3> to_both =
      both_large + flow(2e-3 * (1 + s), 1e-3 * (1 + s), -3e-3 * (1 - s)) + flow(2e-3, 1e-3, 0);
  EXPECT_EQ(returned(one.material, to_both), both_large);

  const StressVector<3> both_small = principal(t, least, least);
  const StressVector<3> to_small =
      both_small + flow(3e-3 * (1 + s), -1e-3 * (1 - s), -2e-3 * (1 - s)) + flow(1e-3, 0, 0);
  EXPECT_EQ(returned(one.material, to_small), both_small);
}

// And the cone: sqrt(J2) + 3 alpha p = k with sigma_1 = T.
TEST(TensionCutoff, MeetsTheConeInACurveThatEndsInAPoint) {
  const double t = 1e3, s = std::sin(radians(20));
  const Cut one = cut("drucker_prager_compression", 20, 10, t);
  const Cone cone = compression_cone(c, radians(20), radians(10));
  const ElasticModuli& m = moduli(one.material);
  const double rounding = 1e5 * points::round_off * condition(one.p);
  // D times the flow of the cone at a stress, and of the cut-off along x or y.
  const auto of_cone = [&](const StressVector<3>& y) {
    const StressVector<3> deviatoric = deviator(y);
    return StressVector<3>(m.shear / std::sqrt(j2(y)) * deviatoric +
                           isotropic<3>(3 * m.bulk * cone.beta));
  };
  const StressVector<3> along_x = 2 * m.shear * principal(1, 0, 0) + isotropic<3>(m.lame);
  const StressVector<3> along_y = 2 * m.shear * principal(0, 1, 0) + isotropic<3>(m.lame);

  // The cone goes through Mohr-Coulomb's compression meridian, whose point this is as well.
  const double least = ((1 + s) * t - 2 * c * std::cos(radians(20))) / (1 - s);
  const StressVector<3> point = principal(t, t, least);
  const StressVector<3> to_point = point + 2e-3 * of_cone(point) + 2e-3 * along_x + 1e-3 * along_y;
  EXPECT_LE((returned(one.material, to_point) - point).norm(), rounding);

  // A stress of the curve with sigma_2 between the others: sigma_3 by halving.
  double low = 3 * least, high = t;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    const bool outside =
        points::yield_function<3>(cone, principal(t, (t + middle) / 2, middle)) > 0;
    (outside ? low : high) = middle;
  }
  const StressVector<3> on_both = principal(t, (t + high) / 2, high);
  const StressVector<3> to_both = on_both + 3e-3 * of_cone(on_both) + 2e-3 * along_x;
  EXPECT_LE((returned(one.material, to_both) - on_both).norm(), rounding);
}

TEST(TensionCutoff, BeyondTheApexChangesNothing) {
  for (const char* model : {"mohr_coulomb", "drucker_prager"}) {
    const double apex = c / std::tan(radians(20));
    const Material whole = make_material(points::soil(model)),
                   cut_far = cut(model, 20, 10, 1.01 * apex).material;
    points::RandomStress<2> random(c);
    for (int i = 0; i < 2000; ++i) {
      const StressVector<2> trial = random();
      PointState<2> a, b;
      (void)update<2>(whole, trial, PointState<2>{}, a);
      (void)update<2>(cut_far, trial, PointState<2>{}, b);
      ASSERT_LE((a.stress - b.stress).norm(),
                points::round_off * points::magnitude<2>(trial, points::soil(model)) * 30)
          << model;
    }
  }
}

template <class Dimension>
class TensionCutoffIn : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(TensionCutoffIn, Dimensions);

TYPED_TEST(TensionCutoffIn, ReturnsWithinBothSurfaces) {
  constexpr int Dim = TypeParam::value;
  for (const Cut& one : all_cut()) {
    points::RandomStress<Dim> random(c);
    for (int i = 0; i < 3000; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s0, s1;
      const UpdateOutcome outcome = update<Dim>(one.material, trial, s0, s1);
      ASSERT_FALSE(outcome.failed);
      const double rounding =
          4 * points::round_off * condition(one.p) * points::magnitude<Dim>(trial, one.p);
      ASSERT_LE(tension_excess<Dim>(one.p, s1.stress), rounding)
          << points::label(one.p) << " T " << one.p.tension_cutoff << " trial "
          << trial.transpose();
      ASSERT_LE(yield_excess<Dim>(one, s1.stress), rounding)
          << points::label(one.p) << " T " << one.p.tension_cutoff << " trial "
          << trial.transpose();
      ASSERT_TRUE(outcome.plastic || s1.stress == trial);
    }
  }
}

// Associated flow is the return to the nearest admissible stress in the energy norm: no admissible
// stress lies on the side that the plastic strain points to.
TYPED_TEST(TensionCutoffIn, ReturnsToTheNearestStressIfAssociated) {
  constexpr int Dim = TypeParam::value;
  for (const Cut& one : all_cut()) {
    // The plane strain match is associated in its own cone, whose beta is not alpha.
    const bool associated =
        one.p.dilation_angle == one.p.friction_angle && one.p.model != "drucker_prager";
    if (!associated) continue;
    const ElasticModuli& m = moduli(one.material);
    points::RandomStress<Dim> random(c);
    std::vector<StressVector<Dim>> admissible;
    for (int i = 0; i < 200; ++i) {
      PointState<Dim> s;
      (void)update<Dim>(one.material, random(), PointState<Dim>{}, s);
      admissible.push_back(s.stress);
    }
    for (int i = 0; i < 1000; ++i) {
      const StressVector<Dim> trial = random();
      PointState<Dim> s;
      (void)update<Dim>(one.material, trial, PointState<Dim>{}, s);
      const StressVector<Dim> plastic = compliance<Dim>(m, StressVector<Dim>(trial - s.stress));
      for (const StressVector<Dim>& other : admissible) {
        const StressVector<Dim> way = other - s.stress;
        const double rounding = points::round_off * condition(one.p) *
                                (points::magnitude<Dim>(trial, one.p) + other.norm()) *
                                (plastic.norm() + points::magnitude<Dim>(trial, one.p) / m.shear);
        ASSERT_LE(contract(way, plastic), rounding)
            << points::label(one.p) << " T " << one.p.tension_cutoff << " trial "
            << trial.transpose() << " returned " << s.stress.transpose();
      }
    }
  }
}

// Central differences over 1e-6 of the trial leave some 1e-9 of truncation and 1e-10 of round-off;
// a trial within that of a corner is told by its one-sided differences and left out.
TYPED_TEST(TensionCutoffIn, HasTheTangentThatDifferencesHave) {
  constexpr int Dim = TypeParam::value;
  constexpr double of_differences = 1e-6, corner = 1e-3;
  for (const Cut& one : all_cut()) {
    points::RandomStress<Dim> random(c);
    int smooth = 0;
    for (int i = 0; i < 300; ++i) {
      const StressVector<Dim> trial = random();
      const TangentMatrix<Dim> tangent = trial_tangent<Dim>(one.material, trial, PointState<Dim>{});
      ASSERT_TRUE(tangent.allFinite());
      const double step = 1e-6 * trial.norm();
      const auto at = [&](const StressVector<Dim>& x) {
        PointState<Dim> s;
        (void)update<Dim>(one.material, x, PointState<Dim>{}, s);
        return s.stress;
      };
      double worst = 0, kink = 0;
      for (int k = 0; k < stress_size<Dim>; ++k) {
        const StressVector<Dim> unit = StressVector<Dim>::Unit(k);
        const StressVector<Dim> forward = (at(trial + step * unit) - at(trial)) / step;
        const StressVector<Dim> backward = (at(trial) - at(trial - step * unit)) / step;
        worst = std::max(worst, ((forward + backward) / 2 - tangent.col(k)).norm());
        kink = std::max(kink, (forward - backward).norm());
      }
      if (kink > corner) continue;
      ++smooth;
      ASSERT_LE(worst, of_differences * condition(one.p))
          << points::label(one.p) << " T " << one.p.tension_cutoff << " trial "
          << trial.transpose();
    }
    EXPECT_GT(smooth, 270) << points::label(one.p);
  }
}

TEST(TensionCutoff, OfElasticMaterialsIsNotAParameter) {
  EXPECT_FALSE(parameter_info("tension_cutoff").is_used_by(*find_model("elastic")));
  MaterialParameters p = points::soil("mohr_coulomb");
  p.tension_cutoff = -1;
  EXPECT_FALSE(validate(p).empty());
}

}  // namespace
