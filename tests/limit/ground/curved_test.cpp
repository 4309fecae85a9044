// Ground of curved envelopes: bounds by parabolas that touch them (programme/parabolas_test.cpp),
// certified against the envelope itself. What takes longer is in
// validation/curved_validation_test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limit/certificate/curved_power.hpp"
#include "limit/certificate/lower_certificate.hpp"
#include "limit/ground/curved_scenes.hpp"

namespace {

using namespace limit;
using problem::Envelope;
using ::testing::HasSubstr;

double hoek_brown_strength(const Envelope& rock, double cell) {
  return cell + rock.stress *
                    std::pow(rock.coefficient * cell / rock.stress + rock.cohesive, rock.exponent);
}

// What a parabola is below an envelope at most where the distance from the apex is a quarter off
// (programme/parabolas_test.cpp).
constexpr double quarter_off = 0.004;

// One state of stress is exact, sigma_3 + sigma_ci (m_b sigma_3 / sigma_ci + s)^a: sigma_ci s^a
// without a cell pressure; of the power law, where the circle about sigma_3 = 0 touches.
TEST(CurvedEnvelope, IsAllThatABlockBears) {
  const Envelope envelope = rock_envelope();
  EXPECT_NEAR(envelope.unconfined(), 20e6 * std::pow(envelope.cohesive, envelope.exponent), 1e-3);
  struct Block {
    std::string scene;
    double exact;
  };
  const std::vector<Block> blocks{{block(rock, 0.0), envelope.unconfined()},
                                  {block(rock, 2e6), hoek_brown_strength(envelope, 2e6)},
                                  {block(power, 0.0), power_envelope().unconfined()}};
  for (const Block& one : blocks) {
    const bracket::Solution found = first_mesh(one.scene);
    ASSERT_TRUE(found.lower && found.upper) << one.exact;
    EXPECT_LE(*found.lower, one.exact * (1.0 + 1e-9));
    EXPECT_GE(*found.upper, one.exact * (1.0 - 1e-9));
    // The first solve is within a twentieth, and so where the second one's parabola touches: a
    // twenty-fifth of what a quarter makes.
    constexpr double solver = 1e-4;
    EXPECT_GE(*found.lower, one.exact * (1.0 - quarter_off / 25.0 - solver));
    EXPECT_LE(*found.upper, one.exact * (1.0 + solver));
  }
}

// The support function is the most that any tangent's apex or circle does; by brute force.
TEST(CurvedEnvelope, HasThePowerOfTheStressThatDoesMost) {
  for (const bool is_rock : {true, false}) {
    for (const double factor : {1.0, 1.6}) {
      Envelope envelope = is_rock ? rock_envelope() : power_envelope();
      envelope.factor = factor;
      for (const double ratio : {0.05, 0.3, 0.6, 0.9}) {
        const double shear = 2.0, dilation = ratio * shear;
        double most = -1e300;
        for (double v = -20.0; v < 10.0; v += 1e-4) {
          const Envelope::Place place = envelope.at(std::exp(v));
          most = std::max(most, place.radius() * shear - place.centre() * dilation);
        }
        const double power = certificate::curved_power(envelope, dilation, shear);
        EXPECT_NEAR(power, most, 1e-7 * std::abs(most)) << is_rock << factor << ' ' << ratio;
        EXPECT_GE(power, most * (1.0 - 1e-12));
      }
      EXPECT_DOUBLE_EQ(certificate::curved_power(envelope, 2.0, 1.0), 2.0 * envelope.apex());
    }
  }
}

// The envelope's own formula in principal stresses, for the circle that the certificate allows.
TEST(CurvedEnvelope, AllowsTheCirclesOfItsFormula) {
  const Envelope envelope = rock_envelope();
  for (double cell = -0.999 * envelope.apex(); cell < 1e9; cell = 1.3 * cell + 2e4) {
    const double strength = hoek_brown_strength(envelope, cell);
    EXPECT_NEAR(envelope.radius_about((cell + strength) / 2.0), (strength - cell) / 2.0,
                1e-12 * (strength + envelope.apex()));
  }
  EXPECT_EQ(envelope.radius_about(-envelope.apex()), 0.0);
}

// The certificate knows the envelope by itself: a field beyond it is drawn back to it.
TEST(CurvedEnvelope, IsHeldToByTheCertificateOfStresses) {
  const auto pressed = case_of(block(rock, 0.0));
  ASSERT_TRUE(pressed);
  const problem::Problem& problem = pressed->associated.lower;
  const double exact = rock_envelope().unconfined();
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  stress.row(1).setConstant(-1.5 * exact);
  const problem::StressField field(problem.mesh.triangles.size(), stress);
  const auto certificate = certificate::certify_lower(problem, field, 1.5 * exact);
  EXPECT_NEAR(certificate.multiplier, exact, 1e-5 * exact);
  EXPECT_LE(certificate.multiplier, exact);
}

std::string complaint(const std::string& text) {
  tables::Diagnosis diagnosis("scene");
  std::optional<tables::Complaint> unreadable;
  const auto scene = ground::read_ground_scene(text, {}, diagnosis, unreadable);
  if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
  return diagnosis.errors().empty() ? "" : diagnosis.errors().front().text();
}

TEST(CurvedEnvelope, IsToldByItsOwnKeysOrRefusedInWords) {
  EXPECT_THAT(complaint(block("model = \"hoek_brown\"\nintact_strength = 1e6\nm_i = 10\n", 0.0)),
              HasSubstr("material.0.gsi: is missing; the model hoek_brown needs it"));
  EXPECT_THAT(complaint(block(std::string(rock) + "cohesion = 1e3\n", 0.0)),
              HasSubstr("material.0.cohesion: given for the model hoek_brown"));
  EXPECT_THAT(complaint(block("cohesion = 1e3\ngsi = 30\n", 0.0)),
              HasSubstr("material.0.gsi: given for the model mohr_coulomb"));
  EXPECT_THAT(complaint(block("model = \"power_law\"\npower_coefficient = 1\npower_exponent = 0.4\n"
                              "power_tension = 1\nreference_stress = 1\n",
                              0.0)),
              HasSubstr("material.0.power_exponent: found 0.4"));
}

}  // namespace
