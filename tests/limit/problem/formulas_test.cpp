#include <gmock/gmock.h>

#include <numbers>

#include "limit/problem/case.hpp"
#include "limit/problem/hand_formulas.hpp"

namespace {

using namespace limit;

constexpr double degree = std::numbers::pi / 180.0;

double of(const std::vector<problem::HandFormula>& formulas, const std::string& name) {
  for (const problem::HandFormula& formula : formulas) {
    if (formula.name.starts_with(name)) return formula.pressure;
  }
  throw std::out_of_range(name);
}

TEST(HandFormulas, GivePrandtlsFactorExactly) {
  // Prandtl's N_c, closed form, to the digits of the published tables.
  for (const auto& [phi, nc] : {std::pair{0.0, 5.141593},
                                {10.0, 8.344926},
                                {20.0, 14.834712},
                                {30.0, 30.139628},
                                {40.0, 75.313114}}) {
    EXPECT_NEAR(of(problem::hand_formulas(1.0, phi * degree, 0.0, 0.0, 1.0), "Prandtl"), nc, 1e-6);
  }
}

TEST(HandFormulas, GiveThePapersFootingAsOthersComputeIt) {
  // kPa, as published tables of the factors give them for c = 2.5, phi = 20, gamma b = 3.9927.
  const auto formulas = problem::hand_formulas(2.5, 20 * degree, 1.85 * 9.81, 0.0, 0.22);
  const double digits = 0.05;
  EXPECT_NEAR(of(formulas, "Hansen"), 48.9, digits);
  EXPECT_NEAR(of(formulas, "Meyerhof"), 48.5, digits);
  EXPECT_NEAR(of(formulas, "Vesic"), 58.6, digits);
  EXPECT_NEAR(of(formulas, "Terzaghi"), 64.2, digits);
}

TEST(Davis, ReducesNothingForAssociatedFlowAndTheCosineForNone) {
  const problem::Soil soil{2.5e3, 20 * degree, 1.8e4};
  const problem::Soil same = problem::davis_reduced(soil, 20 * degree);
  // Exact in real numbers; a few roundings.
  EXPECT_NEAR(same.cohesion, soil.cohesion, 1e-11 * soil.cohesion);
  EXPECT_NEAR(same.friction_angle, soil.friction_angle, 1e-14);
  const problem::Soil none = problem::davis_reduced(soil, 0.0);
  EXPECT_NEAR(none.cohesion, soil.cohesion * std::cos(20 * degree), 1e-11 * soil.cohesion);
  EXPECT_NEAR(std::tan(none.friction_angle), std::sin(20 * degree), 1e-14);
}

}  // namespace
