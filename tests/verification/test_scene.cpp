#include "test_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace verification {

namespace {

TestScene checked(const scene::SceneReading& reading) {
  for (const auto& complaint : reading.errors) ADD_FAILURE() << complaint.text();
  if (!reading.scene) throw std::runtime_error("the scene of this test is refused");
  return TestScene(*reading.scene);
}

}  // namespace

TestScene::TestScene(scene::Scene checked)
    : scene_(std::make_shared<const scene::Scene>(std::move(checked))) {}

TestScene shipped_scene(const std::string& name, const Settings& settings) {
  return checked(scene::read_scene(std::filesystem::path(FPM_SCENES) / name, settings));
}

TestScene scene_of(const std::string& text, const Settings& settings) {
  return checked(scene::parse_scene(text, "test scene", settings));
}

int dimension_of(const scene::Scene& scene) {
  return scene.geometry.dimension;
}

double target_of(const scene::Scene& scene) {
  return scene.drive.target;
}

double reference_length_of(const scene::Scene& scene) {
  return scene.drive.reference_length.value();
}

double youngs_modulus_of(const scene::Scene& scene) {
  return scene.material.at(0).youngs_modulus.value;
}

}  // namespace verification
