// Prisms: polygons that are bodies of depth in space.

#include <fmt/format.h>

#include "measure.hpp"
#include "model/measures.hpp"
#include "run.hpp"

namespace verification {
namespace {

const std::string two =
    "[[material]]\nname = \"soft\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
    "poissons_ratio = 0.3\n[[material]]\nname = \"stiff\"\nmodel = \"elastic\"\n"
    "youngs_modulus = 1e6\npoissons_ratio = 0.3\n";

std::string region(const std::string& material, const std::string& outline) {
  return fmt::format("[[region]]\nmaterial = \"{}\"\noutline = {}\n", material, outline);
}

std::string side(const std::string& name, const std::string& kind, const std::string& along) {
  return fmt::format("[[side]]\nname = \"{}\"\nkind = {}\nalong = {}\n", name, kind, along);
}

// Its ends held across: in plane strain.
const std::string ends =
    "[[support]]\nname = \"front\"\nside = \"front\"\ndirections = [\"z\"]\n"
    "[[support]]\nname = \"back\"\nside = \"back\"\ndirections = [\"z\"]\n";
const std::string pressed = "\"loaded\"\nlive_pressure = 1e3";
const std::string tightly =
    "[approximation]\nkinematics = \"small_strain\"\n[drive]\nkind = \"load\"\n"
    "scales = [\"traction\"]\n[programme]\nsteps = 1\n[solver]\ntolerance = 1e-11\n"
    "method = \"newton_krylov\"\nmax_evaluations_per_step = 20000\n";

// Pressed all around its mantle a prism of any section has that pressure in the plane and twice
// Poisson's ratio of it along z, whatever regions it is of.
TEST(Prism, UnderPressureHasNoOtherStress) {
  const std::string section =
      region("soft", "[[0, 0], [1.03, 0], [0.9, 0.6], [0, 0.37]]") +
      region("stiff", "[[0, 0.37], [0.9, 0.6], [0.7, 1.0], [0, 1.11]]") +
      side("left", "\"symmetry\"", "[[0, 0], [0, 1.11]]") +
      side("bottom", "\"roller\"", "[[0, 0], [1.03, 0]]") +
      side("rest", pressed, "[[1.03, 0], [0.9, 0.6], [0.7, 1.0], [0, 1.11]]");
  const std::string through =
      "[[interface]]\nbetween = [\"soft\", \"stiff\"]\nkind = \"through\"\n";
  verification::Run<3> run(
      scene_of("[geometry]\ndimension = 3\ndepth = [0.2, 0.8]\nspacing = 0.1\n" + section + two +
               through + ends + tightly));
  run.complete();
  const Eigen::Array<double, 6, 1> exact(-1e3, -1e3, -600.0, 0.0, 0.0, 0.0);
  double most = 0.0;
  for (Eigen::Index i = 0; i < 6; ++i) {
    most = std::max(most, (run.state.stress.row(i).array() - exact[i]).abs().maxCoeff());
  }
  EXPECT_LT(most / 1e3, 1e-9);
  EXPECT_NEAR(run.model.particles.volume.sum(),
              0.6 * (0.5 * (0.37 * 0.9 + 0.6 * 1.03) + 0.5 * (0.9 * (1.0 - 0.37) + 0.7 * 0.51)),
              1e-12);
}

// Nothing changes along it, but for what rows in space are to rows in the plane: its displacements
// tend to those of the section as both tend to the exact ones, at first order at least beside the
// singular toe.
TEST(Prism, UnderItsWeightMovesAsItsSection) {
  const std::string slope = region("soft", "[[0, 0], [2, 0], [1.4, 1], [0, 1]]") +
                            side("left", "\"roller\"", "[[0, 0], [0, 1]]") +
                            side("bottom", "\"fixed\"", "[[0, 0], [2, 0]]") +
                            side("rest", "\"free\"", "[[2, 0], [1.4, 1], [0, 1]]") +
                            "[[material]]\nname = \"soft\"\nmodel = \"elastic\"\n"
                            "youngs_modulus = 1e6\npoissons_ratio = 0.3\nunit_weight = 18e3\n"
                            "[approximation]\nkinematics = \"small_strain\"\n[drive]\n"
                            "kind = \"load\"\nscales = [\"gravity\"]\n[programme]\nsteps = 1\n"
                            "[solver]\ntolerance = 1e-6\n"
                            "[[measure]]\nname = \"crest\"\nkind = \"displacement\"\n";
  std::vector<double> apart;
  for (const double spacing : {0.1, 0.05}) {
    const std::string geometry = fmt::format("[geometry]\nspacing = {}\n", spacing);
    verification::Run<3> prism(scene_of(geometry + "dimension = 3\ndepth = [0.0, 0.4]\n" + slope +
                                        "at = [1.4, 1.0, 0.2]\n" + ends));
    verification::Run<2> section(scene_of(geometry + slope + "at = [1.4, 1.0]\n"));
    prism.complete();
    section.complete();
    const auto in_space = model::Measures<3>(prism.scene, prism.model).of(prism.state);
    const auto in_plane = model::Measures<2>(section.scene, section.model).of(section.state);
    apart.push_back(std::hypot(in_space[0] - in_plane[0], in_space[1] - in_plane[1]) /
                    std::hypot(in_plane[0], in_plane[1]));
    report(fmt::format("apart_at_{}", spacing), apart.back());
    EXPECT_LT(std::abs(in_space[2]), 1e-5 * std::abs(in_space[1]));
  }
  EXPECT_LT(apart[0], 0.02);
  EXPECT_LT(apart[1], 0.5 * apart[0]);
}

}  // namespace
}  // namespace verification
