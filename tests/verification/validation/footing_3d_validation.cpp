// Square and circular footings on clay in three dimensions.

#include "footing_3d.hpp"

namespace verification {
namespace {

constexpr double cohesion = 1e3;

std::string quarter_of_footing(const std::string& model) {
  std::string text =
      clay_in_3d("[3.0, 0.0, 3.0]", "range_max = [1.0, 1.0]\ntarget = 0.1\nwidth = 1.0\n",
                 "[[support]]\nname = \"other far side\"\nside = \"back\"\n"
                 "directions = [\"z\"]\nmethod = \"direct\"\n");
  if (model == "mohr_coulomb") {
    const std::string cylinder = "von_mises";
    text.replace(text.find(cylinder), cylinder.size(), model);
    const std::string strength = "cohesion = 1e3\n";
    text.replace(text.find(strength), strength.size(),
                 strength + "friction_angle = 0.0\ndilation_angle = 0.0\n");
  }
  return text;
}

// Of the plate's particles those within its radius are left; it is as large as they are many.
void cut_to_a_circle(model::Model<3>& model) {
  const Eigen::Index n = model.size();
  int left = 0;
  for (Eigen::Index a = 0; a < n; ++a) {
    if (model.driven_particle[static_cast<std::size_t>(a)] == 0) continue;
    const auto x = model.particles.position.row(a);
    if (x[0] * x[0] + x[2] * x[2] < 1.0) {
      ++left;
      continue;
    }
    model.driven_particle[static_cast<std::size_t>(a)] = 0;
    for (int i = 0; i < 3; ++i) {
      // Held across a plane of symmetry or a far side the plate's particles are not.
      model.prescribed[static_cast<std::size_t>(i * n + a)] = 0;
      model.drive[i * n + a] = model.measure[i * n + a] = 0.0;
    }
  }
  model.measure /= left * model.spacing * model.spacing;  // of a width of 1 m2
}

// Mean pressure at the end over the cohesion.
double collapse_pressure(const std::string& model_name, bool round, int particles) {
  const TestScene scene =
      scene_of(quarter_of_footing(model_name), {"geometry.spacing=" + in_full(1.0 / particles)});
  auto model = model::build_model<3>(scene);
  if (round) cut_to_a_circle(model);
  auto state = model::initial_state(model);
  stepping::LoadStepper<3> stepper(scene, model, state);
  double pressure = 0.0;
  while (state.programme.load < 1.0 - 1e-12) {
    const auto result = stepper.advance();
    if (result.outcome != stepping::StepOutcome::converged) {
      ADD_FAILURE() << result.reason;
      break;
    }
    pressure = result.record.mean_pressure / cohesion;
  }
  report(model_name + (round ? "_circle_at_" : "_square_at_") + std::to_string(particles),
         pressure);
  return pressure;
}

constexpr std::array<int, 3> spacings{4, 6, 8};

std::vector<double> pressures(const std::string& model, bool round) {
  std::vector<double> all;
  for (const int particles : spacings) all.push_back(collapse_pressure(model, round, particles));
  return all;
}

// Richardson's limit of a first-order sequence at 6 and 8 particles over the half width.
double limit_of(const std::vector<double>& p) {
  return 4.0 * p[2] - 3.0 * p[1];
}

TEST(Footing3d, SquareOnClayOfTrescaTendsToThePublishedBounds) {
  // Rough square on Tresca's clay, bounds and finite elements: 5.9 +- 0.15 c (Gourvenec, Randolph &
  // Kingsnorth 2006; Salgado et al. 2004).
  const auto p = pressures("mohr_coulomb", false);
  report("limit", limit_of(p));
  EXPECT_NEAR(p[2], 5.9, 0.15);
}

// Of tetrahedra of Gmsh, 0.1 m long under the radius of 1 m. The error fell from 6.4 to 1.8 and 0.9
// % as they fell from 0.15 to 0.06 m (share/scenes/circle.toml): a bound of twice that of this
// mesh.
TEST(Footing3d, CircleOfTetrahedraTendsToTheExactLoad) {
  const TestScene scene = shipped_scene("circle.toml");
  const auto model = model::build_model<3>(scene);
  auto state = model::initial_state(model);
  stepping::LoadStepper<3> stepper(scene, model, state);
  double pressure = 0.0;
  while (state.programme.load < 1.0 - 1e-12) {
    const auto result = stepper.advance();
    ASSERT_EQ(result.outcome, stepping::StepOutcome::converged) << result.reason;
    pressure = result.record.corrected_pressure / cohesion;
  }
  report("circle_of_tetrahedra", pressure);
  EXPECT_NEAR(pressure / 6.05, 1.0, 0.036);
}

TEST(Footing3d, CircleOnClayOfTrescaTendsToTheExactLoad) {
  // Rough circle, exact: 6.05 c (Eason & Shield 1960).
  const auto p = pressures("mohr_coulomb", true);
  report("limit", limit_of(p));
  EXPECT_LT(std::abs(p[2] / 6.05 - 1.0), 0.03);
}

// The cylinder sqrt(J2) = c carries less than the prism where the stress is axisymmetric (1.73 c in
// compression for 2 c), and as much in plane strain: its loads lie between sqrt(3) / 2 of the
// prism's and the prism's.
TEST(Footing3d, OnVonMisesClayIsBelowThatOfTresca) {
  const auto square = pressures("von_mises", false), round = pressures("von_mises", true);
  const double least = 0.5 * std::sqrt(3.0);
  EXPECT_GT(square[2], least * 5.9);
  EXPECT_LT(square[2], 5.9);
  EXPECT_GT(round[2], least * 6.05);
  EXPECT_LT(round[2], 6.05);
}

}  // namespace
}  // namespace verification
