// The scene of a stage beside that of the run: one method for all stages, and what regions become.
#include "scene/stages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace scene {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Scene read(const std::string& text) {
  const auto reading = parse_scene(text, "s.toml");
  if (!reading.scene) throw std::runtime_error(reading.errors.front().text());
  return *reading.scene;
}

std::vector<std::string> errors_of(const std::string& text) {
  std::vector<std::string> errors;
  for (const auto& error : parse_scene(text, "s.toml").errors) errors.push_back(error.text());
  return errors;
}

std::string support(const std::string& name, const std::string& side, const std::string& axes) {
  return "[[support]]\nname = \"" + name + "\"\nside = \"" + side + "\"\ndirections = [" + axes +
         "]\n";
}

const std::string material = "youngs_modulus = 1e7\npoissons_ratio = 0.3\nmodel = \"elastic\"\n";
const std::string box =
    "[geometry]\nmin = [0, 0]\nmax = [2, 1]\nspacing = 0.25\n[[material]]\nname "
    "= \"m\"\n" +
    material;
const std::string press =
    "[drive]\nkind = \"displacement\"\nside = \"top\"\ndirection = [0.0, -1.0]\nwidth = 2.0\n";

const std::string pull =
    "[[traction]]\nname = \"q\"\nside = \"top\"\nvalue = [0.0, -1e3]\n[drive]\n"
    "kind = \"load\"\nscales = [\"traction\"]\n[programme]\nsteps = 2\n";

// What --print-effective says of a key of a table, up to the ranges.
std::string printed(const Scene& scene, const std::string& table, const std::string& key) {
  const std::string all = effective_toml(scene);
  const auto from = all.find("\n" + key, all.find(table));
  return all.substr(from + 1, all.find(';', from) - from - 1);
}

// Of every stage's scene what the whole one says, which is what --check and --print-effective show.
void expect_one_answer(const Scene& whole) {
  for (std::size_t s = 0; s < whole.stage.size(); ++s) {
    const Scene then = scene_of_stage(whole, s);
    EXPECT_EQ(resolve_consistency(then), resolve_consistency(whole)) << "stage " << s;
    for (const Support& now : then.support) {
      for (const Support& support : whole.support) {
        if (support.name != now.name) continue;
        EXPECT_EQ(now.method, resolve_method(whole, support)) << now.name << ", stage " << s;
      }
    }
    if (then.drive.kind != DriveKind::displacement) continue;
    const auto drives = drives_of(whole);
    EXPECT_EQ(then.drive.method, resolve_drive_method(whole, *drives[then.drive.number].drive))
        << "stage " << s;
  }
}

TEST(StageMethods, OfASupportAreThatOfTheStageThatAllowsLeast) {
  // The second stage holds the left side along itself only, where images hold nothing.
  const Scene scene =
      read(box + support("base", "bottom", "\"x\", \"y\"") + support("across", "left", "\"x\"") +
           support("along", "left", "\"y\"") + pull +
           "[[stage]]\nname = \"a\"\nto = 0.5\n[[stage]]\nname = \"b\"\nrelease = [\"across\"]\n");
  expect_one_answer(scene);
  EXPECT_EQ(scene_of_stage(scene, 0).support[1].method, SupportMethod::ghosts);
  EXPECT_EQ(scene_of_stage(scene, 0).support[2].method, SupportMethod::direct);
}

TEST(StageMethods, KeepTheCorrectionWhenImagesAreReleased) {
  const Scene scene =
      read(box + support("base", "bottom", "\"x\", \"y\"") +
           "[[traction]]\nname = \"q\"\nside = \"top\"\nvalue = [0.0, -1e3]\n[[support]]\nname = "
           "\"hand\"\nregion_min = [0, 0]\nregion_max = [2, 0.3]\ndirections = [\"x\", \"y\"]\n" +
           "[drive]\nkind = \"load\"\nscales = [\"traction\"]\n[programme]\nsteps = 2\n[[stage]]\n"
           "name = \"a\"\nto = 1.0\n[[stage]]\nname = \"b\"\nrelease = [\"base\"]\n");
  expect_one_answer(scene);
  EXPECT_TRUE(resolve_consistency(scene_of_stage(scene, 1)));
}

TEST(StageMethods, OfADriveThatComesBackAreDirectFromTheFirst) {
  const std::string stages =
      "[[stage]]\nname = \"a\"\nto = 0.01\n[[stage]]\nname = \"b\"\nrelease = [\"drive\"]\nsteps = "
      "2\n";
  const Scene gone = read(box + support("base", "bottom", "\"x\", \"y\"") + press + stages);
  expect_one_answer(gone);
  EXPECT_EQ(gone.drive.method, DriveMethod::automatic);
  EXPECT_EQ(scene_of_stage(gone, 0).drive.method, DriveMethod::ghosts);
  const Scene back = read(box + support("base", "bottom", "\"x\", \"y\"") + press + stages +
                          "[[stage]]\nname = \"c\"\ndrive.name = \"drive\"\nto = 0.02\n");
  expect_one_answer(back);
  EXPECT_EQ(scene_of_stage(back, 0).drive.method, DriveMethod::direct);
  EXPECT_THAT(printed(back, "[drive]", "method"), HasSubstr("here direct"));
  EXPECT_THAT(printed(gone, "[drive]", "method"), HasSubstr("here ghosts"));
}

TEST(StageMethods, ArePrintedAsTheRunHasThem) {
  const Scene scene = read(
      box + support("base", "bottom", "\"x\", \"y\"") + support("wall", "right", "\"x\"") + press +
      "[[stage]]\nname = \"a\"\nto = 0.01\n[[stage]]\nname = \"b\"\nhold = [\"wall\"]\n"
      "to = 0.02\n[[stage]]\nname = \"c\"\nrelease = [\"drive\"]\n[stage.drive]\nkind = "
      "\"displacement\"\nside = \"left\"\nrange_min = 0.25\nrange_max = 1.0\ndirection = [1.0, "
      "0.0]\nwidth = 1.0\ntarget = "
      "0.01\n");
  expect_one_answer(scene);
  EXPECT_THAT(printed(scene, "\"wall\"", "method"), HasSubstr("here direct"));
  EXPECT_THAT(printed(scene, "\"c\"", "drive.method"), HasSubstr("here direct"));
  EXPECT_THAT(printed(scene, "[approximation]", "consistency"), HasSubstr("here on"));
}

const std::string ground = R"(
[geometry]
spacing = 0.25
[[region]]
name = "below"
material = "m"
outline = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[region]]
name = "above"
material = "m"
outline = [[0, 1], [2, 1], [2, 2], [0, 2]]
[[side]]
name = "base"
kind = "roller"
along = [[0, 2], [0, 0], [2, 0], [2, 2]]
[[side]]
name = "rest"
kind = "free"
along = [[2, 2], [1, 2]]
[[material]]
name = "m"
)" + material + "[[material]]\nname = \"n\"\n" +
                           material;
const std::string strip =
    "[[side]]\nname = \"strip\"\nkind = \"footing\"\nalong = [[1, 2], [0, 2]]\n";
const std::string first_and_later =
    "[[stage]]\nname = \"wait\"\nregions = [\"below\"]\nbecome = [\"n\"]\nsteps = "
    "1\n[[stage]]\nname = \"push\"\n[stage.drive]\nkind = \"displacement\"\ntarget = 0.01\n";

// Rough footings that come later have no images: they are tied, unless they are told how to touch.
TEST(StageFooting, IsTiedOnlyWhereItsMethodIsNotGiven) {
  const Scene scene = read(ground + strip + first_and_later);
  EXPECT_EQ(scene_of_stage(scene, 1).drive.method, DriveMethod::tied);
  const Scene again = read(effective_toml(scene));
  EXPECT_EQ(scene_of_stage(again, 1).drive.method, DriveMethod::tied);
  const Scene touching =
      read(ground + strip + first_and_later + "method = \"contact\"\nfriction_angle = 10.0\n");
  EXPECT_EQ(scene_of_stage(touching, 1).drive.method, DriveMethod::contact);
}

std::string exchange(const std::string& stages) {
  return ground +
         "[[side]]\nname = \"q\"\nkind = \"free\"\nalong = [[1, 2], [0, 2]]\n[programme]\nsteps = "
         "1\n" +
         stages;
}

TEST(StageRegions, BecomeAnotherMaterialFromTheirStageOn) {
  const Scene scene = read(exchange(
      "[[stage]]\nname = \"a\"\nregions = [\"above\"]\nbecome = [\"n\"]\n[[stage]]\nname = \"b\"\n"
      "regions = [\"below\", \"above\"]\nbecome = [\"n\", \"m\"]\n"));
  const auto materials = [&](const Scene& then) {
    return std::vector{then.region[0].material, then.region[1].material};
  };
  EXPECT_THAT(materials(scene_before_stages(scene)), ElementsAre("m", "m"));
  EXPECT_THAT(materials(scene_of_stage(scene, 0)), ElementsAre("m", "n"));
  EXPECT_THAT(materials(scene_of_stage(scene, 1)), ElementsAre("n", "m"));
  // What it was made of is no place to remember where it was.
  EXPECT_EQ(resolve_control(scene), HourglassControl::incremental);
  EXPECT_THAT(errors_of(exchange("[[stage]]\nname = \"a\"\nregions = [\"above\"]\nbecome = "
                                 "[\"n\"]\n[hourglass]\ncontrol = \"stiffness\"\n")),
              ElementsAre(HasSubstr("hourglass.control: found stiffness, and stages that put")));
}

TEST(StageRegions, AreRefusedWhereNothingBecomesOfThem) {
  const auto error = [](const std::string& stages) {
    const auto errors = errors_of(exchange(stages));
    return errors.size() == 1 ? errors[0] : std::to_string(errors.size());
  };
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nregions = [\"abve\"]\nbecome = [\"n\"]\n"),
              HasSubstr("stage.0.regions: found \"abve\"; regions are below, above; did you mean "
                        "\"above\"?"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nregions = [\"above\"]\nbecome = [\"k\"]\n"),
              HasSubstr("stage.0.become: found \"k\"; materials are m, n"));
  EXPECT_THAT(error("[[stage]]\nname = \"a\"\nregions = [\"above\"]\nbecome = [\"m\"]\n"),
              HasSubstr("stage.0.become: found \"m\"; region \"above\" is made of it already"));
  EXPECT_THAT(
      error("[[stage]]\nname = \"a\"\nregions = [\"above\", \"above\"]\nbecome = [\"n\", \"m\"]\n"),
      HasSubstr("stage.0.regions: found \"above\" more than once in a stage"));
  EXPECT_THAT(
      error("[[stage]]\nname = \"a\"\nremove = [\"above\"]\nregions = [\"above\"]\nbecome = "
            "[\"n\"]\n"),
      HasSubstr("stage.0.regions: found \"above\"; it is not there, in this stage or a "
                "later one"));
}

}  // namespace
}  // namespace scene
