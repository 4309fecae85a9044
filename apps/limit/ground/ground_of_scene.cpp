#include "limit/ground/ground_of_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "constitutive/parameters.hpp"
#include "limit/ground/ground_soils.hpp"
#include "scene/complete.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"
#include "tables/reader.hpp"

namespace limit::ground {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::vector<mesh::Point> points_of(const std::vector<scene::PlanePoint>& places) {
  std::vector<mesh::Point> points;
  for (const scene::PlanePoint& place : places) points.emplace_back(place.x(), place.y());
  return points;
}

/// Takes from a scene what fpm-limit brackets and says what of it that is not.
class Reader {
 public:
  Reader(const scene::Scene& scene, tables::Diagnosis& diagnosis)
      : scene_(scene), diagnosis_(diagnosis) {}

  GroundScene ground() {
    found_.title = scene_.title;
    refuse(!scene_.cutout.empty(), "cutout", "the ground has cutouts",
           "fpm-limit knows regions alone: let their outlines go around what is cut out");
    refuse(!scene_.traction.empty(), "traction", "the ground has a traction on a face of its box",
           "give the [[side]] there kind = \"loaded\"");
    refuse(!scene_.initial_stress.loaded_sides.empty(), "initial_stress.loaded_sides",
           "the initial stress loads sides",
           "fpm-limit knows the loads of [[side]]s: give them as pressure and shear");
    refuse(!scene_.stage.empty(), "stage", "the ground changes in stages",
           "fpm-limit bounds one ground: give it what is there at the stage in question");
    refuse(
        scene_.approximation.interfaces == scene::InterfaceKind::contact,
        "approximation.interfaces", "bodies slide on each other",
        "fpm-limit knows ground that holds together: give a joint a thin region of its strength");
    for (std::size_t i = 0; i < scene_.interface.size(); ++i) {
      refuse(scene_.interface[i].kind == scene::InterfaceKind::contact,
             fmt::format("interface.{}.kind", i), "bodies slide on each other",
             "fpm-limit knows ground that holds together: give a joint a thin region of its "
             "strength");
    }
    refuse(!scene_.drive.weakened.empty(), "drive.weakened", "only some materials are weakened",
           "fpm-limit divides the strength of all");
    refuse(!scene_.drive.loads.empty(), "drive.loads", "only some loads grow",
           "fpm-limit lets all live loads grow: give those that do not as pressure and shear");
    take_load();
    for (std::size_t m = 0; m < scene_.material.size(); ++m) take_material(m);
    for (std::size_t r = 0; r < scene_.region.size(); ++r) {
      const scene::Region& region = scene_.region[r];
      GroundRegion taken;
      taken.name = region.name.empty() ? fmt::format("region {}", r) : region.name;
      taken.material_name = region.material;
      taken.material = scene::material_of(scene_, r);
      taken.number = r;
      taken.outline = points_of(region.outline);
      for (const auto& hole : region.holes) taken.holes.push_back(points_of(hole));
      found_.regions.push_back(std::move(taken));
    }
    for (const scene::OutlineSide& side : scene_.side) take_side(side);
    take_water();
    if (diagnosis_.errors().empty()) tell_soils(found_, diagnosis_);
    check_supports();
    return std::move(found_);
  }

 private:
  void refuse(bool refused, const std::string& key, const std::string& found,
              const std::string& allowed) {
    if (refused) diagnosis_.error(key, found, allowed);
  }

  // What the drive lets grow, unless [load] says what is sought.
  std::optional<Sought> sought() const {
    if (scene_.load.sought) return static_cast<Sought>(*scene_.load.sought);
    const scene::Drive& drive = scene_.drive;
    if (drive.kind == scene::DriveKind::displacement || scene::loads_plate(drive)) {
      return Sought::footing;
    }
    if (drive.kind == scene::DriveKind::strength) return Sought::strength;
    const auto grows = [&](scene::LoadKind kind) {
      return drive.kind == scene::DriveKind::load && std::ranges::count(drive.scales, kind) > 0;
    };
    if (grows(scene::LoadKind::gravity)) return Sought::gravity;
    if (grows(scene::LoadKind::traction)) return Sought::traction;
    return std::nullopt;
  }

  void take_load() {
    GroundLoad& load = found_.load;
    const auto what = sought();
    refuse(!what, "load.sought", "is missing, and the drive lets nothing grow",
           "say what grows until collapse");
    load.sought = what.value_or(load.sought);
    load.inclination = scene_.load.inclination * degree;
    load.eccentricity = scene_.load.eccentricity;
    // A plate that keeps its place and has no point to turn about keeps its direction as well.
    const scene::Drive& drive = scene_.drive;
    const bool is_pushed = scene::loads_plate(drive) && drive.lateral == scene::Lateral::fixed &&
                           load.inclination == 0.0 && load.eccentricity == 0.0;
    load.guided = scene_.load.guided;
    if (!load.guided && (drive.kind == scene::DriveKind::displacement || is_pushed)) {
      load.guided = drive.at.empty();
    }
    load.kv = scene_.load.kv;
    load.kh = scene_.load.kh;
    const scene::Point& gravity = scene_.gravity.acceleration;
    if (gravity.empty()) return;
    refuse(gravity[1] > 0.0 || (gravity[1] == 0.0 && gravity[0] != 0.0), "gravity.acceleration",
           "it does not act downwards", "an earthquake is kh and kv of [load]");
    if (gravity[1] >= 0.0) return;
    weight_ = -gravity[1] / (1.0 - load.kv);
    if (load.sought != Sought::earthquake) load.kh = gravity[0] / weight_;
  }

  void take_material(std::size_t m) {
    const scene::Material& material = scene_.material[m];
    const std::string table = fmt::format("material.{}.", m);
    refuse(!scene::yields(material), table + "model", "an elastic material never yields",
           "fpm-limit brackets collapse");
    refuse(material.match != "plane_strain", table + "match", "found " + material.match,
           "only strengths matched in plane strain are those of Mohr-Coulomb");
    refuse(material.curve.power_tension == 0.0, table + "power_tension", "found 0",
           "at a free face no stress is strictly within such an envelope, and no stress field can "
           "be certified: allowed is a trace, as a thousandth of the reference_stress");
    refuse(scene::model_of(material).curve != constitutive::Curve::none &&
               (material.density.varies() ||
                (material.saturated_unit_weight && material.saturated_unit_weight->varies())),
           table + "unit_weight", "it changes, with the model " + material.model,
           "the weight of ground with a curved envelope is one number");
    refuse(material.residual_strain.has_value(), table + "residual_strain",
           fmt::format("found {:g}", material.residual_strain.value_or(0.0)),
           "the bounds are those of a soil whose strength stays");
    refuse(scene::model_of(material).critical_state, table + "model", "found " + material.model,
           "the bounds are those of a soil whose strength stays");
    GroundMaterial soil;
    soil.name = material.name;
    const auto parameters = scene::yields(material) ? scene::parameters_of(material)
                                                    : constitutive::MaterialParameters{};
    soil.cohesion = material.cohesion.value_or(parameters.cohesion);
    // A cylinder has no friction angle, whatever the scene says.
    if (scene::model_of(material).frictional) {
      soil.friction_angle = material.friction_angle.value_or(parameters.friction_angle);
    }
    soil.dilation_angle = parameters.dilation_angle * degree;
    const bool is_associated = material.dilation_angle == material.friction_angle;
    if (is_associated) soil.dilation_angle = soil.friction_angle.value * degree;
    refuse(material.dilation_angle && material.dilation_angle->varies() && !is_associated,
           table + "dilation_angle", "it changes from place to place",
           "allowed is one angle, or that of friction_angle");
    soil.tension_cutoff = material.tension_cutoff;
    soil.curve = curve_of(material);
    refuse(material.tension_cutoff.has_value() && soil.curve.model != StrengthModel::mohr_coulomb,
           table + "tension_cutoff", "it is given for a curved envelope",
           "the tension that such ground bears is that of its envelope");
    soil.unit_weight = material.density.scaled(weight_);
    if (material.saturated_unit_weight && material.unit_weight.value_or(0.0).value > 0.0) {
      soil.saturated_unit_weight = material.saturated_unit_weight->scaled(
          material.density.value * weight_, material.unit_weight->value);
    }
    found_.materials.push_back(soil);
  }

  static GroundCurve curve_of(const scene::Material& material) {
    const scene::CurvedStrength& told = material.curve;
    GroundCurve curve;
    switch (scene::model_of(material).curve) {
      case constitutive::Curve::none:
        return curve;
      case constitutive::Curve::hoek_brown:
        curve.model = StrengthModel::hoek_brown;
        break;
      case constitutive::Curve::power_law:
        curve.model = StrengthModel::power_law;
        break;
    }
    curve.intact_strength = told.intact_strength;
    curve.m_i = told.m_i;
    curve.gsi = told.gsi;
    curve.disturbance = told.disturbance;
    curve.power_coefficient = told.power_coefficient;
    curve.power_exponent = told.power_exponent;
    curve.power_tension = told.power_tension;
    curve.reference_stress = told.reference_stress;
    return curve;
  }

  void take_side(const scene::OutlineSide& side) {
    GroundSide taken;
    taken.name = side.name;
    taken.kind = static_cast<SideKind>(
        side.kind == scene::OutlineKind::symmetry ? scene::OutlineKind::roller : side.kind);
    taken.along = points_of(side.along);
    taken.pressure = side.pressure;
    taken.shear = side.shear;
    taken.live_pressure = side.live_pressure;
    taken.live_shear = side.live_shear;
    taken.base = side.base == scene::Base::rough ? BaseKind::rough : BaseKind::smooth;
    taken.tension = side.tension;
    found_.sides.push_back(std::move(taken));
  }

  void take_water() {
    found_.water.table = points_of(scene_.water.table);
    found_.water.unit_weight = scene_.water.unit_weight;
    found_.water.r_u = scene_.water.r_u;
    found_.water.pore_pressure = scene_.water.pore_pressure;
    const bool grows =
        found_.load.sought == Sought::gravity && found_.water.is_there() && !found_.water.r_u;
    refuse(grows && !scene_.load.sought, "drive.scales", "found gravity, in ground under water",
           "in a run the water's weight grows, too, in fpm-limit it stays: say what is sought by "
           "load.sought");
  }

  // Whatever is held is held by sides.
  void check_supports() {
    scene::Scene bare = scene_;
    bare.support.clear();
    bare.symmetry.clear();
    tables::Diagnosis ignored("");
    scene::complete(bare, ignored);
    for (std::size_t i = 0; i < scene_.support.size(); ++i) {
      const scene::Support& support = scene_.support[i];
      const bool is_side = std::ranges::any_of(bare.support, [&](const scene::Support& other) {
        return other.side == support.side && other.directions == support.directions;
      });
      refuse(!is_side, fmt::format("support.{}", i), "it holds something else than a side does",
             "fpm-limit knows what the kinds of [[side]] hold");
    }
    for (std::size_t i = 0; i < scene_.symmetry.size(); ++i) {
      refuse(std::ranges::count(bare.symmetry, scene_.symmetry[i]) == 0,
             fmt::format("symmetry.{}", i), "it is not one of a side",
             "give the [[side]] there kind = \"symmetry\"");
    }
  }

  const scene::Scene& scene_;
  tables::Diagnosis& diagnosis_;
  double weight_ = 0.0;  // [m/s2] of the ground at rest
  GroundScene found_;
};

// The kinds are told by the same words in the same order.
static_assert(names::side.size() == scene::names::outline.size() &&
              std::ranges::equal(names::side, scene::names::outline));
static_assert(std::ranges::equal(names::sought, scene::names::sought));

}  // namespace

bool is_scene_of_both(std::string_view text) {
  return is_ground_scene(text) && tables::has_table(text, "geometry");
}

std::optional<GroundScene> ground_of_scene(const scene::Scene& scene,
                                           tables::Diagnosis& diagnosis) {
  if (scene.geometry.dimension != 2) {
    diagnosis.error("geometry.dimension", "found 3", "fpm-limit's ground is plane");
    return std::nullopt;
  }
  GroundScene ground = Reader(scene, diagnosis).ground();
  if (!diagnosis.errors().empty()) return std::nullopt;
  return ground;
}

}  // namespace limit::ground
