#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "scene/tables_drive.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

tables::TableBuilder<Scene, Stage>& with_ground(tables::TableBuilder<Scene, Stage>& table) {
  return table
      .key("remove", &Stage::remove,
           {.need = tables::Need::optional,
            .doc = "Names of regions that are taken away; what they bore fades in the stage's "
                   "steps.",
            .absent = "none"})
      .key("place", &Stage::place,
           {.need = tables::Need::optional,
            .doc = "Names of regions that are put down without stress, and whose weight grows in "
                   "the stage's steps. What is put down before it was taken away is not there at "
                   "first.",
            .absent = "none"})
      .key("release", &Stage::release,
           {.need = tables::Need::optional,
            .doc =
                "Names of supports and drives that end; what they bore, or the load they had come "
                "to, fades in the stage's steps.",
            .absent = "none"})
      .key("hold", &Stage::hold,
           {.need = tables::Need::optional,
            .doc = "Names of supports that begin, where the ground then is. What holds before it "
                   "was released does not at first.",
            .absent = "none"})
      .key("water_table", &Stage::water_table,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "The water table from then on, in place of water.table.",
            .absent = "as it was"})
      .key("pore_pressure", &Stage::pore_pressure,
           {.need = tables::Need::optional,
            .unit = "Pa",
            .doc = "The pore pressure from then on, in place of water.pore_pressure.",
            .absent = "as it was"})
      .key("kh", &Stage::kh,
           {.need = tables::Need::optional,
            .doc = "Of an earthquake from then on, in place of load.kh: horizontal weight over "
                   "weight, which comes in the stage's steps; 0 ends it.",
            .absent = "as it was"})
      .key("kv", &Stage::kv,
           {.need = tables::Need::optional,
            .range = {.lower = -1.0, .upper = 1.0, .upper_open = true},
            .doc = "Likewise, in place of load.kv: the share of the weight that it lifts.",
            .absent = "as it was"});
}

tables::TableBuilder<Scene, Stage>& with_materials(tables::TableBuilder<Scene, Stage>& table) {
  return table
      .key("materials", &Stage::materials,
           {.need = tables::Need::optional,
            .doc = "Names of materials whose strength changes, to one value of each list below. "
                   "What a stress has too much then fades in the stage's steps.",
            .absent = "none"})
      .key("cohesion", &Stage::cohesion,
           {.need = tables::Need::optional,
            .unit = "Pa",
            .doc = "Of each of materials.",
            .absent = "as it was"})
      .key("friction_angle", &Stage::friction_angle,
           {.need = tables::Need::optional,
            .unit = "deg",
            .doc = "Of each of materials.",
            .absent = "as it was"})
      .key("dilation_angle", &Stage::dilation_angle,
           {.need = tables::Need::optional,
            .unit = "deg",
            .doc = "Of each of materials.",
            .absent = "as it was"})
      .key("regions", &Stage::regions,
           {.need = tables::Need::optional,
            .doc = "Names of regions whose material changes, to one each of become. Their ground "
                   "keeps its stress, without what the former had hardened, and goes on by the new "
                   "law; weight and strength that it gains or loses come or fade in the stage's "
                   "steps.",
            .absent = "none"})
      .key("become", &Stage::become,
           {.need = tables::Need::optional,
            .doc = "Names of the materials that regions are made of from then on, one for each.",
            .absent = "only without regions"});
}

SceneTable stage() {
  tables::TableBuilder<Scene, Stage> table(
      "stage", &Scene::stage,
      "A part of a run: what changes at its beginning, and how far the drive then goes, there or "
      "back. Stages follow each other; a run goes on from the end of any of them (--from-stage).");
  table
      .key("name", &Stage::name,
           {.need = tables::Need::required, .doc = "Unique; serves messages and --from-stage."})
      .key("to", &Stage::to,
           {.need = tables::Need::optional,
            .unit = "m, or factor",
            .doc = "Where the drive is at the stage's end: the displacement along its direction, "
                   "or what the loads that grow are multiplied by. Less than before is unloading.",
            .absent = "where it was; a drive that begins goes to its target, or to 1"})
      .key("reduction", &Stage::reduction,
           {.need = tables::Need::optional,
            .range = tables::positive(),
            .doc = "What cohesion and tan(phi) of the materials drive.weakened are divided by at "
                   "the stage's end.",
            .absent = "as it was"})
      .key("steps", &Stage::steps,
           {.need = tables::Need::optional,
            .range = tables::at_least(1),
            .doc = "Nominal number of equal steps.",
            .absent = "programme.steps, or for a displacement increment_over_spacing"})
      .key("fades", &Stage::fades,
           {.range = tables::between(0.0, 1.0),
            .doc = "Share of what the changes leave unbalanced, as on the face of an excavation, "
                   "that has faded at the stage's end; the rest goes on to the next one, which may "
                   "begin with a lining."});
  tables::TableBuilder<Drive, Drive> drive("");
  with_materials(with_ground(table))
      .within("drive", &Stage::drive, with_drive(drive, true).build(),
              "As in [drive], from this stage on. The one before stays where it is, unless it is "
              "released. "
              "A name alone goes on with the drive of that name.",
              "as in [drive]");
  return table.build();
}

}  // namespace

std::vector<SceneTable> stage_tables() {
  return {stage()};
}

}  // namespace scene
