#include "test_scene.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "scene/reader.hpp"

namespace verification {

namespace {

TestScene checked(const scene::SceneReading& reading) {
  for (const auto& problem : reading.errors) ADD_FAILURE() << problem.text();
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

}  // namespace verification
