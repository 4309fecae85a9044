#include "scene/tables.hpp"

namespace scene {

const std::vector<tables::TableInfo>& scene_tables() {
  static const std::vector<tables::TableInfo> tables = [] {
    std::vector<tables::TableInfo> all;
    for (auto part : {body_tables, loading_tables, run_tables}) {
      for (tables::TableInfo& table : part()) all.push_back(std::move(table));
    }
    return all;
  }();
  return tables;
}

}  // namespace scene
