#include "limit/ground/ground_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limit/ground/ground_curves.hpp"
#include "limit/ground/ground_soils.hpp"
#include "scene/mesh_groups.hpp"
#include "scene/names.hpp"
#include "scene/sample_files.hpp"
#include "tables/builder.hpp"
#include "tables/nearest_name.hpp"
#include "tables/reader.hpp"

namespace limit::ground {

namespace {

using tables::at_least;
using tables::Need;
using GroundTable = tables::Table<GroundScene>;
template <class Struct>
using Builder = tables::TableBuilder<GroundScene, Struct>;

constexpr double degree = std::numbers::pi / 180.0;

constexpr tables::Range angles{.lower = 0.0, .upper = 50.0};
constexpr tables::Range inclinations{
    .lower = -90.0, .upper = 90.0, .lower_open = true, .upper_open = true};

GroundTable top_level() {
  return Builder<GroundScene>("")
      .key("title", &GroundScene::title, {.doc = "of the report"})
      .build();
}

GroundTable units() {
  return Builder<problem::UnitNames>("units", &GroundScene::units,
                                     "what the scene's numbers are in, any consistent units: "
                                     "nothing is converted, unit weights are stress over length")
      .key("stress", &problem::UnitNames::stress, {.doc = "e.g. kPa, psf; default Pa"})
      .key("length", &problem::UnitNames::length, {.doc = "e.g. ft; default m"})
      .build();
}

GroundTable mesh_file() {
  return Builder<scene::MeshFile>("mesh", &GroundScene::mesh,
                                  "of Gmsh, whose physical groups are regions and sides")
      .key("file", &scene::MeshFile::file,
           {.doc = "MSH 4.1 or 2.2 as text, its path from the scene's folder; empty: none"})
      .key("unit", &scene::MeshFile::unit,
           {.unit = "m", .range = tables::positive(), .doc = "of its coordinates"})
      .key("particles", &scene::MeshFile::particles, {.doc = "of fpm-run; has no effect here"})
      .key("text", &scene::MeshFile::text, {.doc = "the mesh itself, in place of its file"})
      .build();
}

GroundTable load() {
  return Builder<GroundLoad>("load", &GroundScene::load, "what grows until collapse")
      .required()
      .key(
          "sought", &GroundLoad::sought,
          {.need = Need::required,
           .doc =
               "footing: its pressure; traction: a multiplier of the live pressures and "
               "shears; gravity: a multiplier of the unit weights; strength: the factor "
               "of safety, by which cohesion and tan(friction angle) may be divided; earthquake: a "
               "multiplier of kh"})
      .key("inclination", &GroundLoad::inclination,
           {.unit = "deg",
            .range = inclinations,
            .doc = "of the footing's load from the base's normal, towards +x (or +y)"})
      .in(degree)
      .key("eccentricity", &GroundLoad::eccentricity,
           {.unit = "m", .doc = "of the footing's load from the base's middle, likewise"})
      .key("kh", &GroundLoad::kh,
           {.doc = "of an earthquake: horizontal weight over weight, along +x or, if negative, "
                   "-x; what grows where an earthquake is sought, 1 or -1 says which way"})
      .key("kv", &GroundLoad::kv,
           {.range = {.lower = -1.0, .upper = 1.0, .upper_open = true},
            .doc = "of an earthquake: the share of the weight that it lifts"})
      .key("guided", &GroundLoad::guided,
           {.need = Need::optional,
            .doc = "the footing moves along its normal alone",
            .absent = "if it ends at a roller"})
      .build();
}

GroundTable water() {
  return Builder<GroundWater>("water", &GroundScene::water,
                              "pore water; cohesion and friction are then those of effective "
                              "stresses, pressures on sides and footings in addition to water's")
      .key("table", &GroundWater::table,
           {.unit = "m", .doc = "its level from left to right, over all of the ground"})
      .key("unit_weight", &GroundWater::unit_weight, {.unit = "N/m3", .range = tables::positive()})
      .key("r_u", &GroundWater::r_u,
           {.need = Need::optional,
            .range = {.lower = 0.0, .upper = 1.0, .upper_open = true},
            .doc = "its pressure over the weight of the ground straight above, instead of a table",
            .absent = "the table says it"})
      .key("pore_pressure", &GroundWater::pore_pressure,
           {.need = Need::optional,
            .unit = "Pa",
            .doc = "its pressure itself, instead of a table, all over the ground; less than none "
                   "counts as none",
            .absent = "the table says it"})
      .build();
}

GroundTable material() {
  Builder<GroundMaterial> table("material", &GroundScene::materials, "a soil");
  table.required()
      .key("name", &GroundMaterial::name, {.need = Need::required})
      .key("cohesion", &GroundMaterial::cohesion,
           {.unit = "Pa",
            .range = at_least(0.0),
            .doc = "where it changes, more than zero wherever the material is; tables, rasters and "
                   "points are told as in scene.md"})
      .key("friction_angle", &GroundMaterial::friction_angle,
           {.unit = "deg", .range = angles, .doc = "likewise"})
      .key("dilation_angle", &GroundMaterial::dilation_angle,
           {.need = Need::optional,
            .unit = "deg",
            .range = angles,
            .doc = "for the Davis-reduced bracket; one number",
            .absent = "the friction angle"})
      .in(degree)
      .key("tension_cutoff", &GroundMaterial::tension_cutoff,
           {.need = Need::optional,
            .unit = "Pa",
            .range = at_least(0.0),
            .doc =
                "largest principal stress (Rankine), more than zero in soil without weight; beyond "
                "the apex it changes nothing",
            .absent = "none"})
      .key("unit_weight", &GroundMaterial::unit_weight,
           {.unit = "N/m3", .range = at_least(0.0), .doc = "also linear, or by a table"})
      .key("saturated_unit_weight", &GroundMaterial::saturated_unit_weight,
           {.need = Need::optional,
            .unit = "N/m3",
            .range = at_least(0.0),
            .doc = "below the water table",
            .absent = "the unit_weight"})
      .key("grows", &GroundMaterial::grows,
           {.doc = "its weight is multiplied where gravity is sought, and shaken where an "
                   "earthquake is"});
  add_curve_keys(table);
  return table.build();
}

GroundTable region() {
  return Builder<GroundRegion>("region", &GroundScene::regions, "a polygon of one material")
      .required()
      .key("name", &GroundRegion::name, {})
      .key("material", &GroundRegion::material_name, {.need = Need::required})
      .key("group", &GroundRegion::group,
           {.doc = "physical surface of [mesh], in place of outline"})
      .key("outline", &GroundRegion::outline,
           {.need = Need::optional,
            .unit = "m",
            .doc = "also with arcs { centre, radius, from, to, chords }, see scene.md",
            .absent = "that of group"})
      .key("holes", &GroundRegion::holes, {.need = Need::optional, .unit = "m", .absent = "none"})
      .build();
}

GroundTable side() {
  return Builder<GroundSide>("side", &GroundScene::sides,
                             "a part of the outline; every part belongs to one")
      .required()
      .key("name", &GroundSide::name, {.need = Need::required})
      .key("kind", &GroundSide::kind, {.need = Need::required})
      .key("group", &GroundSide::group, {.doc = "physical curve of [mesh], in place of along"})
      .key("along", &GroundSide::along,
           {.need = Need::optional,
            .unit = "m",
            .doc = "a polyline on the outline",
            .absent = "that of group"})
      .key("pressure", &GroundSide::pressure,
           {.unit = "Pa", .doc = "loaded, footing: given, compression positive"})
      .key("shear", &GroundSide::shear,
           {.unit = "Pa", .doc = "loaded: given, along the outline, ground to the left"})
      .key("live_pressure", &GroundSide::live_pressure,
           {.unit = "Pa", .doc = "loaded: per unit of the multiplier"})
      .key("live_shear", &GroundSide::live_shear, {.unit = "Pa", .doc = "likewise"})
      .key("base", &GroundSide::base, {.doc = "of the footing"})
      .key("tension", &GroundSide::tension,
           {.doc = "of the footing: whether the soil holds it down, up to its strength, or it may "
                   "lift off"})
      .build();
}

const std::vector<GroundTable>& ground_tables() {
  static const std::vector<GroundTable> all{top_level(), units(),    mesh_file(), load(),
                                            water(),     material(), region(),    side()};
  return all;
}

void check_material(GroundScene& scene, std::size_t i, tables::Diagnosis& diagnosis) {
  GroundMaterial& material = scene.materials[i];
  const std::string path = fmt::format("material.{}.", i);
  const auto end = scene.materials.begin() + static_cast<std::ptrdiff_t>(i);
  if (std::any_of(scene.materials.begin(), end,
                  [&](const GroundMaterial& other) { return other.name == material.name; }) &&
      diagnosis.good({path + "name"})) {
    diagnosis.error(path + "name", "found \"" + material.name + "\" again",
                    "each material has a name of its own");
  }
  check_curve(scene, i, diagnosis);
  if (material.curve.model != StrengthModel::mohr_coulomb) return;
  const double friction = material.friction_angle.value * degree;
  if (!diagnosis.given(path + "dilation_angle")) material.dilation_angle = friction;
  if (material.dilation_angle > friction && !material.friction_angle.varies() &&
      diagnosis.good({path + "dilation_angle", path + "friction_angle"})) {
    diagnosis.error(path + "dilation_angle",
                    fmt::format("found {:g}", material.dilation_angle / degree),
                    fmt::format("allowed is 0 .. friction_angle ({:g})", friction / degree));
  }
  if (material.cohesion.value == 0.0 && !material.cohesion.varies() && friction == 0.0 &&
      !material.friction_angle.varies() &&
      diagnosis.good({path + "cohesion", path + "friction_angle"})) {
    diagnosis.error(path + "cohesion", "neither cohesion nor friction", "one must be positive");
  }
}

void find_material(GroundScene& scene, std::size_t i, tables::Diagnosis& diagnosis) {
  GroundRegion& region = scene.regions[i];
  if (region.name.empty()) region.name = fmt::format("region {}", i);
  region.number = i;
  const auto at = std::find_if(
      scene.materials.begin(), scene.materials.end(),
      [&](const GroundMaterial& material) { return material.name == region.material_name; });
  const std::string path = fmt::format("region.{}.material", i);
  if (at != scene.materials.end()) {
    region.material = static_cast<std::size_t>(at - scene.materials.begin());
  } else if (diagnosis.good({path, "material"})) {
    std::vector<std::string_view> names;
    for (const GroundMaterial& material : scene.materials) names.push_back(material.name);
    diagnosis.error(path, "found \"" + region.material_name + "\"",
                    "materials are " + tables::joined(names),
                    tables::nearest_name(region.material_name, names));
  }
}

void check_side(GroundScene& scene, std::size_t i, tables::Diagnosis& diagnosis) {
  GroundSide& side = scene.sides[i];
  const std::string table = fmt::format("side.{}.", i);
  const auto kind = names_of(side.kind)[static_cast<std::size_t>(side.kind)];
  const auto belongs = [&](const char* key, bool allowed, const char* to) {
    if (allowed || !diagnosis.given(table + key) || !diagnosis.good({table + "kind", table + key}))
      return;
    diagnosis.error(table + key, fmt::format("given for a side of kind {}", kind),
                    fmt::format("it belongs to {}", to));
  };
  const bool loaded = side.kind == SideKind::loaded, footing = side.kind == SideKind::footing;
  belongs("pressure", loaded || footing, "kind loaded or footing");
  for (const char* key : {"shear", "live_pressure", "live_shear"}) {
    belongs(key, loaded, "kind loaded");
  }
  for (const char* key : {"base", "tension"}) belongs(key, footing, "kind footing");
  if (side.along.size() == 1) {
    diagnosis.error(table + "along", "found one point", "allowed are 2 or more");
  }
  if (side.kind == SideKind::symmetry && scene.load.kh != 0.0 &&
      diagnosis.good({table + "kind", "load.kh"})) {
    diagnosis.error(table + "kind", fmt::format("found symmetry, and kh = {:g}", scene.load.kh),
                    "ground that is shaken has no plane of symmetry; allowed is all of it, or kind "
                    "roller for a smooth wall");
  }
  if (side.kind == SideKind::symmetry) side.kind = SideKind::roller;
}

// The default is in newtons and metres.
void check_water(const GroundScene& scene, tables::Diagnosis& diagnosis) {
  if (scene.water.pore_pressure && scene.water.unit_weight != GroundWater{}.unit_weight) {
    diagnosis.warning("water.unit_weight",
                      fmt::format("found {:g} beside pore_pressure", scene.water.unit_weight),
                      "it has no effect: that is of a table's water");
  }
  const problem::UnitNames si;
  const bool is_si = scene.units.stress == si.stress && scene.units.length == si.length;
  if (scene.water.table.empty() || is_si || diagnosis.given("water.unit_weight")) return;
  diagnosis.error(
      "water.unit_weight",
      fmt::format("absent, and the scene's unit weights are in {}", scene.units.unit_weight()),
      "the default, 9810, is in N/m3: give that of water in the scene's unit, as 9.81 "
      "for kPa and m, 62.4 for psf and ft");
}

}  // namespace

std::optional<GroundScene> read_ground_scene(std::string_view text,
                                             std::span<const std::string> settings,
                                             tables::Diagnosis& diagnosis,
                                             std::optional<tables::Complaint>& unreadable) {
  GroundScene scene;
  unreadable = tables::read_tables(text, settings, ground_tables(), scene, diagnosis);
  if (unreadable) return std::nullopt;
  if (scene::take_groups(scene.mesh, scene.regions, scene.sides, diagnosis) == 3) {
    diagnosis.error("mesh.file", "found a solid mesh", "fpm-limit's ground is plane");
    return std::nullopt;
  }
  scene::take_sample_files(ground_tables(), scene, diagnosis);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) check_material(scene, i, diagnosis);
  for (std::size_t i = 0; i < scene.regions.size(); ++i) find_material(scene, i, diagnosis);
  if (diagnosis.errors().empty()) tell_soils(scene, diagnosis);
  for (std::size_t i = 0; i < scene.sides.size(); ++i) check_side(scene, i, diagnosis);
  check_water(scene, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  return scene;
}

bool is_ground_scene(std::string_view text) {
  return tables::has_table(text, "region");
}

std::string ground_scene_keys() {
  std::string text;
  for (const GroundTable& table : ground_tables()) {
    GroundScene scene;
    table.resize(scene, 1);
    if (!table.name.empty()) text += fmt::format("  {}  {}\n", table.title(), table.doc);
    for (const auto& field : table.fields) {
      const tables::FieldNotes& notes = field.notes;
      text += fmt::format("    {:<15} {}{}", field.key, field.allowed_text(),
                          notes.need == Need::required ? ", required" : "");
      if (!notes.doc.empty()) text += fmt::format(": {}", notes.doc);
      if (!notes.absent.empty()) text += fmt::format("; absent: {}", notes.absent);
      if (const auto value = field.read(scene, 0);
          value && notes.need == Need::defaulted && field.kind != tables::ValueKind::text) {
        text += "; default " + tables::value_text(*value, field.kind);
      }
      text += '\n';
    }
  }
  return text;
}

}  // namespace limit::ground
