#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "scene/tables_contact.hpp"
#include "scene/tables_drive.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

SceneTable symmetry() {
  return tables::TableBuilder<Scene, Symmetry>(
             "symmetry", &Scene::symmetry,
             "A mirror at a face of the box: ghost particles behind it make it a "
             "true symmetry plane. Layout cell only.")
      .key("axis", &Symmetry::axis,
           {.need = tables::Need::required, .doc = "Normal of the mirror."})
      .key("position", &Symmetry::position,
           {.need = tables::Need::required,
            .unit = "m",
            .doc = "Coordinate of the mirror along its axis: the box's lower or upper face."})
      .build();
}

SceneTable support() {
  tables::TableBuilder<Scene, Support> table("support", &Scene::support,
                                             "Particles that stay where they are in some "
                                             "directions, chosen by exactly one of side, region "
                                             "and at.");
  table
      .key("name", &Support::name,
           {.need = tables::Need::required, .doc = "Unique; serves messages."})
      .key("side", &Support::side,
           {.need = tables::Need::optional,
            .doc = "The particles next to a face: left x-, right x+, bottom y-, top y+, front z-, "
                   "back z+.",
            .absent = "region or at chooses"})
      .key("region_min", &Support::region_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower corner of a box of particles.",
            .absent = "side or at chooses"})
      .key("region_max", &Support::region_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper corner of a box of particles.",
            .absent = "side or at chooses"})
      .key("at", &Support::at,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "The one particle nearest to this point.",
            .absent = "side or region chooses"})
      .key("directions", &Support::directions,
           {.need = tables::Need::required,
            .doc = "Displacement components that are zero; contact: the one across the side."})
      .key("method", &Support::method,
           {.doc = "direct: the displacements of the particles next to the side are given. ghosts: "
                   "the body goes on in images behind the side, which is held itself. penalty: the "
                   "side is held by stiff springs. contact: the body lies against the side, "
                   "slides by Coulomb's law and, without tension, opens. auto: ghosts for a side "
                   "that is held across, layout cell; else, on a side the drive moves and under "
                   "viscosity, direct.",
            .source = "penalty: Chen, Huang & Lyamin 2020, Eq. 3-4"})
      .key("penalty_factor", &Support::penalty_factor,
           {.range = tables::positive(),
            .doc = "Penalty stiffness over Young's modulus; the displacement error falls as its "
                   "inverse, the solver's condition grows with it."});
  return with_contact(table).build();
}

SceneTable traction() {
  return tables::TableBuilder<Scene, Traction>("traction", &Scene::traction,
                                               "A force per area on a part of one face.")
      .key("name", &Traction::name,
           {.need = tables::Need::required, .doc = "Unique; serves messages."})
      .key("side", &Traction::side,
           {.need = tables::Need::required,
            .doc = "left x-, right x+, bottom y-, top y+, front z-, back z+."})
      .key("range_min", &Traction::range_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Lower end along the side; in 3D two entries, in the order x, y, z.",
            .absent = "the whole side"})
      .key("range_max", &Traction::range_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Upper end along the side.",
            .absent = "the whole side"})
      .key("value", &Traction::value,
           {.need = tables::Need::required,
            .unit = "Pa",
            .doc = "Components in space: [0, -1] presses down."})
      .key("follower", &Traction::follower,
           {.doc = "true: area and normal follow the deformation; false: dead load on the initial "
                   "area.",
            .source = "Chen, Huang & Lyamin 2020, Eq. 3-12"})
      .build();
}

SceneTable gravity() {
  return tables::TableBuilder<Scene, Gravity>("gravity", &Scene::gravity, "Weight.")
      .key("acceleration", &Gravity::acceleration,
           {.need = tables::Need::optional,
            .unit = "m/s2",
            .doc = "Components in space, [0, -9.81] on earth.",
            .absent = "weightless"})
      .build();
}

tables::FieldNotes of_uniform(std::string_view doc, std::string_view absent) {
  return {.need = tables::Need::optional, .unit = "Pa", .doc = doc, .absent = absent};
}

SceneTable initial_stress() {
  return tables::TableBuilder<Scene, InitialStress>("initial_stress", &Scene::initial_stress,
                                                    "The stress before the first step.")
      .key("kind", &InitialStress::kind,
           {.doc =
                "geostatic: vertical stress from the weight above, horizontal stress K0 times it, "
                "both effective under a water table, which is level then, as are layers of another "
                "weight or K0; sides of regions must bear it. "
                "gravity: what is left when weight and dead loads, or without weight these alone, "
                "have "
                "been switched on, of a body of any shape; so with pressures where the ground goes "
                "on it is the stress in the depth. "
                "uniform: one stress everywhere, sigma_x and so on, of ground without weight; what "
                "it presses on every side must be borne by a support, a mirror or a load. "
                "fpm-limit ignores it, and refuses loaded_sides: collapse does not depend "
                "on it."})
      .key("surface", &InitialStress::surface,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "Level y where the weight above is zero.",
            .absent = "the top of the body"})
      .key("K0", &InitialStress::K0,
           {.need = tables::Need::optional,
            .range = tables::at_least(0.0),
            .doc = "Horizontal over vertical stress, effective ones; with gravity as far as the "
                   "ground bears it, which is then brought to equilibrium.",
            .absent = "geostatic: nu / (1 - nu), laterally confined elasticity; gravity: what "
                      "is left"})
      .key("K0_z", &InitialStress::K0_z,
           {.need = tables::Need::optional,
            .range = tables::at_least(0.0),
            .doc = "The same along z: out of the plane, or of the second horizontal axis.",
            .absent = "K0"})
      .key("surcharge", &InitialStress::surcharge,
           {.unit = "Pa",
            .range = tables::at_least(0.0),
            .doc = "Pressure on the surface that the initial stress already carries."})
      .key("sigma_x", &InitialStress::sigma_x,
           of_uniform("uniform: normal stress along x, < 0 if it presses.", "only without uniform"))
      .key("sigma_y", &InitialStress::sigma_y,
           of_uniform("uniform: normal stress along y, likewise.", "only without uniform"))
      .key("sigma_z", &InitialStress::sigma_z,
           of_uniform("uniform: normal stress along z, likewise.",
                      "nu (sigma_x + sigma_y) of each material, as of plane strain; in 3D only "
                      "without uniform"))
      .key("sigma_xy", &InitialStress::sigma_xy,
           of_uniform("uniform: shear stress, > 0 if the top is pulled along +x.", "none"))
      .key("sigma_yz", &InitialStress::sigma_yz,
           of_uniform("uniform: shear stress, in 3D.", "none"))
      .key("sigma_zx", &InitialStress::sigma_zx,
           of_uniform("uniform: shear stress, in 3D.", "none"))
      .key("loaded_sides", &InitialStress::loaded_sides,
           {.need = tables::Need::optional,
            .doc = "uniform: names of [[side]]s, of cutouts or of faces of the box beyond which "
                   "the ground goes on: they are loaded by what this stress presses and shears "
                   "them with, throughout, as by a dead load.",
            .absent = "none"})
      .build();
}

SceneTable drive() {
  tables::TableBuilder<Scene, Drive> table("drive", &Scene::drive,
                                           "What is moved or loaded, and how far.");
  return with_drive(table)
      .key("weakened", &Drive::weakened,
           {.need = tables::Need::optional,
            .doc = "strength, and stages with a reduction: names of the materials whose strength "
                   "is divided, and with it that of the faces by contact that they have, and the "
                   "cohesion at which tied clay slides.",
            .absent = "all"})
      .build();
}

}  // namespace

std::vector<SceneTable> loading_tables() {
  return {symmetry(), support(), traction(), gravity(), initial_stress(), drive()};
}

}  // namespace scene
