#include "bodies.hpp"

#include <filesystem>
#include <stdexcept>

#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace benchmarks {

std::vector<Body> bodies() {
  const std::string footing = "footing.toml";
  const std::string incremental = "hourglass.control=incremental";
  const std::string mixed = "hourglass.control=mixed";
  const std::string jitter = "geometry.jitter=0.2";
  const std::string fine = "geometry.spacing=0.005";
  constexpr double three_percent = 0.2;  // of B, where the scene's target is 15 %
  return {
      {"footing-incremental", footing, {incremental}},
      {"footing-mixed", footing, {mixed}},
      {"footing-jitter-incremental", footing, {incremental, jitter}, three_percent},
      {"footing-jitter-mixed", footing, {mixed, jitter}, three_percent},
      {"footing-fine-incremental", footing, {incremental, fine}, three_percent},
      {"footing-fine-mixed", footing, {mixed, fine}, three_percent},
      {"block3d",
       "block3d.toml",
       {"geometry.spacing=0.0625", "approximation.kinematics=finite_strain", "programme.steps=100"},
       0.1},
  };
}

Body body_named(std::string_view name) {
  std::string known;
  for (const Body& body : bodies()) {
    if (body.name == name) return body;
    known += ' ' + body.name;
  }
  throw std::invalid_argument("no body \"" + std::string(name) + "\"; there are" + known);
}

std::shared_ptr<const scene::Scene> scene_of(const Body& body) {
  const auto reading =
      scene::read_scene(std::filesystem::path(FPM_SCENES) / body.scene, body.settings);
  if (reading.scene) return reading.scene;
  std::string complaints = body.name + " is refused:";
  for (const auto& complaint : reading.errors) complaints += '\n' + complaint.text();
  throw std::runtime_error(complaints);
}

int dimension_of(const scene::Scene& scene) {
  return scene.geometry.dimension;
}

double coarse_spacing_of(const scene::Scene& scene) {
  return scene.solver.coarse_spacing_over_spacing;
}

}  // namespace benchmarks
