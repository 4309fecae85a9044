#pragma once

#include <string>
#include <vector>

namespace limit::problem {

/// A bearing capacity as engineers estimate it by hand; none of them is a bound.
struct HandFormula {
  std::string name;
  double pressure = 0.0;  // [Pa] c Nc + q Nq + gamma b Ngamma
};

/// Prandtl-Reissner's c Nc + q Nq, exact without weight, and beside it the weight terms of Meyerhof
/// (1963), Hansen (1970) and Vesic (1973); Terzaghi's (1943) own three factors, his N_gamma
/// interpolated in his table. For a strip of half width b [m] and the angle in radians, <= 50 deg.
[[nodiscard]] std::vector<HandFormula> hand_formulas(double cohesion, double friction_angle,
                                                     double unit_weight, double surcharge,
                                                     double half_width);

}  // namespace limit::problem
