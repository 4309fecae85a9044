#include "study/varied_scene.hpp"

#include "scene/reader.hpp"

namespace study {

std::shared_ptr<const scene::Scene> read_varied(const std::filesystem::path& file,
                                                std::vector<std::string> settings,
                                                const std::vector<std::string>& more,
                                                std::ostream& err) {
  settings.insert(settings.end(), more.begin(), more.end());
  const scene::SceneReading reading = scene::read_scene(file, settings);
  for (const tables::Complaint& complaint : reading.errors) {
    err << "error: " << complaint.text() << '\n';
  }
  return reading.scene;
}

}  // namespace study
