#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <constitutive/version.hpp>
#include <ostream>
#include <set>

#include "points.hpp"

namespace {

using namespace constitutive;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const double infinity = std::numeric_limits<double>::infinity();

TEST(MaterialParameters, OfEveryModelAreAcceptedAndMakeThatMaterial) {
  for (const ModelInfo& model : material_models()) {
    EXPECT_THAT(validate(points::soil(std::string(model.name))), IsEmpty()) << model.name;
  }
  EXPECT_TRUE(std::holds_alternative<Elastic>(make_material(points::soil("elastic"))));
  EXPECT_TRUE(std::holds_alternative<VonMises>(make_material(points::soil("von_mises"))));
  EXPECT_TRUE(std::holds_alternative<MohrCoulomb>(make_material(points::soil("mohr_coulomb"))));
  const auto matched = std::get<DruckerPrager>(make_material(points::soil("drucker_prager")));
  const auto outer =
      std::get<DruckerPrager>(make_material(points::soil("drucker_prager_compression")));
  EXPECT_LT(matched.cone.alpha, outer.cone.alpha);
}

struct Refusal {
  const char* field;
  void (*spoil)(MaterialParameters&);

  friend std::ostream& operator<<(std::ostream& out, const Refusal& r) { return out << r.field; }
};

class RefusedParameters : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedParameters, AreNamedInOneMessage) {
  MaterialParameters p = points::soil("mohr_coulomb");
  GetParam().spoil(p);
  EXPECT_THAT(validate(p), ElementsAre(StartsWith(GetParam().field)));
  EXPECT_THROW((void)make_material(p), std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedParameters,
    testing::Values(
        Refusal{"youngs_modulus", [](MaterialParameters& p) { p.youngs_modulus = 0; }},
        Refusal{"youngs_modulus", [](MaterialParameters& p) { p.youngs_modulus = -1; }},
        Refusal{"youngs_modulus", [](MaterialParameters& p) { p.youngs_modulus = std::nan(""); }},
        Refusal{"youngs_modulus", [](MaterialParameters& p) { p.youngs_modulus = infinity; }},
        Refusal{"poissons_ratio", [](MaterialParameters& p) { p.poissons_ratio = 0.5; }},
        Refusal{"poissons_ratio", [](MaterialParameters& p) { p.poissons_ratio = -1; }},
        Refusal{"poissons_ratio", [](MaterialParameters& p) { p.poissons_ratio = std::nan(""); }},
        Refusal{"cohesion", [](MaterialParameters& p) { p.cohesion = -1e-9; }},
        Refusal{"cohesion", [](MaterialParameters& p) { p.cohesion = infinity; }},
        Refusal{"cohesion", [](MaterialParameters& p) { p.cohesion = std::nan(""); }},
        Refusal{
            "cohesion",
            [](MaterialParameters& p) { p.cohesion = p.friction_angle = p.dilation_angle = 0; }},
        Refusal{"friction_angle", [](MaterialParameters& p) { p.friction_angle = 90; }},
        Refusal{"friction_angle", [](MaterialParameters& p) { p.friction_angle = -1; }},
        Refusal{"friction_angle", [](MaterialParameters& p) { p.friction_angle = std::nan(""); }},
        Refusal{"friction_angle",
                [](MaterialParameters& p) {
                  p.model = "von_mises";
                  p.dilation_angle = 0;
                }},
        Refusal{"dilation_angle", [](MaterialParameters& p) { p.dilation_angle = 20.001; }},
        Refusal{"dilation_angle", [](MaterialParameters& p) { p.dilation_angle = -0.1; }},
        Refusal{"dilation_angle", [](MaterialParameters& p) { p.dilation_angle = std::nan(""); }},
        Refusal{"density", [](MaterialParameters& p) { p.density = -1; }},
        Refusal{"density", [](MaterialParameters& p) { p.density = infinity; }},
        Refusal{"dilation_cutoff", [](MaterialParameters& p) { p.dilation_cutoff = -0.01; }},
        Refusal{"dilation_cutoff", [](MaterialParameters& p) { p.dilation_cutoff = std::nan(""); }},
        Refusal{"model", [](MaterialParameters& p) { p.model = "cam_clay"; }}));

class RefusedResiduals : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedResiduals, AreNamedInOneMessage) {
  MaterialParameters p = points::soil("mohr_coulomb");
  p.residual_strain = 0.1;
  p.residual_cohesion = 5e3;
  p.residual_friction_angle = 15;
  ASSERT_THAT(validate(p), IsEmpty());
  GetParam().spoil(p);
  EXPECT_THAT(validate(p), ElementsAre(StartsWith(GetParam().field)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedResiduals,
    testing::Values(
        Refusal{"residual_strain", [](MaterialParameters& p) { p.residual_strain = 0; }},
        Refusal{"residual_strain", [](MaterialParameters& p) { p.residual_strain = std::nan(""); }},
        Refusal{"residual_cohesion", [](MaterialParameters& p) { p.residual_cohesion = -1; }},
        Refusal{"residual_friction_angle",
                [](MaterialParameters& p) { p.residual_friction_angle = 90; }},
        Refusal{"residual_friction_angle",
                [](MaterialParameters& p) { p.residual_friction_angle = 9; }},
        Refusal{"residual_cohesion",
                [](MaterialParameters& p) {
                  p.residual_cohesion = p.residual_friction_angle = p.dilation_angle = 0;
                }},
        Refusal{"residual_cohesion",
                [](MaterialParameters& p) {
                  p.residual_strain = p.residual_friction_angle = infinity;
                }},
        Refusal{"residual_strain",
                [](MaterialParameters& p) {
                  p.residual_cohesion = p.residual_friction_angle = infinity;
                }},
        Refusal{"tension_cutoff", [](MaterialParameters& p) { p.tension_cutoff = 0; }}));

class RefusedClay : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedClay, IsNamedInOneMessage) {
  MaterialParameters p = points::clay();
  GetParam().spoil(p);
  EXPECT_THAT(validate(p), ElementsAre(StartsWith(GetParam().field)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedClay,
    testing::Values(
        Refusal{"compression_index", [](MaterialParameters& p) { p.compression_index = infinity; }},
        Refusal{"swelling_index", [](MaterialParameters& p) { p.swelling_index = 0; }},
        Refusal{"swelling_index", [](MaterialParameters& p) { p.swelling_index = 0.08; }},
        Refusal{"critical_stress_ratio",
                [](MaterialParameters& p) { p.critical_stress_ratio = 3; }},
        Refusal{"preconsolidation_pressure",
                [](MaterialParameters& p) { p.preconsolidation_pressure = 0; }}));

class RefusedCurves : public testing::TestWithParam<Refusal> {};

TEST_P(RefusedCurves, AreNamedInOneMessage) {
  for (const char* model : {"hoek_brown", "power_law"}) {
    MaterialParameters p = points::soil(model);
    GetParam().spoil(p);
    const bool has = parameter_info(GetParam().field).is_used_by(*find_model(model));
    if (has) {
      EXPECT_THAT(validate(p), ElementsAre(StartsWith(GetParam().field))) << model;
    }
    if (!has) {
      EXPECT_THAT(validate(p), IsEmpty()) << model;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Each, RefusedCurves,
    testing::Values(
        Refusal{"intact_strength", [](MaterialParameters& p) { p.intact_strength = 0; }},
        Refusal{"m_i", [](MaterialParameters& p) { p.m_i = 0; }},
        Refusal{"gsi", [](MaterialParameters& p) { p.gsi = -1; }},
        Refusal{"gsi", [](MaterialParameters& p) { p.gsi = 101; }},
        Refusal{"disturbance", [](MaterialParameters& p) { p.disturbance = 1.01; }},
        Refusal{"power_coefficient", [](MaterialParameters& p) { p.power_coefficient = 0; }},
        Refusal{"power_exponent", [](MaterialParameters& p) { p.power_exponent = 0.49; }},
        Refusal{"power_exponent", [](MaterialParameters& p) { p.power_exponent = 1; }},
        Refusal{"power_tension", [](MaterialParameters& p) { p.power_tension = -1; }},
        Refusal{"reference_stress", [](MaterialParameters& p) { p.reference_stress = 0; }},
        Refusal{"dilation_ratio", [](MaterialParameters& p) { p.dilation_ratio = 1.01; }}));

TEST(MaterialParameters, ReportAllProblemsAtOnce) {
  MaterialParameters p;
  p.model = "clay";
  p.poissons_ratio = 0.7;
  p.cohesion = -1;
  p.dilation_angle = 5;
  p.density = -1;
  const auto messages = validate(p);
  for (const char* field :
       {"model", "youngs_modulus", "poissons_ratio", "cohesion", "dilation_angle", "density"}) {
    EXPECT_THAT(messages, Contains(StartsWith(field)));
  }
  try {
    (void)make_material(p);
    FAIL();
  } catch (const std::invalid_argument& refused) {
    for (const std::string& message : messages) EXPECT_THAT(refused.what(), HasSubstr(message));
  }
}

TEST(MaterialParameters, OfFrictionWithoutCohesionAreAccepted) {
  for (const char* model : {"drucker_prager", "drucker_prager_compression", "mohr_coulomb"}) {
    MaterialParameters p = points::soil(model);
    p.cohesion = 0;
    EXPECT_THAT(validate(p), IsEmpty());
  }
}

TEST(MaterialParameters, OfElasticityDoNotNeedStrength) {
  MaterialParameters p;
  p.model = "elastic";
  p.youngs_modulus = 1;
  EXPECT_THAT(validate(p), IsEmpty());
}

TEST(MaterialParameters, OfThePlaneStrainMatchAreRefusedInThreeDimensions) {
  const MaterialParameters p = points::soil("drucker_prager");
  EXPECT_THAT(validate(p, 2), IsEmpty());
  EXPECT_THAT(validate(p, 3), ElementsAre(AllOf(StartsWith("model"), HasSubstr("mohr_coulomb"))));
  EXPECT_THAT(validate(points::soil("drucker_prager_compression"), 3), IsEmpty());
  EXPECT_THAT(validate(p, 4), Contains(StartsWith("dimension")));
}

TEST(MaterialParameters, ListEveryFieldOnce) {
  std::set<std::string> names;
  int fields = 0;
  points::soil("elastic").for_each_field([&](const char* name, const auto&) {
    names.insert(name);
    ++fields;
  });
  EXPECT_EQ(fields, 26);
  EXPECT_EQ(names.size(), 26u);
}

TEST(Version, IsThatOfTheCMakePackage) {
  EXPECT_STREQ(version, CONSTITUTIVE_PACKAGE_VERSION);
}

TEST(PointState, ListsEveryNumberItHolds) {
  PointState<3> s;
  std::size_t bytes = 0;
  s.for_each_field([&](const char*, auto& field) { bytes += sizeof(field); });
  EXPECT_EQ(bytes, sizeof(s)) << "a field is missing from the list (8 doubles, no padding)";
}

}  // namespace
