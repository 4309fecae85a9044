#pragma once

#include "scene/names.hpp"
#include "scene/scene.hpp"
#include "scene/tables_contact.hpp"
#include "tables/builder.hpp"

namespace scene {

/// Adds the keys of a plate that turns or is loaded.
template <class Root>
tables::TableBuilder<Root, Drive>& with_plate(tables::TableBuilder<Root, Drive>& table) {
  return table
      .key(
          "at", &Drive::at,
          {.need = tables::Need::optional,
           .unit = "m",
           .doc = "contact: where along the side the plate is pushed or loaded, and about which it "
                  "turns freely; in 3D two entries. Its rotation is meant to be small.",
           .absent = "the plate does not turn"})
      .key("force", &Drive::force,
           {.need = tables::Need::optional,
            .unit = "N/m, in 3D N",
            .doc =
                "load: components in space of the plate's force when it has grown; along the side "
                "only with lateral = \"free\" and a face that sticks.",
            .absent = "only without a loaded plate"});
}

/// Adds the keys of how a side is moved.
template <class Root>
tables::TableBuilder<Root, Drive>& with_motion(tables::TableBuilder<Root, Drive>& table) {
  return table
      .key("side", &Drive::side,
           {.doc = "displacement: the side that is moved; plate: the one it lies on."})
      .key("range_min", &Drive::range_min,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "displacement: lower end along the side; in 3D two entries.",
            .absent = "the whole side"})
      .key("range_max", &Drive::range_max,
           {.need = tables::Need::optional,
            .unit = "m",
            .doc = "displacement: upper end along the side.",
            .absent = "the whole side"})
      .key("direction", &Drive::direction,
           {.need = tables::Need::optional,
            .doc = "displacement: unit vector of the motion, [0, -1] is down.",
            .absent = "only without a displacement"})
      .key("lateral", &Drive::lateral,
           {.doc = "displacement: fixed (rough) or free (smooth) across the direction. "
                   "contact: fixed: the plate keeps its place along the side; free: it moves there "
                   "as the body lets it."})
      .key(
          "method", &Drive::method,
          {.doc =
               "displacement: direct: the displacements of the particles next to the side are "
               "given. ghosts: those of the side itself are, by images behind it. contact: a rigid "
               "plate pushes the side, which slides along it by Coulomb's law and, without "
               "tension, opens. tied: it sticks to the plate by stiff springs, or with lateral = "
               "\"free\" is held by them across. auto: ghosts with layout cell; for a side that is "
               "moved along itself alone, or held as well, under viscosity, and in stages for a "
               "drive that begins or comes back after the first, direct; for footings of "
               "[[side]]s that have no images, tied or contact."})
      .key("target", &Drive::target,
           {.unit = "m",
            .range = tables::at_least(0.0),
            .doc = "displacement: how far; the direction has the sign; with stages the largest "
                   "displacement of all, unless given. strength: the factor at the end, without "
                   "unit."});
}

/// Adds the keys of a drive, be it [drive] or that of a stage.
template <class Root>
tables::TableBuilder<Root, Drive>& with_drive(tables::TableBuilder<Root, Drive>& table,
                                              bool of_stage = false) {
  table
      .key("name", &Drive::name,
           {.doc = "By which stages release it, or go on with it, and of its columns in the curve. "
                   "Empty: drive, or the name of its stage."})
      .key("kind", &Drive::kind,
           {.doc = "displacement: particles of a side are moved. load: tractions or gravity grow "
                   "from 0 to their value. strength: cohesion and tan(phi) are divided by a factor "
                   "that grows from 1, in [drive] without stages. none: constant loads, one step; "
                   "of a stage: what was in force stays where it is, and nothing moves or grows. "
                   "[[stage]]s say how far."});
  if (of_stage) table.without("strength");
  with_motion(table)
      .key("scales", &Drive::scales,
           {.need = tables::Need::optional,
            .doc =
                "load: what grows; plate: the force on a rigid plate, method contact, that lies on "
                "a part of the side and sinks in.",
            .absent = "only without a load"})
      .key("loads", &Drive::loads,
           {.need = tables::Need::optional,
            .doc = "load, of traction: names of the [[traction]]s, loaded [[side]]s and "
                   "[[cutout]]s that grow.",
            .absent = "all that no other drive names"})
      .key("reference_length", &Drive::reference_length,
           {.need = tables::Need::optional,
            .unit = "m",
            .range = tables::positive(),
            .doc = "B of settlement_over_B in the curve: half width of a footing, height of a "
                   "sample.",
            .absent = "the largest extent of the body"})
      .key(
          "width", &Drive::width,
          {.need = tables::Need::optional,
           .unit = "m",
           .range = tables::positive(),
           .doc = "Mean pressure = reaction / width; of the modelled half if a symmetry halves the "
                  "plate. In 3D the loaded area [m2].",
           .absent = "only without a displacement"});
  return with_contact(with_plate(table));
}

}  // namespace scene
