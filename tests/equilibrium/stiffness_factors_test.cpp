// The factors of the stiffness against the Jacobian of the residual: next to nothing is left.
#include "equilibrium/stiffness_factors.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "equilibrium/equilibrium.hpp"
#include "model/build.hpp"
#include "scene/reader.hpp"
#include "verification/bodies.hpp"

namespace {

// A block of two materials, jittered, held below.
std::string block(int dimension, const std::string& more) {
  const bool plane = dimension == 2;
  return fmt::format(
             "[geometry]\ndimension = {}\n{}\nspacing = 0.2\njitter = 0.2\n"
             "[approximation]\nkinematics = \"small_strain\"\n"
             "[[material]]\nname = \"soft\"\nmodel = \"elastic\"\nyoungs_modulus = 1e6\n"
             "poissons_ratio = 0.4999\n"
             "[[material]]\nname = \"stiff\"\nmodel = \"elastic\"\nyoungs_modulus = 1e7\n"
             "poissons_ratio = 0.2\n{}\n",
             dimension,
             plane ? "min = [0.0, 0.0]\nmax = [1.0, 0.8]"
                   : "min = [0.0, 0.0, 0.0]\nmax = [1.0, 0.8, 0.6]",
             plane ? "region_min = [0.0, 0.4]\nregion_max = [1.0, 0.8]"
                   : "region_min = [0.0, 0.4, 0.0]\nregion_max = [1.0, 0.8, 0.6]") +
         more;
}

std::string held(int dimension, const std::string& side, const std::string& method) {
  const std::string support =
      fmt::format("[[support]]\nname = \"{0}\"\nside = \"{0}\"\nmethod = \"{1}\"\n", side, method);
  if (method == "contact") return support + "directions = [\"y\"]\nadhesion = 1e9\n";
  return support + (dimension == 2 ? "directions = [\"x\", \"y\"]\n"
                                   : "directions = [\"x\", \"y\", \"z\"]\n");
}

// The same of clay that does not yield yet.
std::string with_subpoints(std::string text) {
  for (auto at = text.find("\"elastic\""); at != text.npos; at = text.find("\"elastic\"")) {
    text.replace(at, 9, "\"von_mises\"\ncohesion = 1e3");
  }
  return text + "[hourglass]\ncontrol = \"mixed\"\n";
}

// What K z - r leaves of any r over the free unknowns.
template <int Dim>
double left_over(const std::string& text) {
  const auto reading = scene::parse_scene(text, "block", {});
  EXPECT_TRUE(reading.scene);
  const auto model = model::build_model<Dim>(*reading.scene);
  auto state = model::initial_state(model);
  equilibrium::Equilibrium<Dim> equilibrium(model, state);
  equilibrium.begin_step(0.0);
  EXPECT_TRUE(equilibrium.linearise(Eigen::VectorXd::Zero(model.unknowns())));
  equilibrium::StiffnessFactors<Dim> factors(model, equilibrium.initial_operator());
  Eigen::VectorXd r = verification::Noise(3).vector(model.unknowns(), 1.0);
  for (Eigen::Index k = 0; k < r.size(); ++k) {
    if (model.prescribed[static_cast<std::size_t>(k)] != 0) r[k] = 0.0;
  }
  Eigen::VectorXd z(r.size()), kz(r.size());
  factors.apply(r, z);
  equilibrium.apply_jacobian(z, kz);
  return (kz - r).norm() / r.norm();
}

// The Jacobian action has its tangents in single precision, of which the softer material's shape
// sees lambda / mu times as much as its volume.
constexpr double round_off = 0.5 * std::numeric_limits<float>::epsilon() * 5e3;

TEST(StiffnessFactors, AreOfTheJacobianWhateverTheControl) {
  for (const char* control : {"stiffness", "incremental"}) {
    SCOPED_TRACE(control);
    const std::string by = fmt::format("[hourglass]\ncontrol = \"{}\"\n", control);
    EXPECT_LT(left_over<2>(block(2, held(2, "bottom", "direct") + by)), round_off);
    EXPECT_LT(left_over<3>(block(3, held(3, "bottom", "direct") + by)), round_off);
  }
  EXPECT_LT(left_over<2>(with_subpoints(block(2, held(2, "bottom", "direct")))), round_off);
  EXPECT_LT(left_over<3>(with_subpoints(block(3, held(3, "bottom", "direct")))), round_off);
}

TEST(StiffnessFactors, AreOfTheJacobianWhateverHoldsTheBody) {
  const std::string mirror = "[[symmetry]]\naxis = \"x\"\nposition = 0.0\n";
  for (const char* method : {"ghosts", "penalty", "contact"}) {
    SCOPED_TRACE(method);
    EXPECT_LT(left_over<2>(block(2, held(2, "bottom", method))), round_off);
    EXPECT_LT(left_over<2>(block(2, mirror + held(2, "bottom", method))), round_off);
    EXPECT_LT(left_over<3>(block(3, mirror + held(3, "bottom", method))), round_off);
  }
}

TEST(StiffnessFactors, LeavePrescribedUnknownsAlone) {
  const auto reading = scene::parse_scene(block(2, held(2, "bottom", "direct")), "block", {});
  const auto model = model::build_model<2>(*reading.scene);
  auto state = model::initial_state(model);
  const equilibrium::Equilibrium<2> equilibrium(model, state);
  equilibrium::StiffnessFactors<2> factors(model, equilibrium.initial_operator());
  Eigen::VectorXd z(model.unknowns());
  factors.apply(Eigen::VectorXd::Ones(model.unknowns()), z);
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    EXPECT_EQ(z[k] == 0.0, model.prescribed[static_cast<std::size_t>(k)] != 0);
  }
}

// As one may be that no load moves: whether its last pivots are positive is not left to round-off.
TEST(StiffnessFactors, TakeABodyThatNothingHolds) {
  for (const double spacing : {0.2, 0.1, 0.05}) {
    const auto reading = scene::parse_scene(
        block(2, ""), "block", std::vector{fmt::format("geometry.spacing={}", spacing)});
    ASSERT_TRUE(reading.scene);
    const auto model = model::build_model<2>(*reading.scene);
    auto state = model::initial_state(model);
    equilibrium::Equilibrium<2> equilibrium(model, state);
    equilibrium.begin_step(0.0);
    ASSERT_TRUE(equilibrium.linearise(Eigen::VectorXd::Zero(model.unknowns())));
    equilibrium::StiffnessFactors<2> factors(model, equilibrium.initial_operator());
    // Forces in equilibrium with each other.
    Eigen::VectorXd some = verification::Noise(3).vector(model.unknowns(), 1.0);
    Eigen::VectorXd r(some.size()), z(some.size()), kz(some.size());
    equilibrium.apply_jacobian(some, r);
    factors.apply(r, z);
    equilibrium.apply_jacobian(z, kz);
    EXPECT_LT((kz - r).norm(), 0.1 * r.norm());
  }
}

}  // namespace
