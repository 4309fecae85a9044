#pragma once

#include "scene/scene.hpp"
#include "tables/builder.hpp"

namespace scene {

/// Adds the keys of a contact to the table of what has one.
template <class Root, class Struct>
tables::TableBuilder<Root, Struct>& with_contact(tables::TableBuilder<Root, Struct>& table) {
  return table
      .key("friction_angle", [](auto& of) -> auto& { return of.contact.friction_angle; },
           {.unit = "deg",
            .range = {0.0, 90.0, false, true},
            .doc = "contact: of the face, delta; with adhesion 0, 0 is smooth."})
      .key("adhesion", [](auto& of) -> auto& { return of.contact.adhesion; },
           {.unit = "Pa",
            .range = tables::at_least(0.0),
            .doc = "contact: shear strength of the face without pressure."})
      .key("tension", [](auto& of) -> auto& { return of.contact.tension; },
           {.doc = "contact: true: the face bears tension across; false: it opens."})
      .key("stiffness_factor", [](auto& of) -> auto& { return of.contact.stiffness_factor; },
           {.need = tables::Need::optional,
            .range = tables::positive(),
            .doc = "tied and contact: stiffness of the face over the softer Young's modulus per "
                   "spacing, or, between elastic materials of a Poisson's ratio above 0.45, over "
                   "the softer modulus of confined compression; the gap falls as its inverse, the "
                   "number of evaluations grows with it.",
            .absent =
                "100 between elastic materials, 10 where one yields, 1 below a plate that turns "
                "or is loaded there"});
}

}  // namespace scene
