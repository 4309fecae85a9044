#include "scene/tables_curve.hpp"

#include "constitutive/parameters.hpp"

namespace scene {

namespace {

tables::FieldNotes notes(std::string_view name) {
  const constitutive::ParameterInfo& info = constitutive::parameter_info(name);
  std::string_view absent = "only without hoek_brown or power_law";
  if (info.use == constitutive::Use::hoek_brown) absent = "only without hoek_brown";
  if (info.use == constitutive::Use::power_law) absent = "only without power_law";
  if (name == "disturbance") absent = "0";
  return {.need = tables::Need::optional,
          .unit = info.unit,
          .range = {info.lower, info.upper, info.lower_open, info.upper_open},
          .doc = info.doc,
          .absent = absent};
}

}  // namespace

void add_curved_strength(tables::TableBuilder<Scene, Material>& table) {
  table
      .key(
          "intact_strength", [](auto& m) -> auto& { return m.curve.intact_strength; },
          notes("intact_strength"))
      .key(
          "m_i", [](auto& m) -> auto& { return m.curve.m_i; }, notes("m_i"))
      .key(
          "gsi", [](auto& m) -> auto& { return m.curve.gsi; }, notes("gsi"))
      .key(
          "disturbance", [](auto& m) -> auto& { return m.curve.disturbance; }, notes("disturbance"))
      .key(
          "power_coefficient", [](auto& m) -> auto& { return m.curve.power_coefficient; },
          notes("power_coefficient"))
      .key(
          "power_exponent", [](auto& m) -> auto& { return m.curve.power_exponent; },
          notes("power_exponent"))
      .key(
          "power_tension", [](auto& m) -> auto& { return m.curve.power_tension; },
          notes("power_tension"))
      .key(
          "reference_stress", [](auto& m) -> auto& { return m.curve.reference_stress; },
          notes("reference_stress"))
      .key(
          "dilation_ratio", [](auto& m) -> auto& { return m.curve.dilation_ratio; },
          notes("dilation_ratio"));
}

}  // namespace scene
