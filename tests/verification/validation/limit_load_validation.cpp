// Collapse loads at B/dx = 8, 16 and 32, for every control in one table.

#include "limit_load.hpp"

namespace verification {
namespace {

void expect_convergence(const std::string& scene, double exact) {
  std::vector<LimitLoad> loads;
  for (const int particles : {8, 16, 32}) loads.push_back(limit_load(scene, exact, particles));
  for (std::size_t k = 1; k < loads.size(); ++k) {
    EXPECT_LT(std::abs(loads[k].raw), std::abs(loads[k - 1].raw));
    EXPECT_LT(std::abs(loads[k].corrected), std::abs(loads[k - 1].corrected));
  }
  EXPECT_LT(std::abs(loads[1].raw), target_at_16);
  EXPECT_LT(std::abs(loads[2].raw), target_at_32);
}

TEST(LimitLoadConvergence, OfClayTo32ParticlesOverB) {
  expect_convergence("prandtl_phi0.toml", exact_pressure_phi0);
}
TEST(LimitLoadConvergence, OfFrictionalSoilTo32ParticlesOverB) {
  expect_convergence("prandtl_phi20.toml", exact_pressure_phi20);
}

// The table of controls in the documents; what is asserted is what distinguishes them: without
// control and with the incremental one the error falls at first order or nearly.
TEST(LimitLoadConvergence, OfTheOtherControls) {
  constexpr double fallen = 0.75;  // from 8 to 16 particles; 0.5 is first order
  for (const std::string scene : {"prandtl_phi0.toml", "prandtl_phi20.toml"}) {
    const double exact = scene == "prandtl_phi0.toml" ? exact_pressure_phi0 : exact_pressure_phi20;
    for (const std::string control : {"none", "viscosity", "incremental"}) {
      std::vector<double> errors;
      for (const int particles : {8, 16}) {
        errors.push_back(limit_load(scene, exact, particles, {"hourglass.control=" + control}).raw);
        report(
            scene.substr(0, scene.find('.')) + "_" + control + "_at_" + std::to_string(particles),
            errors.back());
      }
      if (control != "viscosity") {
        EXPECT_LT(std::abs(errors[1]), fallen * std::abs(errors[0]));
      }
    }
  }
}

}  // namespace
}  // namespace verification
