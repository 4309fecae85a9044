#include "limit/ground/ground_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>

#include "tables/nearest_name.hpp"
#include "tables/reader.hpp"

namespace limit::ground {

namespace {

using tables::at_least;
using tables::Field;
using tables::FieldNotes;
using tables::Need;
using tables::TableInfo;
using tables::ValueKind;

constexpr double degree = std::numbers::pi / 180.0;

Field field(std::string_view key, ValueKind kind, FieldNotes notes,
            std::vector<std::string_view> choices = {}) {
  return {key, kind, std::move(choices), notes, {}, {}};
}

TableInfo table(std::string_view name, bool repeated, bool required, std::string_view doc,
                std::vector<Field> fields) {
  return {name, repeated, required, doc, std::move(fields), {}, {}};
}

constexpr tables::Range angles{.lower = 0.0, .upper = 50.0};
constexpr tables::Range inclinations{
    .lower = -90.0, .upper = 90.0, .lower_open = true, .upper_open = true};

std::vector<TableInfo> make_tables() {
  return {
      table("", false, false, "", {field("title", ValueKind::text, {.doc = "of the report"})}),
      table(
          "load", false, true, "what grows until collapse",
          {field("sought", ValueKind::choice,
                 {.need = Need::required,
                  .doc = "footing: its pressure; traction: a multiplier of the live pressures and "
                         "shears; gravity: a multiplier of the unit weights; strength: the factor "
                         "of safety, by which cohesion and tan(friction angle) may be divided"},
                 {"footing", "traction", "gravity", "strength"}),
           field("inclination", ValueKind::number,
                 {.unit = "deg",
                  .range = inclinations,
                  .doc = "of the footing's load from the base's normal, towards +x (or +y)"}),
           field("eccentricity", ValueKind::number,
                 {.unit = "m", .doc = "of the footing's load from the base's middle, likewise"}),
           field("guided", ValueKind::boolean,
                 {.need = Need::optional,
                  .doc = "the footing moves along its normal alone",
                  .absent = "if it ends at a roller"})}),
      table("material", true, true, "a soil",
            {field("name", ValueKind::text, {.need = Need::required}),
             field("cohesion", ValueKind::number, {.unit = "Pa", .range = at_least(0.0)}),
             field("friction_angle", ValueKind::number, {.unit = "deg", .range = angles}),
             field("dilation_angle", ValueKind::number,
                   {.need = Need::optional,
                    .unit = "deg",
                    .range = angles,
                    .doc = "for the Davis-reduced bracket",
                    .absent = "the friction angle"}),
             field("unit_weight", ValueKind::number, {.unit = "N/m3", .range = at_least(0.0)}),
             field("grows", ValueKind::boolean,
                   {.doc = "its weight is multiplied where gravity is sought; default true"})}),
      table("region", true, true, "a polygon of one material",
            {field("name", ValueKind::text, {}),
             field("material", ValueKind::text, {.need = Need::required}),
             field("outline", ValueKind::points, {.need = Need::required, .unit = "m"})}),
      table("side", true, true, "a part of the outline; every part belongs to one",
            {field("name", ValueKind::text, {.need = Need::required}),
             field("kind", ValueKind::choice, {.need = Need::required},
                   {"free", "loaded", "fixed", "roller", "symmetry", "footing"}),
             field("along", ValueKind::points,
                   {.need = Need::required, .unit = "m", .doc = "a polyline on the outline"}),
             field("pressure", ValueKind::number,
                   {.unit = "Pa", .doc = "loaded, footing: given, compression positive"}),
             field("shear", ValueKind::number,
                   {.unit = "Pa", .doc = "loaded: given, along the outline, ground to the left"}),
             field("live_pressure", ValueKind::number,
                   {.unit = "Pa", .doc = "loaded: per unit of the multiplier"}),
             field("live_shear", ValueKind::number, {.unit = "Pa", .doc = "likewise"}),
             field("base", ValueKind::choice, {.doc = "of the footing; default rough"},
                   {"rough", "smooth"}),
             field("tension", ValueKind::boolean,
                   {.doc = "of the footing: whether the soil holds it down, up to its strength, or "
                           "it may lift off; default true"})})};
}

const std::vector<TableInfo>& tables() {
  static const std::vector<TableInfo> all = make_tables();
  return all;
}

using Entry = std::map<std::string, tables::Value, std::less<>>;

template <class T>
T value_or(const Entry& entry, std::string_view key, T otherwise) {
  const auto at = entry.find(key);
  return at == entry.end() ? otherwise : std::get<T>(at->second);
}

std::vector<mesh::Point> points_of(const Entry& entry, std::string_view key) {
  const auto coordinates = value_or(entry, key, std::vector<double>{});
  std::vector<mesh::Point> points;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
    points.emplace_back(coordinates[i], coordinates[i + 1]);
  }
  return points;
}

class Reader {
 public:
  Reader(std::map<std::string, std::vector<Entry>, std::less<>>& entries,
         tables::Diagnosis& diagnosis)
      : entries_(entries), diagnosis_(diagnosis) {}

  GroundScene scene() {
    GroundScene scene;
    scene.title = value_or(single(""), "title", std::string());
    read_load(scene);
    for (std::size_t i = 0; i < entries_["material"].size(); ++i) read_material(scene, i);
    for (std::size_t i = 0; i < entries_["region"].size(); ++i) read_region(scene, i);
    for (std::size_t i = 0; i < entries_["side"].size(); ++i) read_side(scene, i);
    return scene;
  }

 private:
  const Entry& single(const std::string& name) {
    auto& all = entries_[name];
    if (all.empty()) all.resize(1);
    return all.front();
  }

  void read_load(GroundScene& scene) {
    const Entry& entry = single("load");
    const auto sought = value_or(entry, "sought", std::string());
    scene.load.sought = sought == "traction"   ? Sought::traction
                        : sought == "gravity"  ? Sought::gravity
                        : sought == "strength" ? Sought::strength
                                               : Sought::footing;
    scene.load.inclination = value_or(entry, "inclination", 0.0) * degree;
    scene.load.eccentricity = value_or(entry, "eccentricity", 0.0);
    if (entry.count("guided") != 0) scene.load.guided = value_or(entry, "guided", false);
  }

  void read_material(GroundScene& scene, std::size_t i) {
    const Entry& entry = entries_["material"][i];
    const std::string path = fmt::format("material.{}.", i);
    GroundMaterial material;
    material.name = value_or(entry, "name", std::string());
    for (const GroundMaterial& other : scene.materials) {
      if (other.name != material.name) continue;
      diagnosis_.error(path + "name", "found \"" + material.name + "\" again",
                       "each material has a name of its own");
    }
    const double friction = value_or(entry, "friction_angle", 0.0);
    const double dilation = value_or(entry, "dilation_angle", friction);
    material.soil.cohesion = value_or(entry, "cohesion", 0.0);
    material.soil.friction_angle = friction * degree;
    material.soil.unit_weight = value_or(entry, "unit_weight", 0.0);
    material.dilation_angle = dilation * degree;
    material.grows = value_or(entry, "grows", true);
    if (dilation > friction) {
      diagnosis_.error(path + "dilation_angle", fmt::format("found {:g}", dilation),
                       fmt::format("allowed is 0 .. friction_angle ({:g})", friction));
    }
    if (material.soil.cohesion == 0.0 && friction == 0.0 &&
        diagnosis_.good({path + "cohesion", path + "friction_angle"})) {
      diagnosis_.error(path + "cohesion", "neither cohesion nor friction", "one must be positive");
    }
    scene.materials.push_back(std::move(material));
  }

  void read_region(GroundScene& scene, std::size_t i) {
    const Entry& entry = entries_["region"][i];
    GroundRegion region;
    region.name = value_or(entry, "name", fmt::format("region {}", i));
    region.outline = points_of(entry, "outline");
    const auto wanted = value_or(entry, "material", std::string());
    const auto at =
        std::find_if(scene.materials.begin(), scene.materials.end(),
                     [&](const GroundMaterial& material) { return material.name == wanted; });
    if (at == scene.materials.end()) {
      std::vector<std::string_view> names;
      for (const GroundMaterial& material : scene.materials) names.push_back(material.name);
      diagnosis_.error(fmt::format("region.{}.material", i), "found \"" + wanted + "\"",
                       "materials are " + tables::joined(names),
                       tables::nearest_name(wanted, names));
    } else {
      region.material = static_cast<std::size_t>(at - scene.materials.begin());
    }
    scene.regions.push_back(std::move(region));
  }

  void read_side(GroundScene& scene, std::size_t i) {
    const Entry& entry = entries_["side"][i];
    GroundSide side;
    side.name = value_or(entry, "name", std::string());
    side.along = points_of(entry, "along");
    const auto kind = value_or(entry, "kind", std::string());
    side.kind = kind == "loaded"                         ? SideKind::loaded
                : kind == "fixed"                        ? SideKind::fixed
                : kind == "roller" || kind == "symmetry" ? SideKind::roller
                : kind == "footing"                      ? SideKind::footing
                                                         : SideKind::free;
    side.pressure = value_or(entry, "pressure", 0.0);
    side.shear = value_or(entry, "shear", 0.0);
    side.live_pressure = value_or(entry, "live_pressure", 0.0);
    side.live_shear = value_or(entry, "live_shear", 0.0);
    side.rough = value_or(entry, "base", std::string("rough")) == "rough";
    side.tension = value_or(entry, "tension", true);
    const auto belongs = [&](std::string_view key, bool allowed, const char* to) {
      if (allowed || entry.count(key) == 0) return;
      diagnosis_.error(fmt::format("side.{}.{}", i, key), "given for a side of kind " + kind,
                       fmt::format("it belongs to {}", to));
    };
    const bool loaded = side.kind == SideKind::loaded, footing = side.kind == SideKind::footing;
    belongs("pressure", loaded || footing, "kind loaded or footing");
    for (const char* key : {"shear", "live_pressure", "live_shear"}) {
      belongs(key, loaded, "kind loaded");
    }
    for (const char* key : {"base", "tension"}) belongs(key, footing, "kind footing");
    if (side.along.size() == 1) {
      diagnosis_.error(fmt::format("side.{}.along", i), "found one point", "allowed are 2 or more");
    }
    scene.sides.push_back(std::move(side));
  }

  std::map<std::string, std::vector<Entry>, std::less<>>& entries_;
  tables::Diagnosis& diagnosis_;
};

}  // namespace

std::optional<GroundScene> read_ground_scene(std::string_view text,
                                             std::span<const std::string> settings,
                                             tables::Diagnosis& diagnosis,
                                             std::optional<tables::Problem>& unreadable) {
  std::map<std::string, std::vector<Entry>, std::less<>> entries;
  const tables::TableSink sink{[&](const TableInfo& table, std::size_t count) {
                                 entries[std::string(table.name)].resize(count);
                               },
                               [&](const TableInfo& table, std::size_t index, const Field& field,
                                   const tables::Value& value) {
                                 auto& all = entries[std::string(table.name)];
                                 if (all.size() <= index) all.resize(index + 1);
                                 all[index].insert_or_assign(std::string(field.key), value);
                               }};
  unreadable = tables::read_tables(text, settings, tables(), sink, diagnosis);
  if (unreadable) return std::nullopt;
  GroundScene scene = Reader(entries, diagnosis).scene();
  if (!diagnosis.errors().empty()) return std::nullopt;
  return scene;
}

bool is_ground_scene(std::string_view text) {
  return tables::has_table(text, "region");
}

std::string ground_scene_keys() {
  std::string text;
  for (const TableInfo& table : tables()) {
    if (!table.name.empty()) text += fmt::format("  {}  {}\n", table.title(), table.doc);
    for (const Field& field : table.fields) {
      text += fmt::format("    {:<15} {}{}", field.key, field.allowed_text(),
                          field.notes.need == Need::required ? ", required" : "");
      if (!field.notes.doc.empty()) text += fmt::format(": {}", field.notes.doc);
      if (!field.notes.absent.empty()) text += fmt::format("; absent: {}", field.notes.absent);
      text += '\n';
    }
  }
  return text;
}

}  // namespace limit::ground
