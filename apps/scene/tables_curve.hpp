#pragma once

#include "scene/scene.hpp"
#include "tables/builder.hpp"

namespace scene {

/// Adds the keys of curved envelopes to the table of materials.
void add_curved_strength(tables::TableBuilder<Scene, Material>& table);

}  // namespace scene
