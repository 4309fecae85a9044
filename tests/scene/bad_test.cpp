// Every way we know to get a scene wrong, each with the whole message the user sees.

#include <gmock/gmock.h>

#include <cctype>
#include <set>

#include "scene/reader.hpp"
#include "support/sample_scene.hpp"

namespace scene {
namespace {

struct BadScene {
  const char* what;     // found exactly once in the sample ...
  const char* instead;  // ... and replaced by this
  const char* message;  // all of it

  friend void PrintTo(const BadScene& bad, std::ostream* stream) { *stream << bad.message; }
};

/// The key of the message, as a test's name: geometry_spacing_9.
std::string test_name(const ::testing::TestParamInfo<BadScene>& info) {
  std::string key = info.param.message;
  key = key.substr(key.find(": ") + 2);
  key = key.substr(0, key.find(':')) + "_" + std::to_string(info.index);
  for (char& c : key) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return key;
}

// Most are one edit of the sample; the last tests hold what needs more.
const BadScene bad_scenes[] = {
#include "bad_scenes.inc"
};

class BadSceneTest : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedWithExactlyItsMessage) {
  const auto reading =
      parse_scene(support::sample_with(GetParam().what, GetParam().instead), "s.toml");
  EXPECT_FALSE(reading.scene);
  ASSERT_EQ(reading.errors.size(), 1U)
      << (reading.errors.size() > 1 ? reading.errors[1].text() : std::string());
  EXPECT_EQ(reading.errors[0].text(), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(Scene, BadSceneTest, ::testing::ValuesIn(bad_scenes), test_name);

TEST(BadScenes, AreAtLeastFortyAndAllDifferent) {
  std::set<std::string> messages;
  for (const BadScene& bad : bad_scenes) messages.insert(bad.message);
  EXPECT_GE(std::size(bad_scenes), 40U);
  EXPECT_EQ(messages.size(), std::size(bad_scenes));
}

TEST(BadScenes, ReportEveryComplaintAtOnce) {
  const std::string text = R"([geometry]
dimension = 4
min = [0.0]
spacing = -1
colour = "red"
[materials]
)";
  const auto reading = parse_scene(text, "s.toml");
  std::vector<std::string> messages;
  for (const tables::Complaint& complaint : reading.errors) messages.push_back(complaint.text());
  EXPECT_THAT(messages,
              ::testing::UnorderedElementsAre(
                  ::testing::StartsWith("s.toml:6:2: materials: no such table; "),
                  "s.toml:2:13: geometry.dimension: found 4; allowed is a whole number 2 .. 3",
                  "s.toml:1:1: geometry.max: is missing; needed is a list of numbers [m], unless "
                  "[[region]]s are the body",
                  "s.toml:4:11: geometry.spacing: found -1; allowed is a number > 0 [m]",
                  "s.toml:5:1: geometry.colour: no such key; keys of [geometry] are dimension, "
                  "min, max, depth, spacing, layout, jitter, seed",
                  "s.toml: material: table is missing; a scene needs [[material]]"));
}

// In 3D what weighs across a mirror along z is aslant as much as along x.
TEST(BadScenes, GravityAcrossAMirrorAlongZ) {
  const std::string text = R"([geometry]
dimension = 3
min = [0, 0, 0]
max = [1, 1, 1]
spacing = 0.25
[[material]]
name = "rock"
model = "elastic"
youngs_modulus = 1e7
poissons_ratio = 0.3
density = 2000
[[symmetry]]
axis = "z"
position = 0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y", "z"]
[gravity]
acceleration = [0, -9.81, 2]
)";
  const auto reading = parse_scene(text, "s.toml");
  ASSERT_EQ(reading.errors.size(), 1U);
  EXPECT_EQ(
      reading.errors[0].text(),
      "s.toml:20:16: gravity.acceleration: found 2 along z, across the mirror at z = 0; behind "
      "it the weight is aslant the other way: take the whole body, or a roller");
}

TEST(BadScenes, AnEmptyFileNamesTheTablesItNeeds) {
  const auto reading = parse_scene("", "s.toml");
  ASSERT_EQ(reading.errors.size(), 2U);
  EXPECT_EQ(reading.errors[0].text(),
            "s.toml: geometry: table is missing; a scene needs [geometry]");
}

TEST(BadScenes, AMissingFileIsNamedWithItsNearestNeighbour) {
  const std::string folder = FPM_SHARE_DIR "/scenes/";
  const auto reading = read_scene(folder + "fotting.toml");
  ASSERT_EQ(reading.errors.size(), 1U);
  EXPECT_EQ(reading.errors[0].text(), folder +
                                          "fotting.toml: cannot be read: No such file or "
                                          "directory; allowed is a TOML file; did you mean \"" +
                                          folder + "footing.toml\"?");
}

TEST(BadScenes, AFolderIsNoScene) {
  const auto reading = read_scene(FPM_SHARE_DIR);
  ASSERT_EQ(reading.errors.size(), 1U);
  EXPECT_EQ(
      reading.errors[0].text(),
      std::string(FPM_SHARE_DIR) + ": cannot be read: it is a folder; allowed is a TOML file");
}

}  // namespace
}  // namespace scene
