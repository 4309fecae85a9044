#include "limit/problem/case.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace limit::problem {

std::string UnitNames::unit_weight() const {
  return stress == "Pa" && length == "m" ? "N/m3" : stress + "/" + length;
}

Case strip_case(const Strip& strip, std::optional<Box> wanted, const UnitNames& names) {
  if (const auto objection = objection_to(strip)) throw std::invalid_argument(objection->text());
  const Box box = wanted.value_or(box_of(strip));
  Case result;
  result.names = names;
  result.unit = names.stress;
  result.title = fmt::format("strip footing, {}", strip.rough ? "rough" : "smooth");
  const Soil& soil = strip.soil;
  result.data = {
      {"half width", fmt::format("{:g} {}", strip.half_width, names.length)},
      {"cohesion", fmt::format("{:g} {}", soil.cohesion, names.stress)},
      {"friction angle", fmt::format("{:g} deg", soil.friction_angle * 180.0 / std::numbers::pi)},
      {"unit weight", fmt::format("{:g} {}", soil.unit_weight, names.unit_weight())},
      {"surcharge", fmt::format("{:g} {}", strip.surcharge, names.stress)}};
  result.assumptions = {
      "plane strain, rigid-plastic soil, associated flow, no change of geometry",
      fmt::format("ground {:.4g} half widths wide from the axis and {:.4g} deep, rigid beyond; the "
                  "upper bound holds for a half-space, too, the lower one only if the box is wide "
                  "and deep enough not to matter",
                  box.width, box.depth),
      base_assumption(strip.rough, strip.tension)};
  result.hand = hand_formulas(soil.cohesion, soil.friction_angle, soil.unit_weight, strip.surcharge,
                              strip.half_width);
  result.units = units_of(strip);
  result.lower = strip_problem(strip, lower_fan(strip, box));
  result.upper = strip_problem(strip, upper_fan(strip, box));
  return result;
}

std::string base_assumption(bool rough, bool tension) {
  return fmt::format("{} base: {}; {}", rough ? "rough" : "smooth",
                     rough ? "up to the soil's full strength in shear" : "no shear stress",
                     tension ? "bonded, up to the soil's strength in tension"
                             : "no tension, the footing may lift off the soil");
}

Soil davis_reduced(const Soil& soil, double dilation_angle) {
  const double phi = soil.friction_angle;
  const double factor =
      std::cos(dilation_angle) * std::cos(phi) / (1.0 - std::sin(dilation_angle) * std::sin(phi));
  Soil reduced = soil;
  reduced.cohesion *= factor;
  reduced.cohesion_gradient *= factor;
  reduced.divisor /= factor;
  reduced.friction_angle = std::atan(factor * std::tan(phi));
  return reduced;
}

}  // namespace limit::problem
