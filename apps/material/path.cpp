#include "material/path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tables/builder.hpp"
#include "tables/reader.hpp"

namespace material {

namespace {

constexpr std::array<std::string_view, 2> control_names{"strain", "stress"};
constexpr std::array<std::string_view, 7> test_names{"isotropic",
                                                     "triaxial_compression",
                                                     "triaxial_extension",
                                                     "plane_strain",
                                                     "oedometer",
                                                     "simple_shear",
                                                     "mixed"};
constexpr std::size_t rows = 6;
enum Row : std::size_t { xx, yy, zz, xy, yz, zx };

tables::FieldNotes notes_of(std::string_view name, tables::Need need) {
  const constitutive::ParameterInfo& info = constitutive::parameter_info(name);
  std::string_view absent = "";
  if (need == tables::Need::optional) {
    const bool never = std::isinf(constitutive::MaterialParameters{}.*info.member);
    absent = info.use == constitutive::Use::critical_state ? "only without modified_cam_clay"
             : never                                       ? "never; or the model has none"
                                                           : "0; or the model has none";
    if (info.use == constitutive::Use::hoek_brown) absent = "only without hoek_brown";
    if (info.use == constitutive::Use::power_law) absent = "only without power_law";
    if (name == "strength_factor") absent = "1; or the model has none";
    if (name == "disturbance") absent = "0; or the model has none";
    if (name == "residual_cohesion" || name == "residual_friction_angle") absent = "it stays";
  }
  return {.need = need,
          .unit = info.unit,
          .range = {info.lower, info.upper, info.lower_open, info.upper_open},
          .doc = info.doc,
          .absent = absent};
}

std::vector<std::string_view> names_of_models(std::string_view constitutive::ModelInfo::*name) {
  std::vector<std::string_view> all;
  for (const constitutive::ModelInfo& model : constitutive::material_models()) {
    const std::string_view one = model.*name;
    if (!one.empty() && std::ranges::find(all, one) == all.end()) all.push_back(one);
  }
  return all;
}

tables::Table<Path> top_level() {
  return tables::TableBuilder<Path, Path>("An element test: one point, its strain or stress given.")
      .key("title", &Path::title, {.doc = "Of the pictures."})
      .key("initial_stress", &Path::initial_stress,
           {.need = tables::Need::optional,
            .unit = "Pa",
            .doc = "At the beginning, which is free of strain: xx yy zz, or xx yy zz xy yz zx.",
            .absent = "none"})
      .build();
}

tables::Table<Path> soil() {
  using tables::Need;
  return tables::TableBuilder<Path, Soil>("material", &Path::material,
                                          "As a [[material]] of a scene of fpm-run.")
      .required()
      .key("model", &Soil::model, {.need = Need::required, .doc = "The model."})
      .among(names_of_models(&constitutive::ModelInfo::family))
      .key("match", &Soil::match, {.doc = "Of drucker_prager: which states of Mohr-Coulomb."})
      .among(names_of_models(&constitutive::ModelInfo::match))
      .key("youngs_modulus", &Soil::youngs_modulus, notes_of("youngs_modulus", Need::required))
      .key("poissons_ratio", &Soil::poissons_ratio, notes_of("poissons_ratio", Need::required))
      .key("cohesion", &Soil::cohesion, notes_of("cohesion", Need::optional))
      .key("friction_angle", &Soil::friction_angle, notes_of("friction_angle", Need::optional))
      .key("dilation_angle", &Soil::dilation_angle, notes_of("dilation_angle", Need::optional))
      .key("dilation_cutoff", &Soil::dilation_cutoff, notes_of("dilation_cutoff", Need::optional))
      .key("tension_cutoff", &Soil::tension_cutoff, notes_of("tension_cutoff", Need::optional))
      .key("residual_strain", &Soil::residual_strain, notes_of("residual_strain", Need::optional))
      .key("residual_cohesion", &Soil::residual_cohesion,
           notes_of("residual_cohesion", Need::optional))
      .key("residual_friction_angle", &Soil::residual_friction_angle,
           notes_of("residual_friction_angle", Need::optional))
      .key("compression_index", &Soil::compression_index,
           notes_of("compression_index", Need::optional))
      .key("swelling_index", &Soil::swelling_index, notes_of("swelling_index", Need::optional))
      .key("critical_stress_ratio", &Soil::critical_stress_ratio,
           notes_of("critical_stress_ratio", Need::optional))
      .key("preconsolidation_pressure", &Soil::preconsolidation_pressure,
           notes_of("preconsolidation_pressure", Need::optional))
      .key("intact_strength", &Soil::intact_strength, notes_of("intact_strength", Need::optional))
      .key("m_i", &Soil::m_i, notes_of("m_i", Need::optional))
      .key("gsi", &Soil::gsi, notes_of("gsi", Need::optional))
      .key("disturbance", &Soil::disturbance, notes_of("disturbance", Need::optional))
      .key("power_coefficient", &Soil::power_coefficient,
           notes_of("power_coefficient", Need::optional))
      .key("power_exponent", &Soil::power_exponent, notes_of("power_exponent", Need::optional))
      .key("power_tension", &Soil::power_tension, notes_of("power_tension", Need::optional))
      .key("reference_stress", &Soil::reference_stress,
           notes_of("reference_stress", Need::optional))
      .key("dilation_ratio", &Soil::dilation_ratio, notes_of("dilation_ratio", Need::optional))
      .key("strength_factor", &Soil::strength_factor, notes_of("strength_factor", Need::optional))
      .build();
}

tables::Table<Path> stages() {
  using tables::Need;
  return tables::TableBuilder<Path, Stage>("stage", &Path::stage,
                                           "A part of the path, in equal steps; y is the axis.")
      .required()
      .key("name", &Stage::name, {.doc = "Of its curve in the pictures; else that of its test."})
      .key("test", &Stage::test,
           {.need = Need::required,
            .doc = "isotropic: mean stress, compression positive. triaxial_compression, "
                   "triaxial_extension: strain of yy, the other two stresses stay. plane_strain: "
                   "compression of yy, zz is held, the stress of xx stays. oedometer: compression "
                   "of yy, all else is held. simple_shear: xy, the stress of yy stays, all else is "
                   "held. mixed: as control and change say."})
      .key("amount", &Stage::amount,
           {.need = Need::optional,
            .doc = "How far from the beginning of the stage: strain, or stress [Pa] of isotropic; "
                   "less than 0 goes back.",
            .absent = "only of mixed"})
      .key("control", &Stage::control,
           {.need = Need::optional,
            .doc = "What is given of xx yy zz xy yz zx.",
            .absent = "only without mixed"})
      .key("change", &Stage::change,
           {.need = Need::optional,
            .doc = "How far from the beginning of the stage, of xx yy zz xy yz zx: strain "
                   "(engineering shear) or stress [Pa].",
            .absent = "only without mixed"})
      .key("steps", &Stage::steps,
           {.range = tables::between(1, 1e6), .doc = "Equal steps of the stage."})
      .build();
}

const std::vector<tables::Table<Path>>& all_tables() {
  static const std::vector<tables::Table<Path>> all{top_level(), soil(), stages()};
  return all;
}

void check_soil(const Path& path, tables::Diagnosis& diagnosis) {
  const Soil& soil = path.material;
  if (!diagnosis.good({"material.model", "material.match"})) return;
  const constitutive::ModelInfo& model = *constitutive::find_model(soil.model, soil.match);
  soil.for_each_of_some([&](std::string_view name, const std::optional<double>& value) {
    const std::string key = fmt::format("material.{}", name);
    const constitutive::ParameterInfo& info = constitutive::parameter_info(name);
    const bool used = info.is_used_by(model);
    const bool needed = info.use == constitutive::Use::critical_state ||
                        info.use == constitutive::Use::hoek_brown ||
                        info.use == constitutive::Use::power_law;
    if (used && !value && needed && name != "disturbance") {
      diagnosis.error(key, "is missing", fmt::format("the model {} needs it", soil.model));
    }
    if (value && !used) {
      diagnosis.error(key, fmt::format("found {}", *value),
                      fmt::format("it has no effect on the model {}", soil.model));
    }
  });
  if (!diagnosis.errors().empty()) return;
  for (const constitutive::Objection& objection :
       constitutive::joint_objections(parameters_of(path), model)) {
    diagnosis.error(fmt::format("material.{}", objection.parameter), objection.found,
                    objection.allowed);
  }
}

void check_stage(const Stage& stage, const std::string& table, tables::Diagnosis& diagnosis) {
  if (!diagnosis.good({table + ".test"})) return;
  const bool mixed = stage.test == TestKind::mixed;
  const auto check = [&](const char* key, std::size_t count, std::size_t wanted) {
    if (count == wanted || !diagnosis.good({table + "." + key})) return;
    diagnosis.error(table + "." + key, count == 0 ? "absent" : fmt::format("found {}", count),
                    wanted == 0   ? fmt::format("a test of {} does not have it",
                                                test_names[static_cast<std::size_t>(stage.test)])
                    : wanted == 1 ? "the test needs it"
                                  : fmt::format("mixed needs {} values", wanted));
  };
  check("amount", stage.amount ? 1 : 0, mixed ? 0 : 1);
  check("control", stage.control.size(), mixed ? rows : 0);
  check("change", stage.change.size(), mixed ? rows : 0);
}

/// The match plane_strain is a law of plane strain: whoever strains zz asks another.
void check_plane_strain(const Path& path, tables::Diagnosis& diagnosis) {
  if (!diagnosis.errors().empty()) return;
  const auto* model = constitutive::find_model(path.material.model, path.material.match);
  if (model->only_plane_strain.empty()) return;
  for (std::size_t i = 0; i < path.stage.size(); ++i) {
    const Prescription given = prescription_of(path.stage[i]);
    const auto held = [&](Row row) {
      return given.control[row] == Control::strain && given.change[row] == 0.0;
    };
    if (held(zz) && held(yz) && held(zx)) continue;
    diagnosis.error("material.match", "found " + path.material.match,
                    fmt::format("stage {} strains zz, yz or zx: {}", i, model->only_plane_strain));
  }
}

/// Without a mean stress a clay in critical states has no stiffness.
void check_consolidation(const Path& path, tables::Diagnosis& diagnosis) {
  if (!diagnosis.errors().empty()) return;
  const auto* model = constitutive::find_model(path.material.model, path.material.match);
  if (!model->critical_state) return;
  const auto& stress = path.initial_stress;
  if (!stress.empty() && stress[0] + stress[1] + stress[2] < 0.0) return;
  diagnosis.error(
      "initial_stress", stress.empty() ? "is missing" : "found no compression",
      fmt::format("the model {} begins with a mean stress below zero", path.material.model));
}

std::string cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  return text;
}

}  // namespace

std::span<const std::string_view> names_of(Control) {
  return control_names;
}
std::span<const std::string_view> names_of(TestKind) {
  return test_names;
}

Prescription prescription_of(const Stage& stage) {
  Prescription given;  // all held
  const double amount = stage.amount.value_or(0.0);
  const auto keep = [&](Row row) { given.control[row] = Control::stress; };
  switch (stage.test) {
    case TestKind::isotropic:
      for (const Row row : {xx, yy, zz}) {
        keep(row);
        given.change[row] = -amount;
      }
      break;
    case TestKind::triaxial_compression:
    case TestKind::triaxial_extension:
      keep(xx);
      keep(zz);
      given.change[yy] = stage.test == TestKind::triaxial_extension ? amount : -amount;
      break;
    case TestKind::plane_strain:
      keep(xx);
      given.change[yy] = -amount;
      break;
    case TestKind::oedometer:
      given.change[yy] = -amount;
      break;
    case TestKind::simple_shear:
      keep(yy);
      given.change[xy] = amount;
      break;
    case TestKind::mixed:
      std::ranges::copy(stage.control, given.control.begin());
      std::ranges::copy(stage.change, given.change.begin());
      break;
  }
  return given;
}

constitutive::MaterialParameters parameters_of(const Path& path) {
  const Soil& soil = path.material;
  constitutive::MaterialParameters p;
  p.model = constitutive::find_model(soil.model, soil.match)->name;
  p.youngs_modulus = soil.youngs_modulus;
  p.poissons_ratio = soil.poissons_ratio;
  soil.for_each_of_some([&](std::string_view name, const std::optional<double>& value) {
    if (value) p.*constitutive::parameter_info(name).member = *value;
  });
  return p;
}

PathReading read_path(std::string_view text, const std::string& source,
                      std::span<const std::string> settings) {
  Path path;
  tables::Diagnosis diagnosis(source);
  if (const auto unreadable = tables::read_tables(text, settings, all_tables(), path, diagnosis)) {
    return {std::nullopt, {*unreadable}};
  }
  check_soil(path, diagnosis);
  const std::size_t given = path.initial_stress.size();
  if (diagnosis.good({"initial_stress"}) && given != 0 && given != 3 && given != rows) {
    diagnosis.error("initial_stress", fmt::format("found {} values", given),
                    "allowed are 3 or 6: xx yy zz xy yz zx");
  }
  for (std::size_t i = 0; i < path.stage.size(); ++i) {
    check_stage(path.stage[i], fmt::format("stage.{}", i), diagnosis);
  }
  check_plane_strain(path, diagnosis);
  check_consolidation(path, diagnosis);
  if (!diagnosis.errors().empty()) return {std::nullopt, diagnosis.errors()};
  return {std::move(path), {}};
}

std::string path_reference() {
  std::string out =
      "# The path of fpm-material\n\nA TOML file in SI units, tension positive, except where a "
      "test "
      "says compression. Written by\n`fpm-material --path-reference`.\n";
  for (const tables::Table<Path>& table : all_tables()) {
    out += fmt::format("\n## {}\n\n{}\n\n| key | allowed | needed | meaning |\n|---|---|---|---|\n",
                       table.name.empty() ? "Top level" : fmt::format("`{}`", table.title()),
                       table.doc);
    for (const auto& field : table.fields) {
      const bool required = field.notes.need == tables::Need::required;
      out +=
          fmt::format("| `{}` | {} | {} | {} |\n", field.key, cell(field.allowed_text()),
                      required                     ? "yes"
                      : field.notes.absent.empty() ? "no"
                                                   : fmt::format("absent: {}", field.notes.absent),
                      cell(std::string(field.notes.doc)));
    }
  }
  return out;
}

}  // namespace material
