#include "bounds/accuracy_note.hpp"

#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/print.hpp"
#include "scene/scene.hpp"
#include "support/temporary_folder.hpp"

namespace bounds {
namespace {

using ::testing::HasSubstr;

scene::Scene scene_of(double spacing) {
  scene::Scene scene;
  scene.geometry.min = {0.0, 0.0};
  scene.geometry.max = {1.0, 1.0};
  scene.geometry.spacing = spacing;
  return scene;
}

TEST(TheAccuracyNote, IsOfTheSceneThatTheLadderSpokeOf) {
  const support::TemporaryFolder scratch;
  EXPECT_EQ(accuracy_note(scratch / "", scene_of(0.25)), "") << "no ladder was climbed";
  const nlohmann::json said = {
      {"effective", scene::effective_toml(scene_of(0.25))},
      {"quantity", "mean_pressure_Pa"},
      {"value", 5000.0},
      {"bar", 75.0},
      {"parts", {{{"source", "spacing"}, {"error", 50.0}}, {{"source", "box"}, {"error", 25.0}}}}};
  std::ofstream(scratch / "accuracy.json") << said.dump();
  EXPECT_THAT(accuracy_note(scratch / "", scene_of(0.25)),
              HasSubstr("mean_pressure_Pa = 5000 +- 75 (1.50 %): spacing 1.00 %, box 0.50 %"));
  EXPECT_EQ(accuracy_note(scratch / "", scene_of(0.125)), "") << "another scene";
  std::ofstream(scratch / "accuracy.json") << "{";
  EXPECT_EQ(accuracy_note(scratch / "", scene_of(0.25)), "") << "damaged";
}

}  // namespace
}  // namespace bounds
