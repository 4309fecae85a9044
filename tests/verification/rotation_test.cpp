// Objectivity: rigid rotations of stressed, bent and yielded bodies.

#include "bodies.hpp"
#include "constitutive/objective.hpp"
#include "run.hpp"

namespace verification {
namespace {

constexpr int steps = 72;  // of 5 degrees
// Each step rotates the stress with a relative error of some 10 roundings, and the relative motion
// of neighbours carries the round-off of coordinates of order 1 over dx = 0.1, times E over the
// stress (1e6 / 5e3): 72 * (1e-15 + 1e-15 * 200) with a factor of ten for the sums.
constexpr double drift_tolerance = 2e-10;

// Hughes-Winget takes the chord of a rotation: its Cayley angle is 2 tan(angle / 2), and the
// midpoint rule of the gradient makes the rotation exact.
template <int Dim>
void rotate_once(const model::Model<Dim>& model, model::State<Dim>& state,
                 equilibrium::Equilibrium<Dim>& equilibrium, double angle) {
  fpm::Tensor<Dim> turn = fpm::Tensor<Dim>::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(angle);
  turn(0, 1) = -std::sin(angle);
  turn(1, 0) = std::sin(angle);
  const fpm::Tensor<Dim> change = turn - fpm::Tensor<Dim>::Identity();
  move(equilibrium, increment_field(model, state, [&](const fpm::Vector<Dim>& x) {
         return fpm::Vector<Dim>(change * x);
       }));
}

template <int Dim>
void expect_full_turn_changes_nothing(const BodyOptions& body) {
  const TestScene scene = scene_of(body_scene(body));
  const auto model = model::build_model<Dim>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  move(equilibrium, increment_field(model, state, [](const fpm::Vector<Dim>& x) {
         return bending<Dim>(x, 0.02);
       }));
  const Eigen::MatrixXd stress = state.stress;
  const Eigen::MatrixXd deviator = state.subpoint_deviator;
  const Eigen::MatrixXd position = model.particles.position + state.displacement;
  const double size = stress.cwiseAbs().maxCoeff();
  for (int k = 0; k < steps; ++k) rotate_once(model, state, equilibrium, 2.0 * M_PI / steps);
  EXPECT_LT((state.stress - stress).cwiseAbs().maxCoeff(), drift_tolerance * size);
  if (deviator.size() > 0) {
    EXPECT_LT((state.subpoint_deviator - deviator).cwiseAbs().maxCoeff(), drift_tolerance * size);
  }
  EXPECT_LT((model.particles.position + state.displacement - position).cwiseAbs().maxCoeff(),
            drift_tolerance);
}

TEST(RigidRotation, FullTurnOfBentYieldedBodyDriftsByRoundOffWithSubPoints) {
  expect_full_turn_changes_nothing<2>({});
}
TEST(RigidRotation, FullTurnOfBentYieldedBodyDriftsByRoundOff) {
  BodyOptions body;
  body.control = "incremental";
  expect_full_turn_changes_nothing<2>(body);
}
TEST(RigidRotation, FullTurnOfBentElasticBodyDriftsByRoundOff) {
  BodyOptions body;
  body.control = "stiffness";
  body.model = "elastic";
  body.jitter = 0.2;
  expect_full_turn_changes_nothing<2>(body);
}
TEST(RigidRotation, FullTurnInThreeDimensionsDriftsByRoundOff) {
  BodyOptions body;
  body.dimension = 3;
  body.control = "incremental";
  expect_full_turn_changes_nothing<3>(body);
}
TEST(RigidRotation, FullTurnInThreeDimensionsDriftsByRoundOffWithSubPoints) {
  BodyOptions body;
  body.dimension = 3;
  expect_full_turn_changes_nothing<3>(body);
  body.model = "mohr_coulomb";
  expect_full_turn_changes_nothing<3>(body);
}

TEST(RigidRotation, FullTurnOfElementsOfAMeshDriftsByRoundOff) {
  BodyOptions body;
  body.elements = true;
  body.jitter = 0.2;
  expect_full_turn_changes_nothing<2>(body);
  body.dimension = 3;
  body.control = "incremental";
  expect_full_turn_changes_nothing<3>(body);
}

// The internal forces of a body that was bent and yielded turn with it.
TEST(RigidRotation, TurnsTheForcesOfBentYieldedBody) {
  const TestScene scene = scene_of(body_scene({}));
  const auto model = model::build_model<2>(scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<2> equilibrium(model, state);
  move(equilibrium,
       increment_field(model, state, [](const fpm::Vector<2>& x) { return bending<2>(x, 0.02); }));
  move(equilibrium, Eigen::VectorXd::Zero(model.unknowns()));
  const Eigen::VectorXd before = equilibrium.unmasked_residual();
  constexpr double angle = 0.5;
  rotate_once(model, state, equilibrium, angle);
  const Eigen::VectorXd after = equilibrium.unmasked_residual();
  const Eigen::Index n = model.size();
  const double c = std::cos(angle), s = std::sin(angle);
  const double size = before.cwiseAbs().maxCoeff();
  for (Eigen::Index a = 0; a < n; ++a) {
    EXPECT_NEAR(after[a], c * before[a] - s * before[n + a], drift_tolerance * size);
    EXPECT_NEAR(after[n + a], s * before[a] + c * before[n + a], drift_tolerance * size);
  }
}

}  // namespace
}  // namespace verification
