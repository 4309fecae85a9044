#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

#include "points.hpp"

// Whole stress paths of one element of material.
namespace {

using namespace constitutive;

struct ReferencePoint {
  double strain, stress;
};

std::vector<ReferencePoint> read_reference(const std::string& name) {
  std::ifstream file(std::string(CONSTITUTIVE_REFERENCES) + "/" + name);
  std::string line;
  std::getline(file, line);
  if (line != "mean_axial_strain,mean_stress_kPa") return {};
  std::vector<ReferencePoint> points;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    ReferencePoint p{};
    char comma = 0;
    cells >> p.strain >> comma >> p.stress;
    points.push_back(p);
  }
  return points;
}

/// Plane-strain compression between smooth platens with free sides, finite strain.
class CompressionTest {
 public:
  explicit CompressionTest(const MaterialParameters& p)
      : material_(make_material(p)), tolerance_(points::round_off * p.youngs_modulus) {}

  /// Brings the height to 1 - strain; false if Newton's method on the free side did not converge.
  bool compress_to(double strain) {
    Eigen::Matrix2d increment = Eigen::Matrix2d::Identity();
    increment(1, 1) = (1 - strain) / height_;
    for (int iteration = 0; iteration < 20; ++iteration) {
      const auto inc = objective_increment(increment);
      const auto trial = elastic_trial(begin_.stress, inc, moduli(material_));
      if (update(material_, trial, begin_, end_).status() == UpdateStatus::failed) return false;
      if (std::abs(end_.stress[0]) <= tolerance_) {
        begin_ = end_;
        height_ = 1 - strain;
        width_ *= increment(0, 0);
        return true;
      }
      Eigen::Matrix2d widening = Eigen::Matrix2d::Zero();
      widening(0, 0) = 1;
      const StressVector<2> d_trial = elastic_trial_derivative(
          begin_.stress, inc, derivative(inc, widening), moduli(material_));
      const StressVector<2> d_stress = trial_tangent(material_, trial, begin_) * d_trial;
      increment(0, 0) -= end_.stress[0] / d_stress[0];
    }
    return false;
  }

  /// Force over the initial width, compression positive [Pa].
  [[nodiscard]] double mean_stress() const { return -begin_.stress[1] * width_; }

  [[nodiscard]] const PointState<2>& state() const { return begin_; }

 private:
  Material material_;
  double tolerance_, height_ = 1, width_ = 1;
  PointState<2> begin_, end_;
};

class HomogeneousCompression : public testing::TestWithParam<std::pair<std::string, std::string>> {
};

TEST_P(HomogeneousCompression, FollowsTheIndependentReferenceWithinATenthOfAPercent) {
  const auto& [model, file] = GetParam();
  const std::vector<ReferencePoint> reference = read_reference(file);
  ASSERT_EQ(reference.size(), 1001u);
  CompressionTest test(points::soil(model, 20, 0));
  double worst = 0;
  for (const ReferencePoint& point : reference) {
    if (point.strain == 0) continue;
    ASSERT_TRUE(test.compress_to(point.strain)) << point.strain;
    worst = std::max(worst, std::abs(test.mean_stress() / 1e3 / point.stress - 1));
  }
  RecordProperty("worst_relative_error", std::to_string(worst));
  EXPECT_LE(worst, 1e-3);
  EXPECT_GT(test.state().plastic_strain, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Models, HomogeneousCompression,
                         testing::Values(
                             std::pair<std::string, std::string>{
                                 "drucker_prager", "compression_homogeneous_drucker_prager.csv"},
                             std::pair<std::string, std::string>{
                                 "mohr_coulomb", "compression_homogeneous_mohr_coulomb.csv"}),
                         [](const auto& info) { return info.param.first; });

TEST(SmallStrainCompression, CollapsesAtTwiceCohesionTimesTangent) {
  // Uniaxial strength 2 c tan(45 + phi / 2) = 42.844 kPa, reached by both criteria whatever psi.
  for (const char* model : {"drucker_prager", "mohr_coulomb"}) {
    for (const double psi : {0.0, 10.0, 20.0}) {
      const MaterialParameters p = points::soil(model, 20, psi);
      const Material material = make_material(p);
      const ElasticModuli& m = moduli(material);
      PointState<2> s;
      for (int step = 0; step < 2000; ++step) {
        const PointState<2> s0 = s;
        StrainVector<2> strain = StrainVector<2>::Zero();
        strain[1] = -1e-4;
        for (int iteration = 0; iteration < 20; ++iteration) {
          const StressVector<2> trial = elastic_trial<2>(s0.stress, strain, m);
          (void)update(material, trial, s0, s);
          strain[0] -= s.stress[0] / tangent(material, trial, s0)(0, 0);
        }
        ASSERT_NEAR(s.stress[0], 0, points::round_off * p.youngs_modulus);
      }
      // The out-of-plane stress approaches its collapse value exponentially in strain; 20 % strain
      // is 600 times the yield strain.
      const double strength =
          2 * p.cohesion * std::tan(std::numbers::pi / 4 + std::numbers::pi / 18);
      EXPECT_NEAR(-s.stress[1], strength, 1e-9 * strength) << model << " psi " << psi;
    }
  }
}

TEST(ZeroLateralStrain, KeepsTheElasticStressRatioInFrictionalSoil) {
  // K0 = nu / (1 - nu) = 2/3 lies inside every cone with phi = 20 degrees: no yield at any depth.
  for (const char* model :
       {"elastic", "drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    MaterialParameters p = points::soil(model, 20, 10);
    p.cohesion = 0;
    const Material material = make_material(p);
    StrainVector<2> strain = StrainVector<2>::Zero();
    strain[1] = -1e-3;
    PointState<2> s;
    for (int i = 0; i < 50; ++i) {
      const PointState<2> s0 = s;
      const UpdateOutcome outcome =
          update(material, elastic_trial<2>(s0.stress, strain, moduli(material)), s0, s);
      ASSERT_FALSE(outcome.plastic) << model;
    }
    const double nu = p.poissons_ratio;
    EXPECT_NEAR(s.stress[0] / s.stress[1], nu / (1 - nu), points::round_off);
    EXPECT_NEAR(s.stress[2] / s.stress[1], nu / (1 - nu), points::round_off);
  }
}

TEST(ZeroLateralStrain, YieldsWhereTheElasticRatioIsOutsideTheFriction) {
  // phi = 20: the ratio at failure is (1 - sin phi) / (1 + sin phi) = 0.49; nu = 0.2 asks for 0.25.
  MaterialParameters p = points::soil("mohr_coulomb", 20, 0);
  p.poissons_ratio = 0.2;
  p.cohesion = 0;
  const Material material = make_material(p);
  StrainVector<2> strain = StrainVector<2>::Zero();
  strain[1] = -1e-3;
  PointState<2> s;
  for (int i = 0; i < 50; ++i) {
    const PointState<2> s0 = s;
    ASSERT_TRUE(
        update(material, elastic_trial<2>(s0.stress, strain, moduli(material)), s0, s).plastic);
  }
  const double sine = std::sin(std::numbers::pi / 9);
  EXPECT_NEAR(s.stress[0] / s.stress[1], (1 - sine) / (1 + sine), 50 * points::round_off);
}

TEST(ZeroIncrement, ChangesNothingAnywhereOnAPath) {
  for (const MaterialParameters& p : points::plastic_soils()) {
    const Material material = make_material(p);
    points::RandomStress<2> random(p.cohesion);
    const auto none = objective_increment(Eigen::Matrix2d(Eigen::Matrix2d::Identity()));
    for (int i = 0; i < 500; ++i) {
      PointState<2> s0, s1;
      (void)update(material, random(), PointState<2>{}, s0);
      (void)update(material, elastic_trial(s0.stress, none, moduli(material)), s0, s1);
      ASSERT_LE((s1.stress - s0.stress).norm(),
                points::round_off * points::magnitude<2>(s0.stress, p));
      ASSERT_LE(s1.plastic_strain - s0.plastic_strain, points::round_off);
    }
  }
}

}  // namespace
