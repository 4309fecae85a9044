// Patch tests and conservation, on lattices and jittered sets, in 2D and 3D.

#include "bodies.hpp"
#include "run.hpp"

namespace verification {
namespace {

constexpr double round_off = 1e-11;  // some hundred operations of relative error 1e-16, and the
                                     // 1e-14 / 1e-3 of an increment of 1e-3 on coordinates of 1

// Residual of a linear displacement field, of the particles whose rows and neighbours see no
// boundary; relative to the force of the stress on one particle's face.
template <int Dim>
void expect_linear_field_is_exact(BodyOptions body) {
  const TestScene scene = scene_of(body_scene(body));
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  fpm::Tensor<Dim> gradient = fpm::Tensor<Dim>::Zero();
  gradient(0, 0) = 2e-3;
  gradient(0, 1) = 1e-3;
  gradient(1, 1) = -1e-3;
  move(equilibrium, increment_field(model, state, [&](const fpm::Vector<Dim>& x) {
         return fpm::Vector<Dim>(gradient * x);
       }));
  for (Eigen::Index a = 1; a < model.size(); ++a) {
    EXPECT_LT((state.stress.col(a) - state.stress.col(0)).norm(),
              round_off * state.stress.col(0).norm() / 1e-3);
  }
}

TEST(LinearField, HasUniformStressOnLattice) {
  expect_linear_field_is_exact<2>({});
}
TEST(LinearField, HasUniformStressOnJitteredSet) {
  BodyOptions body;
  body.jitter = 0.2;
  expect_linear_field_is_exact<2>(body);
}
TEST(LinearField, HasUniformStressInThreeDimensions) {
  BodyOptions body;
  body.dimension = 3;
  body.control = "incremental";
  body.jitter = 0.2;
  expect_linear_field_is_exact<3>(body);
}

// Force patch test: a uniform traction on the top of a body on rollers. The exact answer is a
// homogeneous stress and a linear field, which the consistency correction makes the scheme's too.
constexpr double solver_tolerance = 1e-10;
// Displacement error over residual error: the condition number of the tiny body, below 1e3.
constexpr double patch_tolerance = 1e3 * solver_tolerance;

std::string traction_scene(int dimension, const std::string& layout, double jitter) {
  BodyOptions body;
  body.dimension = dimension;
  body.layout = layout;
  body.jitter = jitter;
  body.kinematics = "small_strain";
  body.control = "stiffness";
  body.model = "elastic";
  body.consistency = "on";
  const std::string third = dimension == 3 ? ", 0.0" : "";
  body.extra =
      "[[support]]\nname=\"base\"\nside=\"bottom\"\ndirections=[\"y\"]\n"
      "[[support]]\nname=\"left\"\nside=\"left\"\ndirections=[\"x\"]\n";
  if (dimension == 3) {
    body.extra += "[[support]]\nname=\"front\"\nside=\"front\"\ndirections=[\"z\"]\n";
  }
  body.extra += "[[traction]]\nname=\"load\"\nside=\"top\"\nvalue=[0.0, -1e3" + third +
                "]\n[drive]\nkind=\"load\"\nscales=[\"traction\"]\n[programme]\nsteps=1\n"
                "[solver]\ntolerance=1e-10\nmethod=\"newton_krylov\"\n"
                "max_evaluations_per_step=20000\n";
  return body_scene(body);
}

template <int Dim>
double traction_patch_error(const std::string& layout, double jitter) {
  Run<Dim> run(scene_of(traction_scene(Dim, layout, jitter)));
  run.complete();
  double worst = 0.0;
  for (Eigen::Index a = 0; a < run.model.size(); ++a) {
    worst = std::max(worst, std::abs(run.state.stress(1, a) + 1e3) / 1e3);
    worst = std::max(worst, std::abs(run.state.stress(0, a)) / 1e3);
  }
  return worst;
}

TEST(TractionPatch, IsExactOnVertexLattice) {
  EXPECT_LT(traction_patch_error<2>("vertex", 0.0), patch_tolerance);
}
TEST(TractionPatch, IsExactOnVertexLatticeInThreeDimensions) {
  EXPECT_LT(traction_patch_error<3>("vertex", 0.0), patch_tolerance);
}

// Momentum of the internal forces of a free, bent, yielded body: the sum of the forces vanishes to
// round-off whatever the control.
template <int Dim>
void expect_momentum(const BodyOptions& body, bool angular) {
  const TestScene scene = scene_of(body_scene(body));
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  Noise noise(3);
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXd u =
        increment_field(model, state,
                        [](const fpm::Vector<Dim>& x) { return bending<Dim>(x, 0.01); }) +
        noise.vector(model.unknowns(), 1e-3 * model.spacing);
    move(equilibrium, u);
    const Eigen::VectorXd& force = equilibrium.unmasked_residual();
    const Eigen::Index n = model.size();
    const double size = force.cwiseAbs().sum();
    for (int i = 0; i < Dim; ++i) {
      EXPECT_LT(std::abs(force.segment(i * n, n).sum()), round_off * size);
    }
    if (!angular) continue;
    const fpm::Field<Dim> x = model.particles.position + state.displacement;
    const double moment =
        (x.col(0).array() * force.segment(n, n).array() - x.col(1).array() * force.head(n).array())
            .sum();
    EXPECT_LT(std::abs(moment), round_off * size);
  }
}

TEST(Momentum, IsConservedByEveryControl) {
  for (const std::string control : {"none", "viscosity", "incremental", "mixed"}) {
    SCOPED_TRACE(control);
    BodyOptions body;
    body.control = control;
    body.jitter = 0.2;
    expect_momentum<2>(body, false);
  }
  BodyOptions solid;
  solid.dimension = 3;
  solid.control = "incremental";
  expect_momentum<3>(solid, false);
}

// Moments vanish exactly for stresses, sub-points included, and for the total stiffness.
TEST(AngularMomentum, IsConservedByStressesAndTotalStiffness) {
  BodyOptions body;
  body.jitter = 0.2;
  body.control = "none";
  expect_momentum<2>(body, true);
  body.control = "mixed";
  body.hourglass = "stiffness_ratio = 0.0\n";  // the sub-points alone
  expect_momentum<2>(body, true);
  body.hourglass.clear();
  body.control = "stiffness";
  body.model = "elastic";
  expect_momentum<2>(body, true);
}

}  // namespace
}  // namespace verification
