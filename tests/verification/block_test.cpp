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

// Ground under its geostatic stress, which is in equilibrium with its weight: nothing may move.
struct Ground {
  int dimension = 2;
  std::string layout = "cell";
  std::string method = "direct";
  double jitter = 0.0;
  bool layered = false;
  double surcharge = 0.0;  // [Pa]
};

std::string ground_scene(const Ground& ground) {
  const bool flat = ground.dimension == 2;
  std::ostringstream text;
  text << "[geometry]\ndimension=" << ground.dimension << "\nmin=[0.0,-1.0" << (flat ? "" : ",0.0")
       << "]\nmax=[0.8,0.0" << (flat ? "" : ",0.8") << "]\nspacing=" << (flat ? 0.1 : 0.2)
       << "\nlayout=\"" << ground.layout << "\"\njitter=" << std::showpoint << ground.jitter
       << "\n";
  const auto material = [&](const std::string& name, double density, const std::string& region) {
    text << "[[material]]\nname=\"" << name << "\"\nmodel=\"drucker_prager\"\n"
         << (flat ? "" : "match=\"compression_cone\"\n")
         << "youngs_modulus=" << 10e6 * density / 1850.0
         << "\npoissons_ratio=0.3\ncohesion=1e3\nfriction_angle=30.0\ndilation_angle=0.0\ndensity="
         << density << "\n"
         << region;
  };
  material("soil", 1850.0, "");
  const std::string third = flat ? "" : ", 0.0", far = flat ? "" : ", 0.8";
  if (ground.layered) {
    material("rubble", 2700.0,
             "region_min=[0.0, -0.4" + third + "]\nregion_max=[0.8, 0.0" + far + "]\n");
  }
  const auto hold = [&](const std::string& side, const std::string& directions) {
    text << "[[support]]\nname=\"" << side << "\"\nside=\"" << side << "\"\nmethod=\""
         << ground.method << "\"\ndirections=[" << directions << "]\n";
  };
  hold("bottom", flat ? "\"x\", \"y\"" : "\"x\", \"y\", \"z\"");
  for (const std::string side : {"left", "right"}) hold(side, "\"x\"");
  for (const std::string side : {"front", "back"}) {
    if (!flat) hold(side, "\"z\"");
  }
  text << "[gravity]\nacceleration=[0.0, -9.81" << third
       << "]\n[initial_stress]\nkind=\"geostatic\"\nK0=0.5\nsurcharge=" << ground.surcharge << "\n";
  if (ground.surcharge > 0.0) {
    text << "[[traction]]\nname=\"q\"\nside=\"top\"\nvalue=[0.0, " << -ground.surcharge << third
         << "]\n";
  }
  return text.str() + "[solver]\ntolerance=1e-9\n";
}

template <int Dim>
void expect_rest(const Ground& ground) {
  Run<Dim> run(scene_of(ground_scene(ground)));
  run.complete();
  // Against the settlement rho g H^2 / (2 M) of the same weight.
  const double confined = 10e6 * 0.7 / (1.3 * 0.4);
  const double settlement = 1850.0 * 9.81 / (2.0 * confined);
  EXPECT_LT(run.state.displacement.cwiseAbs().maxCoeff(), 1e-9 * settlement);
  EXPECT_EQ(run.state.plastic_strain.maxCoeff(), 0.0);
  // The base bears what there is, to the last particle.
  const double weight = 9.81 * run.model.mass.sum() + ground.surcharge * (Dim == 2 ? 0.8 : 0.64);
  EXPECT_NEAR(run.state.reaction.col(1).sum() / weight, 1.0, 1e-9);
}

TEST(GroundAtRest, Stays) {
  for (const std::string layout : {"cell", "vertex"}) {
    for (const std::string method : {"direct", "ghosts"}) {
      SCOPED_TRACE(layout + ", " + method);
      expect_rest<2>({2, layout, method});
      expect_rest<2>({2, layout, method, 0.3});
      expect_rest<2>({2, layout, method, 0.0, true});
      expect_rest<2>({2, layout, method, 0.0, false, 5e3});
      expect_rest<3>({3, layout, method, 0.0, true});
    }
  }
}

// A side that is not held does not bear the stress across it, whatever the ground is said to have.
TEST(GroundAtRest, MovesTowardsAFreeSide) {
  std::string text = ground_scene({});
  const std::string right =
      "[[support]]\nname=\"right\"\nside=\"right\"\nmethod=\"direct\"\ndirections=[\"x\"]\n";
  text.erase(text.find(right), right.size());
  verification::Run<2> run(
      scene_of(text, {"material.0.cohesion=20e3", "solver.tolerance=1e-3"}));  // a cut that stands
  run.complete();
  // The mean horizontal stress, K0 rho g H / 2, gone from a width of 0.8: of the order of
  // sigma (1 - nu^2) / E times that width.
  const double order = 0.5 * 1850.0 * 9.81 * 0.5 * (1.0 - 0.09) / 10e6 * 0.8;
  const Eigen::Index corner = run.nearest({0.8, 0.0});
  EXPECT_GT(run.state.displacement(corner, 0), 0.1 * order);  // nothing, were the stress borne
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
