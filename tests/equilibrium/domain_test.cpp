// Increments that cannot be evaluated, and whom the failure names.
#include <gtest/gtest.h>

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "scene/reader.hpp"

namespace {

constexpr const char* pressed_square = R"([geometry]
dimension = 2
min = [0.0, 0.0]
max = [1.0, 1.0]
spacing = 0.1
[[material]]
name = "a"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
[[traction]]
name = "p"
side = "right"
range_min = 0.4
range_max = 0.5
value = [-1e3, 0.0]
follower = true
)";

// x - a x^2 folds at the right face first, as a grows: where a load's points are, ahead of the
// particles, which lie half a spacing within it.
TEST(Domain, EndsWhereALoadsFaceIsTurnedInsideOutAndNamesTheParticleNextToIt) {
  const auto scene = scene::parse_scene(pressed_square, "square").scene;
  const auto model = model::build_model<2>(*scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<2> equilibrium(model, state);
  equilibrium.begin_step(1.0);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(model.unknowns());
  Eigen::VectorXd residual(u.size());
  const auto x = model.particles.position.col(0).array();
  jfnk::Evaluation evaluation = jfnk::Evaluation::ok;
  for (double a = 0.4; a < 1.0 && evaluation == jfnk::Evaluation::ok; a += 1e-3) {
    u.head(model.size()) = -a * x.square();
    evaluation = equilibrium(u, residual);
  }
  ASSERT_EQ(evaluation, jfnk::Evaluation::out_of_domain);
  const auto worst = equilibrium.failure().particle;
  EXPECT_NEAR(model.particles.position(worst, 0), 0.95, 1e-12);
  EXPECT_NEAR(model.particles.position(worst, 1), 0.45, 1e-12);
}

}  // namespace
