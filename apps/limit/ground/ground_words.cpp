#include "limit/ground/ground_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

namespace limit::ground {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

// Whether the multiplier is the live pressure itself.
bool is_unit_traction(const GroundScene& scene) {
  return std::all_of(scene.sides.begin(), scene.sides.end(), [](const GroundSide& side) {
    return (side.live_pressure == 0.0 || side.live_pressure == 1.0) && side.live_shear == 0.0;
  });
}

std::string words_of(const tables::VaryingNumber& number, const std::string& unit,
                     const std::string& length) {
  if (!number.samples) {
    std::string words = fmt::format("{:g} {}", number.value, unit);
    if (!number.varies()) return words;
    return words + fmt::format(" at ({:g}, {:g}), growing by ({:g}, {:g}) {}/{}", number.at[0],
                               number.at[1], number.gradient[0], number.gradient[1], unit, length);
  }
  constexpr std::array<const char*, 3> kinds{"a table", "a raster", "points"};
  const auto [least, most] = std::ranges::minmax(number.samples->values);
  return fmt::format("{:g} .. {:g} {} by {} of {} values", least, most, unit,
                     kinds[static_cast<std::size_t>(number.samples->kind)],
                     number.samples->values.size());
}

std::string curve_text(const GroundMaterial& material, const problem::UnitNames& units) {
  const problem::Envelope& envelope = material.soil.envelope;
  if (envelope.kind == problem::Envelope::Kind::hoek_brown) {
    return fmt::format("Hoek-Brown, sigma_ci = {:g} {}, m_b = {:.4g}, s = {:.4g}, a = {:.4g}",
                       envelope.stress, units.stress, envelope.coefficient, envelope.cohesive,
                       envelope.exponent);
  }
  return fmt::format("tau = {:g} x {:g} {} ((sigma_n + {:g} {}) / {:g} {})^{:g}",
                     envelope.coefficient, envelope.stress, units.stress, envelope.apex(),
                     units.stress, envelope.stress, units.stress, envelope.exponent);
}

}  // namespace

std::vector<std::string> assumptions_of(const GroundScene& scene, const problem::Problem& problem,
                                        const std::optional<Base>& base) {
  std::vector<std::string> assumptions{
      "plane strain, rigid-plastic soil, associated flow, no change of geometry",
      "the polygons of the scene, rigid beyond fixed sides and rollers; the lower bound holds for "
      "wider ground only if these are far enough away not to matter"};
  if (base) {
    const GroundSide& side = scene.sides[base->side];
    assumptions.push_back(problem::base_assumption(side.base == BaseKind::rough, side.tension));
    assumptions.emplace_back(problem.footing.may_move[2]
                                 ? "the footing is free to move along x and y and to rotate"
                                 : "the footing is guided along its normal");
  }
  if (scene.load.kh != 0.0 || scene.load.kv != 0.0) {
    assumptions.emplace_back("an earthquake is a steady weight aslant (pseudo-static)");
  }
  if (scene.water.is_there()) {
    assumptions.emplace_back(
        std::string(scene.water.pore_pressure
                        ? "the pressure of pore water is as told, suction none, and water presses "
                          "on faces of the ground as it does within; "
                    : scene.water.r_u ? "the pressure of pore water is r_u times the weight of the "
                                        "ground straight above; "
                                      : "pore water is at rest or seeps as its table tells, "
                                        "hydrostatic below it; ") +
        "loads and pressures are in addition to the water's, stresses effective");
  }
  if (std::any_of(problem.soils.begin(), problem.soils.end(),
                  [](const problem::Soil& soil) { return soil.cuts_tension(); })) {
    assumptions.emplace_back(
        "where tension is cut off what opens flows by the normality of Rankine; where strength is "
        "divided, so is that tension");
  }
  if (std::ranges::any_of(problem.soils,
                          [](const problem::Soil& soil) { return soil.variation != nullptr; })) {
    assumptions.emplace_back(
        "a strength that changes in another way than linearly in cohesion alone is bounded in each "
        "triangle, from below for the lower bound and from above for the upper one: both hold for "
        "the strength as it is told");
  }
  const bool is_curved = std::ranges::any_of(
      problem.soils, [](const problem::Soil& soil) { return soil.is_curved(); });
  if (is_curved) {
    assumptions.emplace_back(
        "strength of a curved envelope flows by its normal, whatever its dilation; the bounds are "
        "certified against the envelope itself, for which the programmes have parabolas that touch "
        "it");
  }
  if (scene.load.sought == Sought::strength) {
    assumptions.emplace_back(
        is_curved ? "cohesion and tan(friction angle) of all materials, and the shear strength of "
                    "curved envelopes under every normal stress, are divided by the factor"
                  : "cohesion and tan(friction angle) of all materials are divided by the factor");
  }
  return assumptions;
}

void describe(const GroundScene& scene, problem::Case& result) {
  std::set<std::string> said;
  for (const GroundMaterial& material : scene.materials) {
    // Of another one, under water or between lines of its table.
    if (!said.insert(material.name).second) continue;
    const std::string& stress = scene.units.stress;
    const std::string weight = scene.units.unit_weight();
    if (material.soil.is_curved()) {
      result.data.emplace_back(
          material.name, fmt::format("{}, {}", curve_text(material, scene.units),
                                     words_of(material.unit_weight, weight, scene.units.length)));
      continue;
    }
    std::string cohesion = "c = " + words_of(material.cohesion, stress, scene.units.length);
    if (material.soil.cuts_tension()) {
      cohesion +=
          fmt::format(", tension cut off at {:g} {}", material.soil.tension, scene.units.stress);
    }
    result.data.emplace_back(
        material.name, fmt::format("{}, phi = {}, {}", cohesion,
                                   words_of(material.friction_angle, "deg", scene.units.length),
                                   words_of(material.unit_weight, weight, scene.units.length)));
  }
  if (scene.water.is_there()) {
    result.data.emplace_back(
        "water", scene.water.pore_pressure
                     ? words_of(*scene.water.pore_pressure, scene.units.stress, scene.units.length)
                 : scene.water.r_u
                     ? fmt::format("r_u = {:g}", *scene.water.r_u)
                     : fmt::format("{:g} {}, {} points of its table", scene.water.unit_weight,
                                   scene.units.unit_weight(), scene.water.table.size()));
  }
  if (scene.load.kh != 0.0 || scene.load.kv != 0.0) {
    result.data.emplace_back("earthquake",
                             fmt::format("kh = {:g}, kv = {:g}", scene.load.kh, scene.load.kv));
  }
  switch (scene.load.sought) {
    case Sought::footing:
      result.quantity = "mean pressure at collapse, normal to the base";
      if (scene.load.inclination != 0.0) {
        result.data.emplace_back("inclination",
                                 fmt::format("{:g} deg", scene.load.inclination / degree));
      }
      if (scene.load.eccentricity != 0.0) {
        result.data.emplace_back(
            "eccentricity", fmt::format("{:g} {}", scene.load.eccentricity, scene.units.length));
      }
      return;
    case Sought::traction:
      if (is_unit_traction(scene)) {
        result.quantity = "live pressure at collapse";
        return;
      }
      result.quantity = "multiplier of the live tractions at collapse";
      break;
    case Sought::gravity:
      result.quantity = "multiplier of the unit weights at collapse";
      break;
    case Sought::earthquake:
      result.quantity = std::abs(scene.load.kh) == 1.0
                            ? "horizontal weight over weight (kh) at collapse"
                            : "multiplier of kh at collapse";
      break;
    case Sought::strength:
      result.quantity = "factor of safety of the strength";
      result.seeks_strength = true;
      break;
  }
  result.unit = "";
}

void note_dilation(const GroundScene& scene, problem::Case& result) {
  for (const GroundMaterial& material : scene.materials) {
    if (!material.friction_angle.varies() ||
        material.dilation_angle == material.friction_angle.value * degree) {
      continue;
    }
    result.notes.push_back(
        fmt::format("material \"{}\" dilates by its friction angle here, which changes from place "
                    "to place: there is no Davis-reduced bracket of such a soil",
                    material.name));
    return;
  }
}

}  // namespace limit::ground
