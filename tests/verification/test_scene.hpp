#pragma once

#include <memory>
#include <string>
#include <vector>

namespace scene {
struct Scene;
}

namespace verification {

using Settings = std::vector<std::string>;

/// A checked scene. Only tests that look into it need to see its type.
class TestScene {
 public:
  explicit TestScene(scene::Scene checked);
  operator const scene::Scene&() const { return *scene_; }
  const scene::Scene* operator->() const { return scene_.get(); }

 private:
  std::shared_ptr<const scene::Scene> scene_;
};

/// A scene of share/scenes, with settings as --set takes them.
/// @throws std::runtime_error if it is refused, after a failure for each complaint
TestScene shipped_scene(const std::string& name, const Settings& settings = {});

/// A scene from its text, likewise.
TestScene scene_of(const std::string& text, const Settings& settings = {});

/// What tests ask of a scene, without its type.
int dimension_of(const scene::Scene& scene);
double target_of(const scene::Scene& scene);            // of the drive [m]
double reference_length_of(const scene::Scene& scene);  // of the drive [m]
double youngs_modulus_of(const scene::Scene& scene);    // of the first material [Pa]

}  // namespace verification
