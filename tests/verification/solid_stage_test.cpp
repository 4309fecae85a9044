// Stages of bodies in space.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "measure.hpp"
#include "model/measures.hpp"
#include "model/model.hpp"
#include "solid_column.hpp"
#include "staged_run.hpp"

namespace verification {
namespace {

using SolidRun = StagedRunIn<3>;

double measured(const SolidRun& run, const std::string& column) {
  const model::Measures<3> measures(run.stages.scene(), run.stages.model());
  const auto& names = measures.columns();
  const auto at = std::find(names.begin(), names.end(), column);
  EXPECT_NE(at, names.end()) << column;
  return measures.of(run.state).at(static_cast<std::size_t>(at - names.begin()));
}

using solid_column::oedometric;
using solid_column::weight;

const std::string column = solid_column::scene + R"(
[solver]
tolerance = 1e-6
[[measure]]
name = "base"
kind = "reaction"
support = "base"
[[stage]]
name = "dig"
remove = ["high"]
steps = 2
[[stage]]
name = "fill"
place = ["high"]
steps = 2
)";

// The largest differences from a column that moves by `exact` of its height and has the stress of
// ground up to `top`.
struct Off {
  double displacement = 0.0, stress = 0.0;
};
template <typename Exact>
Off off(const SolidRun& run, const Exact& exact, double top) {
  Off worst;
  for (Eigen::Index a = 0; a < run.state.displacement.rows(); ++a) {
    const double y = run.stages.model().particles.position(a, 1);
    worst.displacement =
        std::max(worst.displacement, std::abs(run.state.displacement(a, 1) - exact(y)));
    worst.stress = std::max(worst.stress, std::abs(run.state.stress(1, a) + weight * (top - y)));
  }
  return worst;
}

// What was dug away was q = gamma h on the rest, which heaves by q y / E_oed. Put down again, where
// the heaved particle below it is, it presses it back and settles under its own weight by
// gamma (h^2 - (h - y)^2) / (2 E_oed) besides. Weight is in lumps, half a cell off beside the new
// surface: of first order, and never more than a cell's share of the heave and of the stress.
TEST(SolidStages, HeaveByTheWeightTakenAndGoBackUnderIt) {
  constexpr double q = weight * 2.0, largest = q * 4.0 / oedometric;
  constexpr double of_base = 2e-4;  // as that of ground in the plane in many stages
  std::vector<double> errors;
  for (const double spacing : {0.25, 0.125}) {
    SolidRun run(scene_of(column, {fmt::format("geometry.spacing={}", spacing)}));
    const double half_a_cell = 0.5 * spacing * weight;
    const auto cells = [&](double to) { return std::lround(to / (spacing * spacing * spacing)); };
    ASSERT_TRUE(run.complete_stage());
    ASSERT_EQ(run.state.displacement.rows(), cells(4.0));
    const Off dug = off(
        run, [](double y) { return q * y / oedometric; }, 4.0);
    EXPECT_LT(dug.displacement, 0.01 * largest);
    EXPECT_LT(dug.stress, half_a_cell);
    EXPECT_NEAR(measured(run, "base_Ry_N"), 4.0 * weight, of_base * 4.0 * weight);

    const double begun = run.state.displacement.col(1).maxCoeff();
    run.stages.go_on(run.state);
    ASSERT_TRUE(run.complete_stage());
    ASSERT_EQ(run.state.displacement.rows(), cells(6.0));
    const auto back = [&](double y) {
      const double high = y - 4.0;
      const double own = weight * (4.0 - (2.0 - high) * (2.0 - high)) / (2.0 * oedometric);
      return high < 0.0 ? 0.0 : begun - largest - own;
    };
    const Off filled = off(run, back, 6.0);
    EXPECT_LT(filled.displacement, spacing / 4.0 * largest);
    EXPECT_LT(filled.stress, half_a_cell);
    EXPECT_NEAR(measured(run, "base_Ry_N"), 6.0 * weight, of_base * 6.0 * weight);
    errors.push_back(filled.displacement / largest);
    report(fmt::format("error_over_heave_at_{}", spacing), errors.back());
  }
  EXPECT_LT(errors[1], 0.6 * errors[0]);
}

// A quarter of a bore of 1 m in rock under 10 MPa across it and 4 MPa along it, held at R = 4 m.
// Without its core the face comes in by C (1 / a - a / R^2), C = p (1 + nu) (1 - 2 nu) / E / ((1 -
// 2 nu) / a^2 + 1 / R^2); what presses along it, and is held, does not matter.
std::string bore(double spacing) {
  return fmt::format("[geometry]\ndimension = 3\ndepth = [0, {}]\nspacing = {}\n", 4.0 * spacing,
                     spacing) +
         R"(
[approximation]
kinematics = "small_strain"
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 2.5e9
poissons_ratio = 0.25
[[region]]
name = "core"
material = "rock"
outline = [[0, 0], { centre = [0, 0], radius = 1, from = 0, to = 90 }]
[[region]]
name = "around"
material = "rock"
outline = [{ centre = [0, 0], radius = 1, from = 90, to = 0 },
           { centre = [0, 0], radius = 4, from = 0, to = 90 }]
[[side]]
name = "level"
kind = "symmetry"
along = [[0, 0], [4, 0]]
[[side]]
name = "upright"
kind = "symmetry"
along = [[0, 4], [0, 0]]
[[side]]
name = "far"
kind = "fixed"
along = [{ centre = [0, 0], radius = 4, from = 0, to = 90 }]
[initial_stress]
kind = "uniform"
sigma_x = -10e6
sigma_y = -10e6
sigma_z = -4e6
[[support]]
name = "front"
side = "front"
directions = ["z"]
[[support]]
name = "back"
side = "back"
directions = ["z"]
[solver]
tolerance = 1e-5
[[stage]]
name = "dig"
remove = ["core"]
steps = 1
[[measure]]
name = "face"
kind = "displacement"
)" + fmt::format("at = [{:.9f}, 0.5, {}]\n", std::cos(std::numbers::pi / 6.0), 2.0 * spacing);
}

TEST(SolidStages, CloseABoreAsLameSays) {
  constexpr double a2 = 1.0, R2 = 16.0, modulus = 2.5e9, nu = 0.25, p = 10e6;
  constexpr double C =
      p * (1.0 + nu) * (1.0 - 2.0 * nu) / modulus / ((1.0 - 2.0 * nu) / a2 + 1.0 / R2);
  constexpr double exact = C * (1.0 - 1.0 / R2);
  std::vector<double> errors;
  double particles = 0.0;
  for (const double spacing : {0.25, 0.125}) {
    SolidRun run(scene_of(bore(spacing)));
    run.complete();
    const double across = -measured(run, "face_ux_m") * std::cos(std::numbers::pi / 6.0) -
                          measured(run, "face_uy_m") * 0.5;
    errors.push_back(across / exact - 1.0);
    report(fmt::format("error_at_{}", spacing), errors.back());
    EXPECT_NEAR(measured(run, "face_uz_m"), 0.0, 1e-6 * exact);
    particles = static_cast<double>(run.stages.model().size());
  }
  EXPECT_LT(std::abs(errors[1]), std::abs(errors[0]));
  EXPECT_NEAR(errors[1], 0.0, 0.03);
  // Twice as wide further than a radius from the bore.
  SolidRun graded(scene_of(bore(0.125) +
                           "[grading]\nenabled = true\ncoarsest = 0.25\ngrowth = 0.5\n"
                           "[[refine]]\nat = [0, 0, 0.25]\nradius = 2\n"));
  graded.complete();
  const double across = -measured(graded, "face_ux_m") * std::cos(std::numbers::pi / 6.0) -
                        measured(graded, "face_uy_m") * 0.5;
  report("error_graded", across / exact - 1.0);
  report("share_graded", static_cast<double>(graded.stages.model().size()) / particles);
  EXPECT_NEAR(across / exact, 1.0, 0.5 * errors[0]);
}

}  // namespace
}  // namespace verification
