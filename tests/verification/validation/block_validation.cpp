// The confined block in 3D at a sixteenth of its width.

#include "measure.hpp"

namespace verification {
namespace {

TEST(BlockConvergence, IsOfSecondOrderWithConsistency) {
  constexpr double weight = 2500.0 * 9.81, modulus = 10e6 * 0.7 / (1.3 * 0.4), height = 2.0;
  constexpr double settlement = weight * height * height / (2.0 * modulus);
  std::vector<double> errors;
  for (const double spacing : {0.125, 0.0625}) {
    verification::Run<3> run(
        shipped_scene("block3d.toml", {"geometry.spacing=" + std::to_string(spacing),
                                       "approximation.consistency=on", "solver.tolerance=1e-6"}));
    run.complete();
    double worst = 0.0;
    for (Eigen::Index a = 0; a < run.model.size(); ++a) {
      const double y = run.model.particles.position(a, 1);
      Eigen::RowVector3d u = run.state.displacement.row(a);
      u[1] += weight * (height * y - 0.5 * y * y) / modulus;
      worst = std::max(worst, u.cwiseAbs().maxCoeff() / settlement);
    }
    report("displacement_error_at_" + std::to_string(spacing), worst);
    errors.push_back(worst);
  }
  constexpr double order_tolerance = 0.2;
  EXPECT_NEAR(convergence_order(errors[0], errors[1], 2.0), 2.0, order_tolerance);
}

}  // namespace
}  // namespace verification
