// Particles graded to where it matters: exact where lattices are, and more for less elsewhere.

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "bodies.hpp"
#include "constitutive/objective.hpp"
#include "limit_load.hpp"
#include "run.hpp"

namespace verification {
namespace {

// What a strip's load costs and how wrong it is.
struct Strip {
  double raw = 0.0;
  Eigen::Index particles = 0;
  int evaluations = 0;
  int steps = 0;
};

Strip strip(const std::string& scene, double exact, int finest, const Settings& more) {
  Settings settings = {fmt::format("geometry.spacing={}", 1.0 / finest)};
  settings.insert(settings.end(), more.begin(), more.end());
  Run<2> run(shipped_scene(scene, settings));
  Strip result;
  const auto records = run.complete();
  for (const stepping::StepRecord& record : records)
    result.evaluations += static_cast<int>(record.evaluations);
  result.steps = static_cast<int>(records.size());
  result.raw = records.back().mean_pressure / exact - 1.0;
  result.particles = run.model.size();
  report(fmt::format("raw_error_at_{}", finest), result.raw);
  report(fmt::format("particles_at_{}", finest), static_cast<double>(result.particles));
  report(fmt::format("evaluations_per_step_at_{}", finest),
         static_cast<double>(result.evaluations) / result.steps);
  return result;
}

const Settings graded{"grading.enabled=true"};

// The study of grading (graded-particles.md) asks for these errors of these few particles; the
// lattice of 32 768 is off by 0.36 % at phi = 0.
TEST(GradedStrip, CarriesPrandtlsLoadWithAThousandParticles) {
  struct Target {
    int finest;
    double error;
  };
  for (const Target& target : {Target{16, 0.015}, Target{64, 0.0045}}) {
    for (const bool by_ghosts : {false, true}) {
      Settings settings = graded;
      if (by_ghosts) {
        for (const char* held : {"support.0", "support.1", "drive"}) {
          settings.push_back(fmt::format("{}.method=ghosts", held));
        }
      }
      const Strip clay = strip("prandtl_phi0.toml", exact_pressure_phi0, target.finest, settings);
      const Strip soil = strip("prandtl_phi20.toml", exact_pressure_phi20, target.finest, settings);
      EXPECT_LT(std::abs(clay.raw), target.error);
      EXPECT_LT(std::abs(soil.raw), target.error);
      EXPECT_LT(clay.particles, 1000);
      EXPECT_LT(soil.particles, 1500);
    }
  }
}

// The background grid follows the particles: no more evaluations than the lattice's, and half.
TEST(GradedStrip, TakesNoMoreEvaluationsThanTheLatticeOfItsFinestSpacing) {
  for (const char* scene : {"prandtl_phi0.toml", "prandtl_phi20.toml"}) {
    const Strip lattice = strip(scene, exact_pressure_phi0, 16, {});
    const Strip tree = strip(scene, exact_pressure_phi0, 16, graded);
    EXPECT_LE(tree.evaluations, 1.3 * lattice.evaluations);
  }
}

// A square block, confined, pressed by its own rim: the finest spacing at one corner alone.
std::string block(const std::string& more) {
  return "[geometry]\ndimension = 2\nmin = [0.0, 0.0]\nmax = [0.8, 1.0]\nspacing = 0.025\n"
         "[grading]\nenabled = true\ngrowth = 0.5\n[[refine]]\nat = [0.8, 1.0]\n"
         "[[material]]\nname = \"m\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
         "poissons_ratio = 0.25\n" +
         more;
}

// Ground at rest stays, whatever the widths of its cells, down to the tolerance of a step.
TEST(GradedGround, AtRestStays) {
  verification::Run<2> run(scene_of(block(
      "density = 2000\n[gravity]\nacceleration = [0.0, -9.81]\n"
      "[initial_stress]\nkind = \"geostatic\"\n"
      "[[support]]\nname = \"base\"\nside = \"bottom\"\ndirections = [\"x\", \"y\"]\n"
      "method = \"ghosts\"\n"
      "[[support]]\nname = \"l\"\nside = \"left\"\ndirections = [\"x\"]\nmethod = \"ghosts\"\n"
      "[[support]]\nname = \"r\"\nside = \"right\"\ndirections = [\"x\"]\nmethod = "
      "\"ghosts\"\n")));
  run.complete();
  const double settlement = 2000 * 9.81 * 1.0 / (2.0 * 1.2e6);  // of weight put on afterwards
  EXPECT_LT(run.state.displacement.cwiseAbs().maxCoeff(), 1e-9 * settlement);
}

// A field that is linear is seen as such by every particle: stretched tenfold and turned, a body is
// under the stress that one particle alone would be.
TEST(GradedBody, StretchedTenfoldAndTurnedIsHomogeneous) {
  const TestScene scene = scene_of(block(
      "[hourglass]\ncontrol = \"stiffness\"\n[[support]]\nname = \"base\"\nside = \"bottom\"\n"
      "directions = [\"x\", \"y\"]\nmethod = \"penalty\"\n"));
  const auto model = model::build_model<2>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<2> equilibrium(model, state);
  constexpr int steps = 100;
  const double turn = 0.5 * M_PI / steps, stretch = std::pow(10.0, 1.0 / steps);
  fpm::Tensor<2> step, axes = fpm::Tensor<2>::Identity();
  const fpm::Tensor<2> rotation = Eigen::Rotation2Dd(turn).toRotationMatrix();
  for (int k = 0; k < steps; ++k) {
    fpm::Tensor<2> length = fpm::Tensor<2>::Identity();
    length(0, 0) = stretch;
    step = rotation * axes * length * axes.transpose();
    axes = rotation * axes;
    const fpm::Tensor<2> change = step - fpm::Tensor<2>::Identity();
    move(equilibrium, increment_field(model, state, [&](const fpm::Vector<2>& x) {
           return fpm::Vector<2>(change * x);
         }));
  }
  const Eigen::VectorXd first = state.stress.col(0);
  EXPECT_GT(first.norm(), 1e6);
  // Round-off of gradients (condition numbers below 1e3) summed over the steps.
  EXPECT_LT((state.stress.colwise() - first).cwiseAbs().maxCoeff(), 1e-10 * first.norm());
}

}  // namespace
}  // namespace verification
