// The beam at 80 particles over the depth.

#include "measure.hpp"

namespace verification {
namespace {

TEST(BeamConvergence, GoesOnTo80Particles) {
  const double exact = reference_values("beam_exact.csv").at("v_bottom_m");
  std::vector<double> errors;
  for (const int particles : {40, 80}) {
    std::ostringstream spacing;
    spacing.precision(17);
    spacing << "geometry.spacing=" << 1.0 / (particles - 1);
    verification::Run<2> run(shipped_scene(
        "beam.toml", {spacing.str(), "approximation.support_over_spacing=2.4",
                      "solver.tolerance=1e-6", "solver.max_evaluations_per_step=20000"}));
    run.complete();
    const Eigen::Index bottom = run.nearest(fpm::Vector<2>(5.0, 0.0));
    errors.push_back(run.state.displacement(bottom, 1) / exact - 1.0);
    report("error_at_" + std::to_string(particles), errors.back());
  }
  constexpr double order_tolerance = 0.25;  // as at coarser spacings, where it is wide
  EXPECT_NEAR(convergence_order(errors[0], errors[1], 79.0 / 39.0), 2.0, order_tolerance);
}

}  // namespace
}  // namespace verification
