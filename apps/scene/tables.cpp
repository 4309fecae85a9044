#include "scene/tables.hpp"

#include "scene/scene.hpp"

namespace scene {

const std::vector<SceneTable>& scene_tables() {
  static const std::vector<SceneTable> tables = [] {
    std::vector<SceneTable> all;
    for (auto part :
         {body_tables, ground_tables, loading_tables, stage_tables, measure_tables, run_tables}) {
      for (SceneTable& table : part()) all.push_back(std::move(table));
    }
    return all;
  }();
  return tables;
}

}  // namespace scene
