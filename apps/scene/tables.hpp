#pragma once

#include <vector>

#include "tables/table.hpp"

namespace scene {

/// Every table and key a scene may have, in the order they are printed: parsing, --set, validation,
/// --print-effective and the reference all walk this list.
[[nodiscard]] const std::vector<tables::TableInfo>& scene_tables();

// One per group of tables; `scene_tables` joins them.
[[nodiscard]] std::vector<tables::TableInfo> body_tables();
[[nodiscard]] std::vector<tables::TableInfo> loading_tables();
[[nodiscard]] std::vector<tables::TableInfo> run_tables();

}  // namespace scene
