#include "limit/ground/ground_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace limit::ground {

namespace {

using tables::Need;

tables::FieldNotes notes(std::string_view unit, tables::Range range, std::string_view doc,
                         std::string_view absent = "the model has none") {
  return {.need = Need::optional, .unit = unit, .range = range, .doc = doc, .absent = absent};
}

struct Key {
  std::string_view name;
  StrengthModel model;
  bool required;
  std::optional<double> GroundCurve::*value;
};

constexpr std::array<Key, 8> keys{
    {{"intact_strength", StrengthModel::hoek_brown, true, &GroundCurve::intact_strength},
     {"m_i", StrengthModel::hoek_brown, true, &GroundCurve::m_i},
     {"gsi", StrengthModel::hoek_brown, true, &GroundCurve::gsi},
     {"disturbance", StrengthModel::hoek_brown, false, &GroundCurve::disturbance},
     {"power_coefficient", StrengthModel::power_law, true, &GroundCurve::power_coefficient},
     {"power_exponent", StrengthModel::power_law, true, &GroundCurve::power_exponent},
     {"power_tension", StrengthModel::power_law, true, &GroundCurve::power_tension},
     {"reference_stress", StrengthModel::power_law, true, &GroundCurve::reference_stress}}};

problem::Envelope envelope_of(const GroundCurve& curve) {
  if (curve.model == StrengthModel::hoek_brown) {
    return problem::hoek_brown(*curve.intact_strength, *curve.m_i, *curve.gsi,
                               curve.disturbance.value_or(0.0));
  }
  return {problem::Envelope::Kind::power_law, *curve.reference_stress, *curve.power_coefficient,
          *curve.power_exponent, *curve.power_tension / *curve.reference_stress};
}

}  // namespace

void add_curve_keys(tables::TableBuilder<GroundScene, GroundMaterial>& table) {
  const tables::Range positive = tables::positive();
  table
      .key("model", [](auto& m) -> auto& { return m.curve.model; },
           {.doc = "of its strength: cohesion and friction, or a curved envelope"})
      .key(
          "intact_strength", [](auto& m) -> auto& { return m.curve.intact_strength; },
          notes("Pa", positive, "hoek_brown: unconfined strength of the intact rock, sigma_ci"))
      .key(
          "m_i", [](auto& m) -> auto& { return m.curve.m_i; },
          notes("", positive, "hoek_brown: the intact rock's m"))
      .key(
          "gsi", [](auto& m) -> auto& { return m.curve.gsi; },
          notes("", {.lower = 0.0, .upper = 100.0}, "hoek_brown: geological strength index"))
      .key(
          "disturbance", [](auto& m) -> auto& { return m.curve.disturbance; },
          notes("", {.lower = 0.0, .upper = 1.0}, "hoek_brown: disturbance D", "0"))
      .key(
          "power_coefficient", [](auto& m) -> auto& { return m.curve.power_coefficient; },
          notes("", positive, "power_law: A of tau = A p_r ((sigma_n + T) / p_r)^b"))
      .key(
          "power_exponent", [](auto& m) -> auto& { return m.curve.power_exponent; },
          notes("", {.lower = 0.5, .upper = 1.0, .upper_open = true}, "power_law: b"))
      .key(
          "power_tension", [](auto& m) -> auto& { return m.curve.power_tension; },
          notes("Pa", positive, "power_law: T, the largest tension; a trace stands for none"))
      .key(
          "reference_stress", [](auto& m) -> auto& { return m.curve.reference_stress; },
          notes("Pa", positive, "power_law: p_r"));
}

void check_curve(const GroundScene& scene, std::size_t material, tables::Diagnosis& diagnosis) {
  const GroundCurve& curve = scene.materials[material].curve;
  const std::string table = fmt::format("material.{}.", material);
  const std::string_view model = names_of(curve.model)[static_cast<std::size_t>(curve.model)];
  if (!diagnosis.good({table + "model"})) return;
  for (const Key& key : keys) {
    const std::string path = table + std::string(key.name);
    const bool is_there = (curve.*key.value).has_value();
    if (key.model != curve.model && is_there && diagnosis.good({path})) {
      diagnosis.error(path, fmt::format("given for the model {}", model),
                      fmt::format("it belongs to the model {}",
                                  names_of(key.model)[static_cast<std::size_t>(key.model)]));
    }
    if (key.model == curve.model && key.required && !is_there && diagnosis.good({path})) {
      diagnosis.error(path, "is missing", fmt::format("the model {} needs it", model));
    }
  }
  if (curve.model == StrengthModel::mohr_coulomb) return;
  for (const char* name : {"cohesion", "friction_angle", "dilation_angle", "tension_cutoff"}) {
    if (!diagnosis.given(table + name)) continue;
    diagnosis.error(table + name, fmt::format("given for the model {}", model),
                    "it belongs to the model mohr_coulomb");
  }
  const GroundMaterial& told = scene.materials[material];
  if (told.unit_weight.varies() ||
      (told.saturated_unit_weight && told.saturated_unit_weight->varies())) {
    diagnosis.error(table + "unit_weight", fmt::format("it changes, with the model {}", model),
                    "the weight of ground with a curved envelope is one number");
  }
}

void tell_curve(GroundScene& scene, std::size_t material) {
  const GroundCurve& curve = scene.materials[material].curve;
  if (curve.model == StrengthModel::mohr_coulomb) return;
  problem::Soil& soil = scene.materials[material].soil;
  soil.envelope = envelope_of(curve);
  double low = 0.0, high = 0.0;
  bool is_first = true;
  for (const GroundRegion& region : scene.regions) {
    for (const mesh::Point& place : region.outline) {
      low = is_first ? place.y() : std::min(low, place.y());
      high = is_first ? place.y() : std::max(high, place.y());
      is_first = false;
    }
  }
  const double weight = soil.unit_weight * (high - low) / 2.0;
  const problem::Envelope::Place typical =
      soil.envelope.touched_by_circle(soil.envelope.unconfined() / 2.0 + weight);
  soil.cohesion = typical.cohesion();
  soil.friction_angle = typical.friction_angle();
  scene.materials[material].dilation_angle = soil.friction_angle;
}

}  // namespace limit::ground
