#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

// Range of Poisson's ratio in isotropic elasticity: positive bulk and shear moduli.
constexpr tables::Range poisson_range{-1.0, 0.5, true, true};
constexpr tables::Range angle_range{0.0, 90.0, false, true};

SceneTable top_level() {
  return tables::TableBuilder<Scene, Scene>("The scene as a whole.")
      .key("title", &Scene::title, {.doc = "One line that names the run in logs and files."})
      .build();
}

SceneTable geometry() {
  return tables::TableBuilder<Scene, Geometry>("geometry", &Scene::geometry,
                                               "The body: a box filled by a lattice of particles.")
      .required()
      .key("dimension", &Geometry::dimension,
           {.need = tables::Need::required,
            .range = tables::between(2, 3),
            .doc = "2 is plane strain, per metre out of the plane."})
      .key("min", &Geometry::min,
           {.need = tables::Need::required,
            .unit = "m",
            .doc = "Lower corner, one entry per dimension."})
      .key("max", &Geometry::max,
           {.need = tables::Need::required, .unit = "m", .doc = "Upper corner; y points up."})
      .key("spacing", &Geometry::spacing,
           {.need = tables::Need::required,
            .unit = "m",
            .range = tables::positive(),
            .doc = "Distance between particles; divides every extent a whole number of times."})
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
      .key("consistency", &Approximation::consistency,
           {.doc = "Correction that makes nodal integration pass the patch test; auto: on for "
                   "jittered sets, off for lattices (whose rows then share stencils, which is "
                   "faster)."})
      .key("kinematics", &Approximation::kinematics,
           {.doc = "finite_strain: updated Lagrangian, Hughes-Winget. small_strain: geometrically "
                   "linear, for comparison with limit loads and beam theory.",
            .source = "Chen, Huang & Lyamin 2020, Eq. 32-38"})
      .build();
}

SceneTable material() {
  return tables::TableBuilder<Scene, Material>(
             "material", &Scene::material,
             "A material. The first fills the body; each later one has a region "
             "and wins inside it over the earlier ones.")
      .required()
      .key("name", &Material::name,
           {.need = tables::Need::required,
            .doc = "Unique; serves messages and --set material.NAME.key."})
      .key(
          "model", &Material::model,
          {.need = tables::Need::required,
           .doc = "von_mises: undrained clay, strength = cohesion. drucker_prager: cone matched to "
                  "Mohr-Coulomb. mohr_coulomb: true corners.",
           .source = "Chen, Huang & Lyamin 2020, section 4.2 (Drucker-Prager)"})
      .key("youngs_modulus", &Material::youngs_modulus,
           {.need = tables::Need::required,
            .unit = "Pa",
            .range = tables::positive(),
            .doc = "Young's modulus E."})
      .key("poissons_ratio", &Material::poissons_ratio,
           {.need = tables::Need::required, .range = poisson_range, .doc = "Poisson's ratio nu."})
      .key("cohesion", &Material::cohesion,
           {.need = tables::Need::optional,
            .unit = "Pa",
            .range = tables::at_least(0.0),
            .doc = "Cohesion c.",
            .absent = "only for elastic"})
      .key("friction_angle", &Material::friction_angle,
           {.need = tables::Need::optional,
            .unit = "deg",
            .range = angle_range,
            .doc = "Friction angle phi.",
            .absent = "only for elastic and von_mises"})
      .key("dilation_angle", &Material::dilation_angle,
           {.need = tables::Need::optional,
            .unit = "deg",
            .range = angle_range,
            .doc = "Dilation angle psi, at most phi; psi = phi is associated flow.",
            .absent = "only for elastic and von_mises"})
      .key("density", &Material::density,
           {.unit = "kg/m3", .range = tables::at_least(0.0), .doc = "Mass per initial volume."})
      .key("dilation_cutoff", &Material::dilation_cutoff,
           {.need = tables::Need::optional,
            .range = tables::at_least(0.0),
            .doc = "Accumulated plastic volume strain at which dilation stops; 0 is never.",
            .absent = "never"})
      .key("match", &Material::match,
           {.doc = "Which Mohr-Coulomb states the Drucker-Prager cone meets; plane_strain holds in "
                   "2D only."})
      .key("region_min", &Material::region_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower corner of the material's box.",
            .absent = "everywhere"})
      .key("region_max", &Material::region_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper corner of the material's box.",
            .absent = "everywhere"})
      .build();
}

SceneTable hourglass() {
  return tables::TableBuilder<Scene, Hourglass>(
             "hourglass", &Scene::hourglass,
             "Control of the zero-energy modes of nodal integration.")
      .key("control", &Hourglass::control,
           {.doc =
                "viscosity: the paper's, for reproduction. stiffness: elastic bodies; locks when "
                "they yield. incremental: cheap, biases collapse loads at first order in spacing. "
                "mixed: sub-points with one pressure plus a weak incremental control; collapse "
                "loads converge. auto: stiffness if all is elastic, mixed in 2D for von_mises and "
                "drucker_prager, else incremental.",
            .source = "viscosity: Chen, Huang & Lyamin 2020, Eq. 15-20"})
      .key("stiffness_ratio", &Hourglass::stiffness_ratio,
           {.need = tables::Need::optional,
            .range = tables::between(0.0, 1.0),
            .doc = "gamma: control stiffness over Young's modulus.",
            .absent = "0.1 for stiffness and incremental, 0.01 for mixed"})
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
  return {top_level(), geometry(), approximation(), material(), hourglass()};
}

}  // namespace scene
