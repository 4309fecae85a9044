// A block whose strength grows with its plastic strain, and a column of Modified Cam Clay.

#include "constitutive/material.hpp"
#include "measure.hpp"

namespace verification {
namespace {

constexpr double young = 1e6, poisson = 0.3;  // [Pa]
constexpr double height = 2.0;                // [m]

// Pressed between smooth faces: all sides are free in the plane.
const std::string pressed_block = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 2.0]
spacing = 0.125
layout = "vertex"
[approximation]
kinematics = "small_strain"
consistency = "on"
[[material]]
name = "block"
model = "mohr_coulomb"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 5e3
friction_angle = 0.0
dilation_angle = 0.0
residual_strain = 0.02
residual_cohesion = 8e3
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
method = "direct"
[[support]]
name = "middle"
at = [0.5, 0.0]
directions = ["x"]
method = "direct"
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
lateral = "free"
method = "direct"
target = 0.1
width = 1.0
[programme]
steps = 20
[solver]
tolerance = 1e-8
max_evaluations_per_step = 4000
)";

// sigma = 2 c(k) with k = 2 / sqrt 3 (e - (1 - nu^2) sigma / E): elastic, hardening, residual, each
// straight. With consistent rows the block stays homogeneous; what is left is the solver's
// tolerance, amplified by the ratio of the moduli before and after yielding.
TEST(ABlockThatHardens, FollowsItsThreeStraightLines) {
  constexpr double c = 5e3, residual = 8e3, over = 0.02, tolerance = 1e-5;
  const double modulus = young / (1.0 - poisson * poisson);
  const double slope = 2.0 * (residual - c) / over * 2.0 / std::sqrt(3.0);
  verification::Run<2> run(scene_of(pressed_block, {}));
  int hardening = 0, ended = 0;
  for (const auto& record : run.complete()) {
    const double strain = record.settlement / height;
    const double elastic = modulus * strain;
    const double changing = (2.0 * c + slope * strain) / (1.0 + slope / modulus);
    const double exact = std::min({elastic, changing, 2.0 * residual});
    EXPECT_NEAR(record.mean_pressure, exact, tolerance * residual) << strain;
    hardening += exact == changing ? 1 : 0;
    ended += exact == 2.0 * residual ? 1 : 0;
  }
  EXPECT_GT(hardening, 3);
  EXPECT_GT(ended, 3);
}

const std::string column = R"(
[geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.25
layout = "vertex"
[approximation]
kinematics = "small_strain"
consistency = "on"
[[material]]
name = "clay"
model = "modified_cam_clay"
youngs_modulus = 10e6
poissons_ratio = 0.3
density = 1.0
compression_index = 0.1
swelling_index = 0.02
critical_stress_ratio = 1.0
overconsolidation_ratio = 1.5
[gravity]
acceleration = [0.0, -9.81]
[initial_stress]
kind = "geostatic"
K0 = 0.6
surcharge = 100e3
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
method = "direct"
[[support]]
name = "left"
side = "left"
directions = ["x"]
method = "direct"
[[support]]
name = "right"
side = "right"
directions = ["x"]
method = "direct"
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0]
lateral = "fixed"
method = "direct"
target = 0.05
width = 1.0
[programme]
steps = 20
[solver]
tolerance = 1e-6
max_evaluations_per_step = 4000
)";

// Every particle is the element of clay of its own stress and preconsolidation, strained as the
// column is; the ten pascals of weight are 1e-4 of the stress, and what they strain otherwise.
TEST(AColumnOfModifiedCamClay, IsThatElementOfItInAnOedometer) {
  constexpr double tolerance = 1e-3;
  verification::Run<2> run(scene_of(column, {}));
  const auto& records = run.complete();
  for (Eigen::Index a = 0; a < run.model.size(); ++a) {
    const constitutive::Material& law = run.model.laws[run.model.law[static_cast<std::size_t>(a)]];
    constitutive::PointState<2> s;
    s.stress = run.model.initial_stress.col(a);
    const double mean = -constitutive::mean_stress(s.stress);
    const double equivalent = mean + 3.0 * constitutive::j2(s.stress) / mean;
    const auto& clay = std::get<constitutive::ModifiedCamClay>(law);
    EXPECT_NEAR(clay.preconsolidation, 1.5 * equivalent, 1e-9 * equivalent);
    double before = 0.0;
    for (const auto& record : records) {
      const constitutive::StrainVector<2> strain =
          constitutive::StrainVector<2>::Unit(1) * (before - record.settlement);
      before = record.settlement;
      const constitutive::StressVector<2> trial =
          s.stress + constitutive::elastic_stress<2>(clay.moduli, strain);
      ASSERT_FALSE(constitutive::update(law, trial, s, s).failed);
    }
    EXPECT_LT(s.plastic_volume_strain, -0.02) << "most of the strain is plastic";
    EXPECT_LT((run.state.stress.col(a) - s.stress).norm(), tolerance * s.stress.norm()) << a;
    EXPECT_NEAR(run.state.plastic_volume_strain[a], s.plastic_volume_strain, tolerance * 0.05);
  }
}

}  // namespace
}  // namespace verification
