// Confined column under its own weight, geostatic equilibrium, and homogeneous yielding in 3D.

#include <numbers>

#include "measure.hpp"

namespace verification {
namespace {

// The exact column of share/scenes/block3d.toml.
constexpr double weight = 2500.0 * 9.81;              // [N/m3]
constexpr double modulus = 10e6 * 0.7 / (1.3 * 0.4);  // [Pa] confined
constexpr double height = 2.0;                        // [m]
constexpr double settlement = weight * height * height / (2.0 * modulus);

struct Column {
  double field = 0.0;   // largest error of any displacement over the top's settlement
  double stress = 0.0;  // largest error of the vertical stress at mid-height over rho g H
};

Column column(double spacing, const std::string& consistency) {
  Run<3> run(shipped_scene("block3d.toml",
                           {"geometry.spacing=" + std::to_string(spacing),
                            "approximation.consistency=" + consistency, "solver.tolerance=1e-6"}));
  run.complete();
  Column result;
  for (Eigen::Index a = 0; a < run.model.size(); ++a) {
    const double y = run.model.particles.position(a, 1);
    Eigen::RowVector3d u = run.state.displacement.row(a);
    u[1] += weight * (height * y - 0.5 * y * y) / modulus;
    result.field = std::max(result.field, u.cwiseAbs().maxCoeff() / settlement);
    if (std::abs(y - 0.5 * height) > 0.5 * spacing) continue;
    const double error = run.state.stress(1, a) + weight * (height - y);
    result.stress = std::max(result.stress, std::abs(error) / (weight * height));
  }
  const std::string at = "_" + consistency + "_at_" + std::to_string(spacing);
  report("displacement_error" + at, result.field);
  report("stress_error" + at, result.stress);
  return result;
}

// An error a h^p (1 + b h), h = dx / H <= 1/8 and b of order one, has an order within 0.2 of p.
constexpr double order_tolerance = 0.2;

TEST(Block, SettlesAsTheConfinedColumnAtSecondOrderWithConsistency) {
  const Column coarse = column(0.25, "on"), fine = column(0.125, "on");
  EXPECT_NEAR(convergence_order(coarse.field, fine.field, 2.0), 2.0, order_tolerance);
  EXPECT_LT(fine.stress, coarse.stress);
}

// Without it the integration at the faces is off by a share dx / H of the forces.
TEST(Block, SettlesAsTheConfinedColumnAtFirstOrderWithoutConsistency) {
  const Column coarse = column(0.25, "off"), fine = column(0.125, "off");
  EXPECT_NEAR(convergence_order(coarse.field, fine.field, 2.0), 1.0, order_tolerance);
}

// A column of soil under its geostatic stress: exact in the continuum, so that all that moves is
// the integration's error, small against the settlement rho g H^2 / (2 M) of the same weight.
std::string geostatic_scene(double spacing, const std::string& layout) {
  std::ostringstream text;
  text << "[geometry]\ndimension=2\nmin=[0.0,-1.0]\nmax=[1.0,0.0]\nspacing=" << spacing
       << "\nlayout=\"" << layout << "\"\n[approximation]\nconsistency=\""
       << (layout == "vertex" ? "on" : "off") << "\"\n";
  return text.str() + R"(
[[material]]
name = "soil"
model = "drucker_prager"
youngs_modulus = 50e6
poissons_ratio = 0.3
cohesion = 2.5e3
friction_angle = 30.0
dilation_angle = 0.0
density = 1850.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "right"
side = "right"
directions = ["x"]
[gravity]
acceleration = [0.0, -9.81]
[initial_stress]
kind = "geostatic"
[solver]
tolerance = 1e-6
)";
}

double geostatic_drift(double spacing, const std::string& layout) {
  constexpr double confined = 50e6 * 0.7 / (1.3 * 0.4);
  Run<2> run(scene_of(geostatic_scene(spacing, layout)));
  run.complete();
  const double drift =
      run.state.displacement.cwiseAbs().maxCoeff() / (1850.0 * 9.81 / (2.0 * confined));
  report("drift_" + layout + "_at_" + std::to_string(spacing), drift);
  return drift;
}

TEST(Geostatic, DriftOfCellLatticeIsOfFirstOrder) {
  for (const double spacing : {0.1, 0.05}) EXPECT_LT(geostatic_drift(spacing, "cell"), spacing);
}
TEST(Geostatic, DriftOfConsistentVertexLatticeIsOfSecondOrder) {
  for (const double spacing : {0.1, 0.05}) {
    EXPECT_LT(geostatic_drift(spacing, "vertex"), spacing * spacing);
  }
}

// A cube between smooth platens with free sides: a homogeneous state on the edge of the
// Mohr-Coulomb pyramid, and on the meridian where the compression cone meets it. Strength
// 2 c cos(phi) / (1 - sin(phi)).
double cube_strength(const std::string& model) {
  const std::string text = R"(
[geometry]
dimension = 3
min = [0.0, 0.0, 0.0]
max = [0.4, 0.4, 0.4]
spacing = 0.1
layout = "vertex"
[approximation]
kinematics = "small_strain"
consistency = "on"
[[material]]
name = "soil"
youngs_modulus = 1e6
poissons_ratio = 0.3
cohesion = 1e3
friction_angle = 30.0
dilation_angle = 10.0
)" + model + R"(
[[support]]
name = "base"
side = "bottom"
directions = ["y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[support]]
name = "back"
side = "back"
directions = ["z"]
[drive]
kind = "displacement"
side = "top"
direction = [0.0, -1.0, 0.0]
lateral = "free"
target = 0.004
width = 0.16
[programme]
steps = 10
[solver]
tolerance = 1e-5
max_evaluations_per_step = 4000
)";
  Run<3> run(scene_of(text));
  const auto last = run.complete().back();
  EXPECT_EQ(last.plastic_particles, run.model.size());
  return last.mean_pressure;
}

TEST(Cube, YieldsAtItsUniaxialStrengthInSpace) {
  // The solver tolerance, times the root of the number of prescribed unknowns that share it.
  constexpr double tolerance = 1e-4;
  const double phi = 30.0 * std::numbers::pi / 180.0;
  const double exact = 2.0 * 1e3 * std::cos(phi) / (1.0 - std::sin(phi));
  const double mohr_coulomb = cube_strength("model = \"mohr_coulomb\"");
  const double cone = cube_strength("model = \"drucker_prager\"\nmatch = \"compression_cone\"");
  report("mohr_coulomb_error", mohr_coulomb / exact - 1.0);
  report("compression_cone_error", cone / exact - 1.0);
  EXPECT_NEAR(mohr_coulomb, exact, tolerance * exact);
  EXPECT_NEAR(cone, exact, tolerance * exact);
}

}  // namespace
}  // namespace verification
