// Boxes of fpm-run that are more than half a footing on ground of one strength.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "limit/bracket/bracket.hpp"
#include "limit/command_line.hpp"
#include "limit/ground/ground_case.hpp"
#include "limit/ground/ground_of_scene.hpp"
#include "limit/ground/regions_of_box.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace {

using namespace limit;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double gap_asked = 0.04;

struct Taken {
  std::optional<scene::Scene> regions;
  std::optional<problem::Cases> cases;
  std::string errors;
};

Taken take(const std::string& text, const std::vector<std::string>& settings = {}) {
  Taken taken;
  tables::Diagnosis diagnosis("test.toml");
  std::optional<tables::Complaint> unreadable;
  const auto scene = scene::parse_scene(text, settings, diagnosis, unreadable);
  EXPECT_FALSE(unreadable);
  if (scene) {
    taken.regions =
        scene->region.empty() ? ground::regions_of_box(*scene, true, diagnosis) : *scene;
  }
  if (taken.regions) {
    const auto ground = ground::ground_of_scene(*taken.regions, diagnosis);
    if (ground) taken.cases = ground::ground_case(*ground, diagnosis);
  }
  for (const tables::Complaint& one : diagnosis.errors()) taken.errors += one.text() + '\n';
  return taken;
}

bracket::Bracket bounds_of(const std::string& text, const std::vector<std::string>& settings = {}) {
  const Taken taken = take(text, settings);
  EXPECT_EQ(taken.errors, "");
  bracket::BracketOptions options;
  options.gap = gap_asked;
  return bracket::bracket(taken.cases.value().associated, options, {});
}

// Of Davis & Booker (1973): c = 10 kPa and 20 kPa/m more below, B = 2 m.
const std::string clay =
    "[geometry]\nspacing = 0.0625\n%s[[material]]\nname = \"clay\"\nmodel = \"von_mises\"\n"
    "youngs_modulus = 1e7\npoissons_ratio = 0.4\n"
    "cohesion = { at = [0, 0], value = 10e3, gradient = [0, -20e3] }\n";

std::string with(std::string text, const std::string& what, const std::string& by) {
  return text.replace(text.find(what), what.size(), by);
}

const std::string strip_on_box = with(clay, "%s", "min = [0, -2]\nmax = [3, 0]\n") + R"(
[[symmetry]]
axis = "x"
position = 0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "far side"
side = "right"
directions = ["x", "y"]
[drive]
kind = "displacement"
side = "top"
range_min = 0
range_max = 1
direction = [0, -1]
target = 0.1
width = 1.0
)";

const std::string strip_on_regions = with(clay, "%s", "") + R"(
[[region]]
material = "clay"
outline = [[0, -2], [3, -2], [3, 0], [0, 0]]
[[side]]
name = "strip"
kind = "footing"
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [3, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -2]]
[[side]]
name = "ground beyond"
kind = "fixed"
along = [[0, -2], [3, -2], [3, 0]]
[drive]
kind = "displacement"
target = 0.1
)";

TEST(Box, IsTheGroundOfRegionsThatItIs) {
  const double stress = take(strip_on_box).cases.value().associated.units.stress;
  const bracket::Bracket box = bounds_of(strip_on_box), regions = bounds_of(strip_on_regions);
  ASSERT_TRUE(box.lower && box.upper && regions.lower && regions.upper);
  // The same mesh but for the order of its nodes: what the optimiser's tolerance leaves.
  constexpr double tolerance = 1e-6;
  EXPECT_NEAR(box.lower_bound() / regions.lower_bound(), 1.0, tolerance);
  EXPECT_NEAR(box.upper_bound() / regions.upper_bound(), 1.0, tolerance);
  // F >= 1 in F ((2 + pi) c + k B / 4); the best slip circle.
  EXPECT_GT(box.upper_bound() * stress, (2.0 + 3.14159265) * 10e3 + 20e3 * 2.0 / 4.0);
  EXPECT_LT(box.lower_bound() * stress, 12.4942 * 10e3);
  EXPECT_LE(box.gap(), gap_asked);
}

// c (y) = 10 kPa + 20 kPa/m (-y), as a table tells it.
TEST(Box, TakesTablesAsGradients) {
  const bracket::Bracket linear = bounds_of(strip_on_box);
  const bracket::Bracket table = bounds_of(
      strip_on_box, {"material.0.cohesion={ below = 0, table = [[0, 10e3], [2, 50e3]] }"});
  ASSERT_TRUE(linear.lower && linear.upper && table.lower && table.upper);
  EXPECT_LE(table.lower_bound(), linear.upper_bound());
  EXPECT_LE(linear.lower_bound(), table.upper_bound());
  EXPECT_LE(table.gap(), gap_asked);
}

const std::string cut = R"(
[geometry]
spacing = 0.25
min = [0, 0]
max = [4, 3]
[[material]]
name = "clay"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 10e3
friction_angle = 20
dilation_angle = 20
unit_weight = 18e3
[[material]]
name = "sand"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 1e3
friction_angle = 30
dilation_angle = 30
unit_weight = 20e3
region_min = [0, 0]
region_max = [4, 1]
[[material]]
name = "block"
model = "mohr_coulomb"
youngs_modulus = 1e7
poissons_ratio = 0.3
cohesion = 1e3
friction_angle = 30
dilation_angle = 30
unit_weight = 20e3
region_min = [1, 0.5]
region_max = [2, 2]
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "left"
side = "left"
directions = ["x"]
[[traction]]
name = "always"
side = "top"
value = [1e3, -5e3]
[[traction]]
name = "grows"
side = "top"
range_min = 1
range_max = 3
value = [0, -1e3]
[drive]
kind = "load"
scales = ["traction"]
loads = ["grows"]
[programme]
steps = 4
)";

std::vector<std::string> outlines(const scene::Scene& scene) {
  std::vector<std::string> all;
  for (const scene::Region& region : scene.region) {
    const auto &low = region.outline[0], &high = region.outline[2];
    all.push_back(
        fmt::format("{} {} {} {} {}", region.material, low.x(), low.y(), high.x(), high.y()));
  }
  return all;
}

TEST(Box, IsCutIntoRectanglesAndSides) {
  const Taken taken = take(cut);
  ASSERT_TRUE(taken.regions) << taken.errors;
  EXPECT_THAT(outlines(*taken.regions),
              ElementsAre("sand 0 0 4 0.5", "sand 0 0.5 1 1", "block 1 0.5 2 2", "sand 2 0.5 4 1",
                          "clay 0 1 1 2", "clay 2 1 4 2", "clay 0 2 4 3"));
  std::vector<std::string> sides;
  for (const scene::OutlineSide& side : taken.regions->side) {
    sides.push_back(fmt::format("{}: {} {} {} {}", side.name, side.pressure, side.shear,
                                side.live_pressure, side.live_shear));
  }
  // With the ground to the left the top goes along -x.
  EXPECT_THAT(sides,
              ElementsAre("left from 0 to 3: 0 0 0 0", "right from 0 to 3: 0 0 0 0",
                          "bottom from 0 to 4: 0 0 0 0", "top from 0 to 1: 5000 -1000 0 0",
                          "top from 1 to 3: 5000 -1000 1000 0", "top from 3 to 4: 5000 -1000 0 0"));
  using enum scene::OutlineKind;
  std::vector<scene::OutlineKind> kinds;
  for (const scene::OutlineSide& side : taken.regions->side) kinds.push_back(side.kind);
  EXPECT_THAT(kinds, ElementsAre(roller, free, fixed, scene::OutlineKind::loaded,
                                 scene::OutlineKind::loaded, scene::OutlineKind::loaded));
  EXPECT_EQ(taken.errors, "");
}

TEST(Box, IsRefusedWhereSidesCannotSayWhatIsOnIt) {
  EXPECT_THAT(take(strip_on_box, {"support.0.directions=[\"x\"]"}).errors,
              HasSubstr("support: the bottom is held along itself alone"));
  EXPECT_THAT(take(strip_on_box, {"drive.direction=[0.0, 1.0]"}).errors,
              HasSubstr("drive.direction: it does not press straight into the ground"));
  EXPECT_THAT(take(strip_on_box + "[[support]]\nname = \"pin\"\nat = [2, -1]\n"
                                  "directions = [\"x\"]\n")
                  .errors,
              HasSubstr("support.2: it holds something else than a whole side"));
  const std::string pressed = "[[traction]]\nname = \"q\"\nside = \"top\"\nvalue = [0, -1e3]\n";
  EXPECT_THAT(take(strip_on_box + pressed).errors,
              HasSubstr("drive: its plate is where a traction is, on the top"));
  EXPECT_THAT(
      take(strip_on_box + pressed, {"traction.0.range_min=1", "traction.0.range_max=3"}).errors,
      IsEmpty());
  EXPECT_THAT(take(strip_on_box + pressed, {"traction.0.side=right"}).errors,
              HasSubstr("traction.0: it acts where a support or mirror holds"));
}

// A plate that lies on the ground by contact alone is smooth, whatever holds it aside.
TEST(Box, HasAPlateAsTheRunHasIt) {
  const auto base = [](const std::vector<std::string>& settings) {
    const Taken taken = take(strip_on_box, settings);
    EXPECT_EQ(taken.errors, "");
    const auto footing = std::ranges::find(taken.regions.value().side, scene::OutlineKind::footing,
                                           &scene::OutlineSide::kind);
    return std::pair(footing->base, footing->tension);
  };
  EXPECT_EQ(base({}), std::pair(scene::Base::rough, true));
  EXPECT_EQ(base({"drive.method=contact"}), std::pair(scene::Base::smooth, false));
  std::string whole = strip_on_box;
  const std::string mirror = "[[symmetry]]\naxis = \"x\"\nposition = 0\n";
  whole.replace(whole.find(mirror), mirror.size(),
                "[[support]]\nname = \"left\"\nside = \"left\"\ndirections = [\"x\"]\n");
  EXPECT_THAT(take(whole, {"drive.method=contact", "drive.range_min=1", "drive.range_max=2",
                           "drive.at=[1.75]"})
                  .errors,
              HasSubstr("to fpm-limit load.eccentricity says how far from its middle"));
  EXPECT_THAT(
      take(strip_on_box, {"support.0.method=contact", "support.0.directions=[\"y\"]"}).errors,
      HasSubstr("the ground lies against it by contact"));
  EXPECT_THAT(take(strip_on_box, {"approximation.interfaces=contact"}).errors,
              HasSubstr("approximation.interfaces: bodies slide on each other"));
}

// Half a footing on ground of one strength keeps its own mesh.
TEST(Box, IsGroundOfPolygonsWhereItIsMoreThanHalfAFooting) {
  const auto words = [](std::vector<std::string> settings) {
    std::vector<std::string> arguments{FPM_SHARE_DIR "/scenes/footing.toml", "--gap", "60%"};
    for (const std::string& setting : settings) {
      arguments.insert(arguments.end(), {"--set", setting});
    }
    std::ostringstream out, err;
    EXPECT_EQ(limit::fpm_limit(arguments, out, err), program::ExitCode::done) << err.str();
    return out.str();
  };
  const char* const polygons = "the polygons of the scene";
  EXPECT_THAT(words({}), ::testing::Not(HasSubstr(polygons)));
  EXPECT_THAT(words({"material.0.cohesion={ at = [0, 0], value = 2e3, gradient = [0, -1e3] }"}),
              HasSubstr(polygons));
}

}  // namespace
