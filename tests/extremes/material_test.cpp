// Materials at the edges of their parameters.

#include <limits>

#include "small_footing.hpp"

namespace extremes {
namespace {

double clay_load(const std::string& poissons_ratio) {
  PlaneRun run(verification::shipped_scene(
      "prandtl_phi0.toml",
      {"geometry.spacing=0.125", "material.0.poissons_ratio=" + poissons_ratio}));
  const Steps steps = run.complete();
  expect_finite(run);
  const double load = steps.empty() ? 0.0 : steps.back().mean_pressure;
  report("load_nu_" + poissons_ratio, load);
  return load;
}

// The collapse load does not depend on the elastic moduli; what the control takes does, within what
// it takes in all, 1 % at this resolution (the raw less the corrected load, 0.6 %).
TEST(PoissonsRatio, DoesNotChangeTheCollapseLoad) {
  constexpr double hourglass = 0.01;
  const double usual = clay_load("0.4");
  for (const std::string ratio : {"-0.9", "0.0", "0.49", "0.4999", "0.499999"}) {
    EXPECT_NEAR(clay_load(ratio) / usual, 1.0, hourglass);
  }
}

// A confined column under its weight settles 1667 times less than with nu = 0. The error of the
// integration at the faces, of second order with the consistency correction, works against the
// shear stiffness: it is a share (dx / H)^2 of the settlement rho g H^2 / (2 E) of each face.
double confined_error(double spacing) {
  constexpr double nu = 0.4999, modulus = 10e6 * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu));
  SpaceRun run(verification::shipped_scene(
      "block3d.toml",
      {setting("geometry.spacing", {spacing}), "approximation.consistency=on",
       "solver.max_evaluations_per_step=4000", "material.0.poissons_ratio=0.4999"}));
  const Steps steps = run.complete();
  expect_finite(run);
  if (steps.empty()) return std::numeric_limits<double>::infinity();
  const double weight = 2500.0 * 9.81 * 4.0 / 2.0;
  const double error = std::abs(steps.back().max_displacement - weight / modulus);
  report("error_over_unconfined_settlement", error / (weight / 10e6));
  return error / (weight / 10e6);
}

TEST(PoissonsRatio, NearOneHalfSolvesTheConfinedColumn) {
  constexpr double height = 2.0, faces = 2.0;
  for (const double spacing : {0.25, 0.125}) {
    EXPECT_LT(confined_error(spacing), faces * std::pow(spacing / height, 2));
  }
}

// Rock on peat and peat on rock, a million times stiffer: the peat alone is squeezed.
std::string layers(double lower, double upper) {
  std::ostringstream text;
  text << "[geometry]\ndimension=2\nmin=[0.0,0.0]\nmax=[1.0,2.0]\nspacing=0.125\n"
          "layout=\"vertex\"\n[approximation]\nkinematics=\"small_strain\"\nconsistency=\"on\"\n"
          "[[material]]\nname=\"upper\"\nmodel=\"elastic\"\npoissons_ratio=0.3\nyoungs_modulus="
       << upper
       << "\n[[material]]\nname=\"lower\"\nmodel=\"elastic\"\npoissons_ratio=0.3\n"
          "region_min=[-1.0,-1.0]\nregion_max=[2.0,1.06]\nyoungs_modulus="
       << lower
       << "\n[[support]]\nname=\"base\"\nside=\"bottom\"\ndirections=[\"y\"]\n"
          "[[support]]\nname=\"left\"\nside=\"left\"\ndirections=[\"x\"]\n"
          "[[support]]\nname=\"right\"\nside=\"right\"\ndirections=[\"x\"]\n"
          "[[traction]]\nname=\"load\"\nside=\"top\"\nvalue=[0.0,-1e3]\n"
          "[drive]\nkind=\"load\"\nscales=[\"traction\"]\n[programme]\nsteps=1\n";
  return text.str();
}

TEST(Contrast, OfAMillionSqueezesTheSoftLayerAlone) {
  constexpr double soft = 1e6, hard = 1e12, confined = soft * 0.7 / (1.3 * 0.4);
  constexpr double spacing = 0.125;
  const double cases[][3] = {{soft, hard, 1.0 + 0.5 * spacing}, {hard, soft, 1.0 - 0.5 * spacing}};
  for (const auto& [lower, upper, thickness] : cases) {
    PlaneRun run(verification::scene_of(layers(lower, upper)));
    const Steps steps = run.complete();
    ASSERT_FALSE(steps.empty());
    const double top = steps.back().max_displacement;
    const double exact = 1e3 * thickness / confined;
    report("settlement_error", top / exact - 1.0);
    // Gradients reach 2.4 spacings across the interface: its place is uncertain by one or two.
    EXPECT_NEAR(top / exact, 1.0, 2.0 * spacing / thickness);
    expect_finite(run);
  }
}

// Sand: the stress-free surface is at the cone's apex, and K0 = 0.67 is inside the cone.
TEST(Cohesion, OfNothingOrNearlyNothingStandsUnderFooting) {
  for (const std::string cohesion : {"1.0", "0.0"}) {
    Settings settings = small_footing();
    settings.push_back("material.0.cohesion=" + cohesion);
    PlaneRun run(verification::shipped_scene("footing.toml", settings));
    const Steps steps = run.complete();
    ASSERT_FALSE(steps.empty());
    report("pressure_c_" + cohesion, steps.back().mean_pressure);
    // c N_c vanishes; what is left is below the pressure with a cohesion of 2.5 kPa by that much.
    EXPECT_GT(steps.back().mean_pressure, 0.0);
    EXPECT_LT(steps.back().mean_pressure, 58.437e3 - 0.9 * 37.087e3);
    expect_finite(run);
  }
}

}  // namespace
}  // namespace extremes
