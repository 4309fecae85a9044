#include "material/element_test.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

namespace material {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double young = 20e6, poisson = 0.3;
// Stresses are found to 1e-11 of the largest; a path adds up a hundred steps of that.
constexpr double tolerance = 1e-8;

Path path_of(const std::string& model, std::vector<Stage> stages) {
  Path path;
  path.material.model = model;
  path.material.match = "compression_cone";
  path.material.youngs_modulus = young;
  path.material.poissons_ratio = poisson;
  path.stage = std::move(stages);
  return path;
}

Path frictional(const std::string& model, double phi, double psi, std::vector<Stage> stages) {
  Path path = path_of(model, std::move(stages));
  path.material.cohesion = 5e3;
  path.material.friction_angle = phi;
  path.material.dilation_angle = psi;
  return path;
}

constexpr double lambda = 0.09, kappa = 0.02, slope = 1.1, preconsolidation = 200e3;

Path clay(std::vector<Stage> stages) {
  Path path = path_of("modified_cam_clay", std::move(stages));
  path.material.compression_index = lambda;
  path.material.swelling_index = kappa;
  path.material.critical_stress_ratio = slope;
  path.material.preconsolidation_pressure = preconsolidation;
  path.initial_stress.assign(3, -100e3);
  return path;
}

Stage stage(TestKind test, double amount, int steps = 100) {
  Stage one;
  one.test = test;
  one.amount = amount;
  one.steps = steps;
  return one;
}

Course followed(const Path& path) {
  return follow(constitutive::make_material(parameters_of(path)), path);
}

const Point& end_of(const Course& course) {
  EXPECT_THAT(course.obstacle, IsEmpty());
  return course.points.back();
}

double degrees(double angle) {
  return angle * std::acos(-1.0) / 180.0;
}

TEST(AnElasticPoint, HasTheModuliOfTheTests) {
  const double bulk = young / (3.0 * (1.0 - 2.0 * poisson));
  const Course isotropic = followed(path_of("elastic", {stage(TestKind::isotropic, 1e5, 5)}));
  EXPECT_NEAR(constitutive::trace(end_of(isotropic).strain), -1e5 / bulk, tolerance * 1e5 / bulk);

  const Course triaxial =
      followed(path_of("elastic", {stage(TestKind::triaxial_compression, 1e-3, 5)}));
  EXPECT_NEAR(end_of(triaxial).state.stress[1], -young * 1e-3, tolerance * young * 1e-3);
  EXPECT_NEAR(end_of(triaxial).strain[0], poisson * 1e-3, tolerance);

  const double confined = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const Course oedometer = followed(path_of("elastic", {stage(TestKind::oedometer, 1e-3, 5)}));
  EXPECT_NEAR(end_of(oedometer).state.stress[1], -confined * 1e-3, tolerance * confined * 1e-3);

  const Course plane = followed(path_of("elastic", {stage(TestKind::plane_strain, 1e-3, 5)}));
  EXPECT_NEAR(end_of(plane).state.stress[1], -young / (1.0 - poisson * poisson) * 1e-3,
              tolerance * young * 1e-3);

  const Course shear = followed(path_of("elastic", {stage(TestKind::simple_shear, 1e-3, 5)}));
  EXPECT_NEAR(end_of(shear).state.stress[3], young / (2.0 * (1.0 + poisson)) * 1e-3,
              tolerance * young * 1e-3);
}

// sigma_1 = N sigma_3 + 2 c sqrt(N), N = tan^2(45 + phi/2) (compression positive).
TEST(MohrCoulomb, HasItsStrengthInTriaxialTestsOfEitherSign) {
  const double phi = 35.0, cell = 50e3, c = 5e3;
  const double n = std::pow(std::tan(degrees(45.0 + phi / 2.0)), 2);
  const Course compression = followed(frictional(
      "mohr_coulomb", phi, 5.0,
      {stage(TestKind::isotropic, cell, 2), stage(TestKind::triaxial_compression, 0.05)}));
  EXPECT_NEAR(-end_of(compression).state.stress[1], n * cell + 2.0 * c * std::sqrt(n),
              tolerance * n * cell);
  const Course extension = followed(
      frictional("mohr_coulomb", phi, 5.0,
                 {stage(TestKind::isotropic, cell, 2), stage(TestKind::triaxial_extension, 0.05)}));
  EXPECT_NEAR(-end_of(extension).state.stress[1], (cell - 2.0 * c * std::sqrt(n)) / n,
              tolerance * cell);
}

// Of the edge sigma_1 = sigma_2: volume over axial plastic strain is 2 sin psi / (1 - sin psi); in
// failure all strain is plastic.
TEST(MohrCoulomb, DilatesByItsAngleInTriaxialCompression) {
  const double psi = 12.0, sine = std::sin(degrees(psi));
  const Course course = followed(frictional(
      "mohr_coulomb", 35.0, psi,
      {stage(TestKind::isotropic, 50e3, 2), stage(TestKind::triaxial_compression, 0.05)}));
  const Point& last = end_of(course);
  const Point& before = course.points[course.points.size() - 11];
  const double volume = constitutive::trace(last.strain) - constitutive::trace(before.strain);
  const double axial = before.strain[1] - last.strain[1];
  EXPECT_NEAR(volume / axial, 2.0 * sine / (1.0 - sine), 1e-6);
}

// The compression cone passes through Mohr-Coulomb's compression meridian.
TEST(DruckerPrager, MatchedInCompressionHasMohrCoulombsStrengthThere) {
  const std::vector<Stage> stages{stage(TestKind::isotropic, 50e3, 2),
                                  stage(TestKind::triaxial_compression, 0.05)};
  const double cone = end_of(followed(frictional("drucker_prager", 30, 0, stages))).state.stress[1];
  const double corners =
      end_of(followed(frictional("mohr_coulomb", 30, 0, stages))).state.stress[1];
  EXPECT_NEAR(cone, corners, tolerance * std::abs(corners));
}

// sigma_1 = N sigma_3 + 2 c sqrt(N) with the strength at k. Plane strain with psi = 0: plastic
// strains e_1 = -e_3, of which k = 2 / sqrt 3, and none along zz; elastic ones by (1 - nu^2) / E
// and the lateral stress, which stays.
TEST(SofteningMohrCoulomb, FollowsItsStrengthInPlaneStrainCompression) {
  const double cell = 50e3, c = 20e3, residual_c = 4e3, phi = 35.0, residual_phi = 25.0,
               over = 0.04;
  Path path =
      frictional("mohr_coulomb", phi, 0.0,
                 {stage(TestKind::isotropic, cell, 2), stage(TestKind::plane_strain, 0.06, 200)});
  path.material.cohesion = c;
  path.material.residual_strain = over;
  path.material.residual_cohesion = residual_c;
  path.material.residual_friction_angle = residual_phi;
  const Course course = followed(path);
  ASSERT_THAT(course.obstacle, IsEmpty());
  int softening = 0, residual = 0;
  const Point* begin = nullptr;
  for (const Point& point : course.points) {
    if (point.stage == 1 && point.step == 0) begin = &point;
    if (point.stage == 0 || !point.plastic) continue;
    const double k = point.state.plastic_strain, share = std::min(1.0, k / over);
    const double angle = degrees(phi + share * (residual_phi - phi));
    const double n = std::pow(std::tan(degrees(45.0) + angle / 2.0), 2);
    const double strength = n * cell + 2.0 * (c + share * (residual_c - c)) * std::sqrt(n);
    EXPECT_NEAR(-point.state.stress[1], strength, tolerance * strength) << k;
    const double axial = begin->strain[1] - point.strain[1];
    const double elastic = (1.0 - poisson * poisson) * (strength - cell) / young;
    EXPECT_NEAR(k, 2.0 / std::sqrt(3.0) * (axial - elastic), tolerance) << "axial " << axial;
    (k < over ? softening : residual) += 1;
  }
  EXPECT_GT(softening, 50);
  EXPECT_GT(residual, 20);
}

// tau = c(k), k = (gamma - tau / mu) / sqrt 3.
TEST(SofteningVonMises, FollowsItsStrengthInSimpleShear) {
  Path path = path_of("von_mises", {stage(TestKind::simple_shear, 0.08, 40)});
  path.material.cohesion = 25e3;
  path.material.residual_strain = 0.03;
  path.material.residual_cohesion = 10e3;
  const double shear_modulus = young / (2.0 * (1.0 + poisson));
  int softening = 0;
  for (const Point& point : followed(path).points) {
    if (!point.plastic) continue;
    const double k = (point.strain[3] - point.state.stress[3] / shear_modulus) / std::sqrt(3.0);
    EXPECT_NEAR(point.state.plastic_strain, k, tolerance);
    const double strength = 25e3 - 15e3 * std::min(1.0, k / 0.03);
    EXPECT_NEAR(point.state.stress[3], strength, tolerance * 25e3) << k;
    softening += k < 0.03 ? 1 : 0;
  }
  EXPECT_GT(softening, 20);
}

// sigma_1 = sigma_3 + sigma_ci (m_b sigma_3 / sigma_ci + s)^a from either side: of compression
// sigma_3 is the cell pressure, of extension sigma_1. Dilation of the edge sigma_2 = sigma_3
// (tension positive: the two larger): with K = 1 + a m_b u^(a - 1) and K_psi - 1 a share of K - 1,
// volume over axial strain is K_psi - 1.
TEST(HoekBrown, HasItsStrengthAndDilationInTriaxialTests) {
  constexpr double cell = 1e6, share = 0.4, intact = 20e6;
  const auto rock = [&](std::vector<Stage> stages) {
    Path path = path_of("hoek_brown", std::move(stages));
    path.material.youngs_modulus = 2e9;
    path.material.intact_strength = intact;
    path.material.m_i = 10.0;
    path.material.gsi = 45.0;
    path.material.dilation_ratio = share;
    return path;
  };
  const double m_b = 10.0 * std::exp(-55.0 / 28.0), s = std::exp(-55.0 / 9.0);
  const double a = 0.5 + (std::exp(-3.0) - std::exp(-20.0 / 3.0)) / 6.0;
  const auto strength = [&](double least) {
    return least + intact * std::pow(m_b * least / intact + s, a);
  };
  const Course compression = followed(
      rock({stage(TestKind::isotropic, cell, 2), stage(TestKind::triaxial_compression, 0.03)}));
  const Point& last = end_of(compression);
  EXPECT_NEAR(-last.state.stress[1], strength(cell), tolerance * strength(cell));
  const Point& before = compression.points[compression.points.size() - 11];
  const double volume = constitutive::trace(last.strain) - constitutive::trace(before.strain);
  const double axial = before.strain[1] - last.strain[1];
  const double k = a * m_b * std::pow(m_b * cell / intact + s, a - 1.0);
  EXPECT_NEAR(volume / axial, share * k, 1e-6);
  const Course extension = followed(
      rock({stage(TestKind::isotropic, cell, 2), stage(TestKind::triaxial_extension, 0.01)}));
  EXPECT_NEAR(strength(-end_of(extension).state.stress[1]), cell, tolerance * cell);
}

// lambda ln p on the way up, kappa ln p on the way back.
TEST(ModifiedCamClay, FollowsItsLinesOfIsotropicCompression) {
  const Course course = followed(
      clay({stage(TestKind::isotropic, 300e3, 30), stage(TestKind::isotropic, -200e3, 10)}));
  const double up =
      kappa * std::log(preconsolidation / 100e3) + lambda * std::log(400e3 / preconsolidation);
  for (const Point& point : course.points) {
    if (point.stage == 0 && point.step == 30) {
      EXPECT_NEAR(constitutive::trace(point.strain), -up, tolerance);
    }
  }
  EXPECT_NEAR(constitutive::trace(end_of(course).strain), -up + kappa * std::log(2.0), tolerance);
}

// q_f = M p_f, p_f = p_0 (R / 2)^((lambda - kappa) / lambda): the volume stays, and the way to the
// critical state ends exponentially with the strain.
TEST(ModifiedCamClay, EndsUndrainedTriaxialTestsInTheCriticalState) {
  for (const double ratio : {1.0, 4.0}) {
    Stage undrained;
    undrained.control.assign(6, Control::strain);
    undrained.change = {0.25, -0.5, 0.25, 0.0, 0.0, 0.0};
    undrained.steps = 500;
    Path path = clay({undrained});
    path.initial_stress.assign(3, -preconsolidation / ratio);
    const Stress stress = end_of(followed(path)).state.stress;
    const double expected =
        preconsolidation / ratio * std::pow(ratio / 2.0, (lambda - kappa) / lambda);
    EXPECT_NEAR(-constitutive::mean_stress(stress), expected, tolerance * expected) << ratio;
    EXPECT_NEAR(stress[0] - stress[1], slope * expected, tolerance * expected) << ratio;
  }
}

// With a constant lateral stress q = 3 (p - p_cell): q_f = M p_f where p_f = 3 p_cell / (3 - M), at
// the volume of p_c = 2 p_f.
TEST(ModifiedCamClay, EndsDrainedTriaxialTestsInTheCriticalState) {
  for (const double ratio : {1.0, 8.0}) {
    const double cell = preconsolidation / ratio, end = 3.0 * cell / (3.0 - slope);
    Path path = clay({stage(TestKind::triaxial_compression, 3.0, 3000)});
    path.initial_stress.assign(3, -cell);
    const Course course = followed(path);
    const Point& last = end_of(course);
    EXPECT_NEAR(-constitutive::mean_stress(last.state.stress), end, 1e-6 * end) << ratio;
    const double volume =
        kappa * std::log(end / cell) + (lambda - kappa) * std::log(2.0 * end / preconsolidation);
    EXPECT_NEAR(constitutive::trace(last.strain), -volume, 1e-6) << ratio;
  }
}

TEST(VonMises, ComesToItsStrengthInSimpleShear) {
  Path path = path_of("von_mises", {stage(TestKind::simple_shear, 0.1)});
  path.material.cohesion = 25e3;
  // The normal stresses become equal as all shear strain is plastic: by 1/e per c / mu of shear.
  const double shear_modulus = young / (2.0 * (1.0 + poisson));
  EXPECT_NEAR(end_of(followed(path)).state.stress[3], 25e3,
              25e3 * std::exp(-0.05 * shear_modulus / 25e3) + tolerance * 25e3);
}

// Whatever is given of the six rows, strain or stress, one path is traced.
TEST(AnyMixOfControls, TracesThePathThatStrainAloneTraces) {
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 40; ++trial) {
    Stage by_strain;
    by_strain.control.assign(6, Control::strain);
    by_strain.steps = 20;
    for (int row = 0; row < 6; ++row) by_strain.change.push_back(1e-3 * normal(engine));
    const Path path = path_of("elastic", {by_strain});
    const Course reference = followed(path);
    Stage mixed = by_strain;
    for (std::size_t row = 0; row < 6; ++row) {
      if (normal(engine) < 0.0) continue;
      mixed.control[row] = Control::stress;
      mixed.change[row] = end_of(reference).state.stress[static_cast<Eigen::Index>(row)];
    }
    const Course course = followed(path_of("elastic", {mixed}));
    EXPECT_LT((end_of(course).strain - end_of(reference).strain).norm(), tolerance * 1e-3);
  }
}

TEST(APath, EndsWhereTheMaterialCannotFollow) {
  Path path = path_of("von_mises", {});
  path.material.cohesion = 10e3;
  Stage beyond;
  beyond.control.assign(6, Control::stress);
  beyond.change = {0.0, -40e3, 0.0, 0.0, 0.0, 0.0};  // uniaxial strength sqrt(3) c = 17.3 kPa
  beyond.steps = 100;
  path.stage = {beyond};
  const Course course = followed(path);
  EXPECT_THAT(course.obstacle, HasSubstr("stage 0 ends at 43"));  // 17.32 / 40
  EXPECT_NEAR(course.points.back().state.stress[1], -17.2e3, 1.0) << "the last step before";
}

// The apex is as far as tension goes: no strain, however large, brings more about.
TEST(APath, EndsAtTheApex) {
  const double apex = 5e3 / std::tan(degrees(20.0));
  for (const double psi : {0.0, 20.0}) {
    for (const char* model : {"mohr_coulomb", "drucker_prager"}) {
      const Course course =
          followed(frictional(model, 20.0, psi, {stage(TestKind::isotropic, -2.0 * apex)}));
      EXPECT_THAT(course.obstacle, HasSubstr("stage 0 ends at 50 %")) << model << psi;
      EXPECT_LT(course.points.back().strain.norm(), 2.0 * apex / young);
    }
  }
}

TEST(APath, DoesNotBeginBeyondTheStrength) {
  Path path = path_of("von_mises", {stage(TestKind::oedometer, 0.01)});
  path.material.cohesion = 10e3;
  path.initial_stress = {0.0, -40e3, 0.0};
  EXPECT_THAT(followed(path).obstacle, HasSubstr("initial stress is beyond the strength"));
}

// What central differences leave: truncation and round-off of some 1e-10, and as much of an
// ill-conditioned corner again.
constexpr double of_differences = 1e-8;

TEST(TheTangent, StandsUpToDifferencesOfEveryModelAndAFaultOfItIsSeen) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  for (const auto& model : constitutive::material_models()) {
    constitutive::MaterialParameters p;
    p.model = model.name;
    p.youngs_modulus = young;
    p.poissons_ratio = poisson;
    if (model.yields) p.cohesion = 10e3;
    if (model.frictional) p.friction_angle = 25.0, p.dilation_angle = 10.0;
    if (model.critical_state) p = parameters_of(clay({}));
    if (model.curve == constitutive::Curve::hoek_brown) {
      p.intact_strength = 200e3, p.m_i = 10.0, p.gsi = 45.0, p.dilation_ratio = 0.4;
    }
    if (model.curve == constitutive::Curve::power_law) {
      p.power_coefficient = 0.5, p.power_exponent = 0.7, p.dilation_ratio = 0.4;
      p.power_tension = 5e3, p.reference_stress = 100e3;
    }
    const constitutive::Material made = constitutive::make_material(p);
    int smooth = 0;
    for (int trial = 0; trial < 200; ++trial) {
      State begin;
      if (model.critical_state) begin.stress.head<3>().setConstant(-100e3);
      Strain increment;
      for (double& row : increment) row = 2e-3 * normal(engine);
      const Stress stress =
          begin.stress + constitutive::elastic_stress<3>(constitutive::moduli(made), increment);
      constitutive::TangentMatrix<3> tangent = constitutive::tangent<3>(made, stress, begin);
      const double error = tangent_error(made, begin, increment, tangent);
      if (std::isnan(error)) continue;
      ++smooth;
      EXPECT_LT(error, of_differences) << model.name;
      tangent(1, 3) += 1e-6 * young;
      EXPECT_GT(tangent_error(made, begin, increment, tangent), 0.9e-6) << model.name;
    }
    EXPECT_GT(smooth, 150) << model.name;
  }
}

TEST(TheTangent, HasNoErrorOnACorner) {
  constitutive::MaterialParameters p;
  p.model = "von_mises";
  p.youngs_modulus = young;
  p.poissons_ratio = poisson;
  p.cohesion = 10e3;
  const constitutive::Material made = constitutive::make_material(p);
  Strain to_the_surface = Strain::Zero();
  to_the_surface[3] = 10e3 / constitutive::moduli(made).shear;
  const auto tangent = constitutive::tangent<3>(
      made, constitutive::elastic_stress<3>(constitutive::moduli(made), to_the_surface), State{});
  EXPECT_TRUE(std::isnan(tangent_error(made, State{}, to_the_surface, tangent)));
}

}  // namespace
}  // namespace material
