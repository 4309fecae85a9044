#include "scene/print.hpp"

#include <gmock/gmock.h>

#include <filesystem>

#include "files/durable_file.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/tables.hpp"
#include "support/sample_scene.hpp"
#include "tables/table.hpp"

namespace scene {
namespace {

TEST(EffectiveScene, ReadsBackToTheSameSceneForEverySceneThatIsShipped) {
  for (const auto& entry : std::filesystem::directory_iterator(FPM_SHARE_DIR "/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    const auto reading = read_scene(entry.path());
    ASSERT_TRUE(reading.scene) << entry.path();
    const std::string text = effective_toml(*reading.scene);
    const auto again = parse_scene(text, "effective");
    ASSERT_TRUE(again.scene) << again.errors.front().text();
    EXPECT_EQ(*again.scene, *reading.scene) << entry.path();
    EXPECT_TRUE(again.warnings.empty());
    EXPECT_EQ(effective_toml(*again.scene), text);
  }
}

TEST(EffectiveScene, KeepsAwkwardNumbersAndTexts) {
  auto scene = *parse_scene(support::sample_scene, "s.toml").scene;
  scene.title = "quote \" backslash \\ tab \t newline \n bell \a UTF-8 größe";
  scene.material[0].youngs_modulus = 1.0 / 3.0 * 1e20;
  scene.material[0].cohesion = 5e-324;
  scene.material[0].density = 3.0;
  const auto again = parse_scene(effective_toml(scene), "effective");
  ASSERT_TRUE(again.scene) << again.errors.front().text();
  EXPECT_EQ(*again.scene, scene);
}

// 0.05 m in increments of 0.02 of a spacing of 0.1 m are 25; Drucker-Prager in 2D is mixed at 0.01.
TEST(EffectiveScene, SaysWhatIsMadeOfWhatTheSceneLeavesOpen) {
  const auto lines_of = [](const std::vector<std::string>& settings) {
    const auto reading = parse_scene(support::sample_scene, "s.toml", settings);
    return effective_toml(*reading.scene);
  };
  using ::testing::ContainsRegex;
  EXPECT_THAT(lines_of({}), ContainsRegex("\ncontrol = \"auto\" *# here mixed; "));
  EXPECT_THAT(lines_of({}), ContainsRegex("\n# stiffness_ratio = *# here 0.01; "));
  EXPECT_THAT(lines_of({}), ContainsRegex("\n# steps = *# here 25; "));
  EXPECT_THAT(lines_of({}), ContainsRegex("\nmethod = \"auto\" *# here ghosts; one of auto, "
                                          "direct, penalty, ghosts, contact\n"));
  EXPECT_THAT(lines_of({}), ContainsRegex("\nmethod = \"auto\" *# here ghosts; one of auto, "
                                          "direct, ghosts, contact, tied\n"));
  EXPECT_THAT(lines_of({"hourglass.control=viscosity"}),
              ContainsRegex("\nmethod = \"auto\" *# here direct; "));
  EXPECT_THAT(lines_of({"hourglass.control=incremental"}),
              ContainsRegex("\n# stiffness_ratio = *# here 0.1; "));
  EXPECT_THAT(lines_of({"programme.steps=7"}), ContainsRegex("\nsteps = 7 *# here 7; "));
}

// The text from a table's heading to the next one.
std::vector<std::string> entries_of(const std::string& text, const SceneTable& table) {
  std::vector<std::string> entries;
  const std::string heading = "\n" + table.title() + "\n";
  if (table.name.empty()) return {"\n" + text.substr(0, text.find("\n["))};
  for (std::size_t at = text.find(heading); at != std::string::npos; at = text.find(heading, at)) {
    at += heading.size() - 1;  // the newline, which belongs to both
    entries.push_back(text.substr(at, text.find("\n[", at + 1) - at));
  }
  return entries;
}

TEST(EffectiveScene, NamesEveryKeyOfEveryTableInThatTable) {
  auto scene = *parse_scene(support::sample_scene, "s.toml").scene;
  for (const SceneTable& table : scene_tables()) table.resize(scene, 2);
  const std::string text = effective_toml(scene);
  for (const SceneTable& table : scene_tables()) {
    const auto entries = entries_of(text, table);
    ASSERT_EQ(entries.size(), table.size(scene)) << table.title();
    for (const std::string& entry : entries) {
      for (const tables::Field<Scene>& field : table.fields) {
        const std::string key(field.key);
        const bool given = entry.find("\n" + key + " = ") != std::string::npos;
        const bool absent = entry.find("\n# " + key + " = ") != std::string::npos;
        EXPECT_TRUE(given != absent) << table.title() << " " << key << " in" << entry;
      }
    }
  }
}

TEST(SceneFields, HaveUniqueNamesAndADescription) {
  for (const SceneTable& table : scene::scene_tables()) {
    EXPECT_EQ(tables::find_table(scene::scene_tables(), table.name), &table);
    EXPECT_FALSE(table.doc.empty());
    for (const tables::Field<Scene>& field : table.fields) {
      EXPECT_EQ(table.find(field.key), &field) << table.name << "." << field.key;
      EXPECT_FALSE(field.notes.doc.empty()) << table.name << "." << field.key;
      const bool optional = field.notes.need == tables::Need::optional;
      EXPECT_EQ(field.notes.absent.empty(), !optional) << table.name << "." << field.key;
    }
  }
}

TEST(SceneFields, HaveDefaultsTheyAllow) {
  for (const SceneTable& table : scene::scene_tables()) {
    Scene scene;
    table.resize(scene, 1);
    for (const tables::Field<Scene>& field : table.fields) {
      if (field.notes.need != tables::Need::defaulted) continue;
      const auto value = field.read(scene, 0);
      ASSERT_TRUE(value) << table.name << "." << field.key;
      if (const auto* number = std::get_if<double>(&*value)) {
        EXPECT_TRUE(field.notes.range.holds(*number)) << table.name << "." << field.key;
      } else if (const auto* integer = std::get_if<std::int64_t>(&*value)) {
        EXPECT_TRUE(field.notes.range.holds(static_cast<double>(*integer)))
            << table.name << "." << field.key;
      }
    }
  }
}

TEST(SceneReference, IsTheFileInTheDocumentation) {
  EXPECT_EQ(files::read_text(FPM_SHARE_DIR "/doc/scene.md"), scene_reference())
      << "write it anew: fpm-run --scene-reference > share/doc/scene.md";
}

TEST(Range, SaysItsEnds) {
  EXPECT_EQ(tables::positive().text(), "> 0");
  EXPECT_EQ(tables::at_least(2).text(), ">= 2");
  EXPECT_EQ(tables::between(0, 0.4).text(), "0 .. 0.4");
  EXPECT_EQ((tables::Range{-1, 0.5, true, true}).text(), "-1 < value < 0.5");
  EXPECT_FALSE(tables::positive().holds(0.0));
  EXPECT_TRUE(tables::at_least(2).holds(2.0));
  EXPECT_FALSE((tables::Range{-1, 0.5, true, true}).holds(0.5));
}

}  // namespace
}  // namespace scene
