#include "limit/problem/hand_formulas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace limit::problem {

namespace {

constexpr double pi = std::numbers::pi;

// (Nq - 1) cot(phi), or its limit without friction.
double cohesion_factor(double surcharge_factor, double phi, double frictionless) {
  return phi > 0.0 ? (surcharge_factor - 1.0) / std::tan(phi) : frictionless;
}

// Terzaghi (1943): degrees and N_gamma; linear between them.
double terzaghi_weight_factor(double phi) {
  constexpr std::array<std::pair<double, double>, 13> table{{{0, 0},
                                                             {5, 0.5},
                                                             {10, 1.2},
                                                             {15, 2.5},
                                                             {20, 5.0},
                                                             {25, 9.7},
                                                             {30, 19.7},
                                                             {34, 36.0},
                                                             {35, 42.4},
                                                             {40, 100.4},
                                                             {45, 297.5},
                                                             {48, 780.1},
                                                             {50, 1153.2}}};
  const double degrees = phi * 180.0 / pi;
  const auto above = std::find_if(table.begin() + 1, table.end() - 1,
                                  [&](const auto& row) { return row.first >= degrees; });
  const auto& [lower, from] = *(above - 1);
  const auto& [upper, to] = *above;
  return from + (to - from) * (degrees - lower) / (upper - lower);
}

}  // namespace

std::vector<HandFormula> hand_formulas(double cohesion, double friction_angle, double unit_weight,
                                       double surcharge, double half_width) {
  const double phi = friction_angle, tangent = std::tan(phi);
  const double nq = std::exp(pi * tangent) * std::pow(std::tan(pi / 4 + phi / 2), 2);
  const double nc = cohesion_factor(nq, phi, 2.0 + pi);
  const double base = cohesion * nc + surcharge * nq;
  const double weight = unit_weight * half_width;
  const double terzaghi_nq =
      std::exp((1.5 * pi - phi) * tangent) / (2.0 * std::pow(std::cos(pi / 4 + phi / 2), 2));
  const double terzaghi_nc = cohesion_factor(terzaghi_nq, phi, 1.0 + 1.5 * pi);
  return {{"Prandtl-Reissner (no weight)", base},
          {"Meyerhof", base + weight * (nq - 1.0) * std::tan(1.4 * phi)},
          {"Hansen", base + weight * 1.5 * (nq - 1.0) * tangent},
          {"Vesic", base + weight * 2.0 * (nq + 1.0) * tangent},
          {"Terzaghi", cohesion * terzaghi_nc + surcharge * terzaghi_nq +
                           weight * terzaghi_weight_factor(phi)}};
}

}  // namespace limit::problem
