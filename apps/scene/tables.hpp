#pragma once

#include <vector>

#include "tables/field.hpp"

namespace scene {

struct Scene;
using SceneTable = tables::Table<Scene>;

/// Every table and key a scene may have, in the order they are printed: parsing, --set, validation,
/// --print-effective and the reference all walk this list.
[[nodiscard]] const std::vector<SceneTable>& scene_tables();

// One per group of tables; `scene_tables` joins them.
[[nodiscard]] std::vector<SceneTable> body_tables();
[[nodiscard]] std::vector<SceneTable> ground_tables();
[[nodiscard]] std::vector<SceneTable> loading_tables();
[[nodiscard]] std::vector<SceneTable> stage_tables();
[[nodiscard]] std::vector<SceneTable> measure_tables();
[[nodiscard]] std::vector<SceneTable> run_tables();

}  // namespace scene
