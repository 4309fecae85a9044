#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "constitutive/parameters.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "scene/tables_contact.hpp"
#include "scene/tables_curve.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

/// What libconstitutive says of a parameter.
tables::FieldNotes notes_of(std::string_view name, tables::Need need,
                            std::string_view absent = "") {
  const constitutive::ParameterInfo& info = constitutive::parameter_info(name);
  return {.need = need,
          .unit = info.unit,
          .range = {info.lower, info.upper, info.lower_open, info.upper_open},
          .doc = info.doc,
          .absent = absent};
}

/// `only for elastic and von_mises`: whose parameter it is not. Kept for good, as notes are views.
tables::FieldNotes notes_of_strength(std::string_view name) {
  static std::map<std::string_view, std::string> kept;
  std::string& absent = kept[name];
  absent.clear();
  for (const constitutive::ModelInfo& model : constitutive::material_models()) {
    if (constitutive::parameter_info(name).is_used_by(model)) continue;
    absent += (absent.empty() ? "only for " : " and ") + std::string(model.family);
  }
  return notes_of(name, tables::Need::optional, absent);
}

constexpr std::string_view without_critical_states = "only without modified_cam_clay";

tables::FieldNotes notes_of_critical_states(std::string_view name) {
  return notes_of(name, tables::Need::optional, without_critical_states);
}

/// Each name once, in the order of the models.
std::vector<std::string_view> names_of_models(std::string_view constitutive::ModelInfo::*name) {
  std::vector<std::string_view> all;
  for (const constitutive::ModelInfo& model : constitutive::material_models()) {
    const std::string_view one = model.*name;
    if (!one.empty() && std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
  }
  return all;
}

std::string_view doc_of_models() {
  static const std::string doc = [] {
    std::string all;
    for (const constitutive::ModelInfo& model : constitutive::material_models()) {
      if (model.doc.empty()) continue;
      all += fmt::format("{}{}: {}.", all.empty() ? "" : " ", model.family, model.doc);
    }
    return all;
  }();
  return doc;
}

SceneTable top_level() {
  return tables::TableBuilder<Scene, Scene>("The scene as a whole.")
      .key("title", &Scene::title, {.doc = "One line that names the run in logs and files."})
      .build();
}

SceneTable geometry() {
  return tables::TableBuilder<Scene, Geometry>(
             "geometry", &Scene::geometry,
             "The body: a box filled by a lattice of particles, or "
             "the regions in it.")
      .required()
      .key(
          "dimension", &Geometry::dimension,
          {.range = tables::between(2, 3), .doc = "2 is plane strain, per metre out of the plane."})
      .key("min", &Geometry::min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower corner, one entry per dimension.",
            .absent = "the lower corner of the regions"})
      .key("max", &Geometry::max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper corner; y points up.",
            .absent = "that of the regions, a whole number of spacings above min"})
      .key("depth", &Geometry::depth,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "From and to along z, of regions of polygons in dimension 3, which are prisms "
                   "then; a whole number of spacings. Their two ends are the faces front and back "
                   "of the box.",
            .absent = "regions are plane or volumes of a mesh"})
      .key("spacing", &Geometry::spacing,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "Distance between particles, where they are graded the finest; divides every "
                   "extent a whole number of times. Needed, unless particles are the elements of a "
                   "mesh.",
            .absent = "that of the finest elements"})
      .key(
          "layout", &Geometry::layout,
          {.doc = "cell: particles at cell centres, half a spacing inside the boundary, all of one "
                  "volume. vertex: particles on the boundary as well, with tributary volumes."})
      .key("jitter", &Geometry::jitter,
           {.unit = "of spacing",
            .range = tables::between(0.0, 0.4),
            .doc = "Largest random shift of an inner particle; makes the set irregular."})
      .key("seed", &Geometry::seed,
           {.range = tables::at_least(0),
            .doc = "Seed of the jitter: the same seed gives the same set."})
      .build();
}

SceneTable cutout() {
  return tables::TableBuilder<Scene, Cutout>(
             "cutout", &Scene::cutout,
             "What is cut out of the box: a polygon or a circle, or what lies outside one. Plane "
             "bodies with the layout cell only.")
      .key("name", &Cutout::name,
           {.need = tables::Need::required,
            .doc = "Unique; serves messages and, where it holds the body, reactions."})
      .key(
          "outline", &Cutout::outline,
          {.need = tables::Need::optional,
           .unit = "m",
           .doc = "Corners of a polygon, either way around, [[x, y], ...]; it may reach beyond the "
                  "box.",
           .absent = "a circle"})
      .key("centre", &Cutout::centre,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Centre of a circle.",
            .absent = "an outline"})
      .key("radius", &Cutout::radius,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "Radius of the circle, followed to a thousandth of geometry.spacing.",
            .absent = "an outline"})
      .key("outside", &Cutout::outside,
           {.doc = "true: what lies outside is cut away, and the body is within."})
      .key(
          "kind", &Cutout::kind,
          {.doc = "Of the surface that is left. free: only pressure and shear act on it. fixed: it "
                  "is held. roller: it is held across, and free along."})
      .key("pressure", &Cutout::pressure,
           {.unit = "Pa",
            .doc = "free: pressure on the body, a dead load; grows with traction in drive.scales."})
      .key("shear", &Cutout::shear,
           {.unit = "Pa",
            .doc = "free: traction along the surface, in the direction that has the body to its "
                   "left; likewise."})
      .build();
}

SceneTable grading() {
  return tables::TableBuilder<Scene, Grading>(
             "grading", &Scene::grading,
             "Particles that are fine where it matters and coarse elsewhere: those of a balanced "
             "tree of cells 1, 2, 4, ... spacings wide.")
      .key("enabled", &Grading::enabled,
           {.doc = "true: finest at the ends of plates and loads, at re-entrant corners of "
                   "regions, at cutouts, holes and hollow arcs, and at the places of [[refine]]."})
      .key("growth", &Grading::growth,
           {.need = tables::Need::optional,
            .range = {0.0, 1.0, true, false},
            .doc = "A: at a distance r from the nearest such place the spacing is at most "
                   "A L (r / L)^exponent.",
            .absent = "1/8; in the plane where nothing yields at most sqrt(spacing / length), as "
                      "errors there are those of the coarse cells"})
      .key("exponent", &Grading::exponent,
           {.range = tables::between(0.0, 1.0),
            .doc =
                "1/2 to 2/3 are best for the singular stress at a plate's end; 1 grows linearly."})
      .key("length", &Grading::length,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "L of that rule.",
            .absent = "drive.reference_length, or the shortest extent"})
      .key("coarsest", &Grading::coarsest,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "Largest spacing anywhere.",
            .absent = "an eighth of the shortest extent"})
      .build();
}

SceneTable refine() {
  return tables::TableBuilder<Scene, Refine>("refine", &Scene::refine,
                                             "A place where graded particles are fine.")
      .key("side", &Refine::side,
           {.need = tables::Need::optional, .doc = "A side of the box.", .absent = "no side"})
      .key("range_min", &Refine::range_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower end along the side; in 3D two entries.",
            .absent = "the whole side"})
      .key("range_max", &Refine::range_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper end along the side.",
            .absent = "the whole side"})
      .key("region_min", &Refine::region_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower corner of a box.",
            .absent = "no region"})
      .key("region_max", &Refine::region_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper corner of the box.",
            .absent = "no region"})
      .key("at", &Refine::at,
           {.need = tables::Need::optional, .unit = "m", .doc = "A point.", .absent = "no point"})
      .key("spacing", &Refine::spacing,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "Spacing there, rounded down to geometry.spacing times a power of two.",
            .absent = "geometry.spacing"})
      .key("radius", &Refine::radius,
           {.unit = "m",
            .range = tables::at_least(0.0),
            .doc = "Distance from the place up to which particles are as fine; in finite strain at "
                   "least as far as what is driven there will move."})
      .build();
}

SceneTable approximation() {
  return tables::TableBuilder<Scene, Approximation>(
             "approximation", &Scene::approximation,
             "How fields are approximated between particles.")
      .key("kernel", &Approximation::kernel,
           {.doc = "Weight function of the corrected kernel.",
            .source = "Chen, Huang & Lyamin 2020, Eq. 1-2 (cubic spline)"})
      .key(
          "support_over_spacing", &Approximation::support_over_spacing,
          {.range = tables::between(1.5, 4.0),
           .doc = "Support radius R over spacing; for the cubic spline R is two smoothing lengths.",
           .source = "1.2 smoothing lengths per spacing, as in the paper"})
      .key(
          "consistency", &Approximation::consistency,
          {.doc = "Correction that makes nodal integration pass the patch test, of rows whose "
                  "neighbourhoods are cut or irregular; auto: on for jittered and graded sets, for "
                  "bodies with cutouts, where sides are held by ghosts, and where materials are "
                  "bodies of their own."})
      .key("kinematics", &Approximation::kinematics,
           {.doc = "finite_strain: updated Lagrangian, Hughes-Winget. small_strain: geometrically "
                   "linear, for comparison with limit loads and beam theory.",
            .source = "Chen, Huang & Lyamin 2020, Eq. 32-38"})
      .key("interfaces", &Approximation::interfaces,
           {.doc = "Where two materials meet that no [[interface]] names. through: rows see both. "
                   "tied: each material is a body of its own, held to the other at its face, so "
                   "that stress may jump along it. contact: they only touch, without friction."})
      .build();
}

void add_changing_strength(tables::TableBuilder<Scene, Material>& table) {
  table
      .key("residual_strain", &Material::residual_strain,
           notes_of("residual_strain", tables::Need::optional, "the strength stays"))
      .key("residual_cohesion", &Material::residual_cohesion,
           notes_of("residual_cohesion", tables::Need::optional, "the cohesion"))
      .key("residual_friction_angle", &Material::residual_friction_angle,
           notes_of("residual_friction_angle", tables::Need::optional, "the friction_angle"))
      .key("compression_index", &Material::compression_index,
           notes_of_critical_states("compression_index"))
      .key("swelling_index", &Material::swelling_index, notes_of_critical_states("swelling_index"))
      .key("critical_stress_ratio", &Material::critical_stress_ratio,
           notes_of_critical_states("critical_stress_ratio"))
      .key("overconsolidation_ratio", &Material::overconsolidation_ratio,
           {.need = tables::Need::optional,
            .range = tables::at_least(1.0),
            .doc = "Preconsolidation over that at which the initial stress would just yield, at "
                   "every place.",
            .absent = without_critical_states});
}

SceneTable material() {
  tables::TableBuilder<Scene, Material> table(
      "material", &Scene::material,
      "A material. The first fills the body; each later one has a box "
      "and wins inside it over the earlier ones. Where there are [[region]]s, they say "
      "where it is. Stiffness, strength and weight may change from place to place: "
      "linearly; by a table, "
      "{ along = \"y\", table = [[y, value], ...] } or { below = level, table = [[depth, value], "
      "...] }, linear between its lines; by a raster, bilinear between the middles of its cells, "
      "{ raster = \"file.asc\" }, an ESRI ASCII grid, or with nearest = true of one value in each "
      "cell; or by points, { points = \"file.csv\" }, "
      "lines of x,y,value of which the nearest one counts. A table, too, may be a file, lines of "
      "coordinate,value. Files are sought from the scene's folder, their values multiplied by "
      "factor, if it is given; --print-effective shows what was read, which is another way of "
      "giving it. Tables and rasters reach over all of the material.");
  table.required()
      .key("name", &Material::name,
           {.need = tables::Need::required,
            .doc = "Unique; serves messages and --set material.NAME.key."})
      .key("model", &Material::model,
           {.need = tables::Need::required,
            .doc = doc_of_models(),
            .source = "Chen, Huang & Lyamin 2020, section 4.2 (Drucker-Prager)"})
      .among(names_of_models(&constitutive::ModelInfo::family))
      .key("youngs_modulus", &Material::youngs_modulus,
           notes_of("youngs_modulus", tables::Need::required))
      .key("poissons_ratio", &Material::poissons_ratio,
           notes_of("poissons_ratio", tables::Need::required))
      .key("cohesion", &Material::cohesion, notes_of_strength("cohesion"))
      .key("friction_angle", &Material::friction_angle, notes_of_strength("friction_angle"))
      .key("dilation_angle", &Material::dilation_angle, notes_of_strength("dilation_angle"))
      .key("density", &Material::density, notes_of("density", tables::Need::defaulted))
      .key("unit_weight", &Material::unit_weight,
           {.need = tables::Need::optional,
            .unit = "N/m3",
            .range = tables::at_least(0.0),
            .doc = "Weight per volume; density is this over gravity's acceleration, 9.81 m/s2 "
                   "down unless [gravity] says more.",
            .absent = "density says it"})
      .key("saturated_unit_weight", &Material::saturated_unit_weight,
           {.need = tables::Need::optional,
            .unit = "N/m3",
            .range = tables::positive(),
            .doc = "Weight per volume below the water table, that of the water in it included.",
            .absent = "the unit_weight"})
      .key("dilation_cutoff", &Material::dilation_cutoff,
           notes_of("dilation_cutoff", tables::Need::optional, "never"))
      .key("tension_cutoff", &Material::tension_cutoff,
           notes_of("tension_cutoff", tables::Need::optional, "none"));
  add_changing_strength(table);
  add_curved_strength(table);
  table
      .key("match", &Material::match,
           {.doc = "Which Mohr-Coulomb states the Drucker-Prager cone meets; plane_strain holds in "
                   "2D only."})
      .among(names_of_models(&constitutive::ModelInfo::match))
      .key("region_min", &Material::region_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower corner of the material's box.",
            .absent = "everywhere"})
      .key("region_max", &Material::region_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper corner of the material's box.",
            .absent = "everywhere"});
  return table.build();
}

SceneTable interface() {
  tables::TableBuilder<Scene, Interface> table(
      "interface", &Scene::interface,
      "What happens where two materials meet: on the faces of the lattice's cells between them. A "
      "material thinner than three particles goes with its neighbour. One that runs out into a tip "
      "too thin for rows of its own takes the nearest face that is tied by default with it: rows "
      "see "
      "through all of that face, and a warning says so; a contact, or what is given as tied, would "
      "be refused instead.");
  table
      .key("between", &Interface::between,
           {.need = tables::Need::required, .doc = "Names of the two materials."})
      .key("kind", &Interface::kind,
           {.doc = "through: one body. tied: two bodies held together; in small strain, clay "
                   "(von_mises, or phi = 0) slides where its cohesion is used up. contact: two "
                   "bodies that "
                   "slide by Coulomb's law and, without tension, open."});
  return with_contact(table).build();
}

SceneTable hourglass() {
  return tables::TableBuilder<Scene, Hourglass>(
             "hourglass", &Scene::hourglass,
             "Control of the zero-energy modes of nodal integration.")
      .key(
          "control", &Hourglass::control,
          {.doc =
               "viscosity: the paper's, for reproduction. stiffness: elastic bodies; locks when "
               "they yield. incremental: cheap; its stiffness biases collapse loads at first order "
               "in spacing. mixed: sub-points with one pressure plus a weak incremental control; "
               "collapse loads under a plate converge, narrow bands are borne too well. auto: "
               "stiffness if all is elastic, incremental under a load that grows and where a stage "
               "digs, fills, releases, floods, shakes or changes the ground, mixed in 2D "
               "where all that yields is von_mises or drucker_prager without tension cut-off or "
               "residual_strain, "
               "else "
               "incremental.",
           .source = "viscosity: Chen, Huang & Lyamin 2020, Eq. 15-20"})
      .key("stiffness_ratio", &Hourglass::stiffness_ratio,
           {.need = tables::Need::optional,
            .range = tables::between(0.0, 1.0),
            .doc = "gamma: control stiffness over Young's modulus.",
            .absent = "0.1 for stiffness and incremental, the former 0.03 in the plane where some "
                      "poissons_ratio is above 0.49, the latter 0.001 under a load that grows and "
                      "0.01 where a stage digs, fills, releases, floods, shakes or changes ground "
                      "that yields; 0.01 for mixed"})
      .key("modulus_factor", &Hourglass::modulus_factor,
           {.range = tables::positive(),
            .doc =
                "chi: where a particle yields, the control's modulus is chi sqrt(3 J2) / (plastic "
                "strain of the last step), kept between 1e-5 chi E and E."})
      .key(
          "viscosity", &Hourglass::viscosity,
          {.range = {0.0, 1.0, true, false},
           .doc = "theta = alpha ls / (c dt), per step; keep theta / steps near 0.01 or below: the "
                  "bias in elasticity is 0.7 theta / steps.",
           .source = "Chen, Huang & Lyamin 2020, Eq. 15-20"})
      .build();
}

}  // namespace

std::vector<SceneTable> body_tables() {
  return {top_level(),     geometry(), cutout(),    grading(),  refine(),
          approximation(), material(), interface(), hourglass()};
}

}  // namespace scene
