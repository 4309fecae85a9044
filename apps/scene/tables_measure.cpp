#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "tables/builder.hpp"

namespace scene {

namespace {

SceneTable measure() {
  return tables::TableBuilder<Scene, Measure>(
             "measure", &Scene::measure,
             "Columns of the curve beside those of the drive, one per component. Without any, a "
             "run "
             "whose drive is no displacement has the reactions of its supports and the largest "
             "displacement.")
      .key("name", &Measure::name,
           {.need = tables::Need::required,
            .doc = "Unique; its columns begin with it, so letters, digits and _ only."})
      .key("kind", &Measure::kind,
           {.need = tables::Need::required,
            .doc = "displacement or stress at a point, interpolated linearly, or extrapolated up "
                   "to a face, by the particles of one material around it, that of the region the "
                   "point is in, or, if these are too few, of the nearest; the mean stress, where "
                   "poissons_ratio is above 0.45, from twice as far around; next to a wall whose "
                   "traction is known, stress as their displacements and that traction say, where "
                   "the ground is elastic and the wall smooth, or as that traction and its "
                   "strength, where "
                   "it yields; particle_stress or plastic_strain of the particle nearest to a "
                   "point; reaction, the force of a "
                   "support on the body; resultant, the force on the body at a side, of supports, "
                   "drive and tractions; "
                   "max_displacement, the length of the largest one."})
      .key("at", &Measure::at,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "The point, in the initial configuration.",
            .absent = "only of kinds without a point"})
      .key("support", &Measure::support,
           {.need = tables::Need::optional,
            .doc = "Name of the support.",
            .absent = "only without a reaction"})
      .key("side", &Measure::side,
           {.need = tables::Need::optional,
            .doc = "left x-, right x+, bottom y-, top y+, front z-, back z+.",
            .absent = "only without a resultant"})
      .build();
}

}  // namespace

std::vector<SceneTable> measure_tables() {
  return {measure()};
}

}  // namespace scene
