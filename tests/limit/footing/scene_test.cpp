#include <gmock/gmock.h>

#include <string>

#include "files/durable_file.hpp"
#include "limit/bracket/bracket.hpp"
#include "limit/footing/scene_case.hpp"
#include "limit/mesh/cut.hpp"
#include "limit/mesh/fan.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;

double area(const mesh::Mesh& mesh) {
  double twice = 0.0;
  for (const mesh::Triangle& triangle : mesh.triangles) twice += mesh::twice_area(mesh, triangle);
  return twice / 2.0;
}

TEST(Cut, LeavesNoTriangleAcrossTheLineAndTheBodyAsItIs) {
  const mesh::Mesh before = mesh::fan_mesh(mesh::even_fan(4.0, 2.0, 11, 5, 1.5));
  for (const auto& [axis, position] : {std::pair{1, -0.5}, {1, -1.9}, {0, 0.4}, {0, 2.7}}) {
    // A line close by that was cut before stays.
    const double earlier = position + 0.02;
    const mesh::Mesh mesh = mesh::cut(mesh::cut(before, axis, earlier), axis, position, {earlier});
    EXPECT_NO_THROW((void)mesh::edges_of(mesh));
    EXPECT_NEAR(area(mesh), 8.0, 1e-12);  // sums of some hundred products of order one
    for (const double line : {position, earlier}) {
      for (const mesh::Triangle& triangle : mesh.triangles) {
        int below = 0, above = 0;
        for (const int node : triangle.nodes) {
          const double x = mesh.nodes[static_cast<std::size_t>(node)][axis];
          below += x < line ? 1 : 0;
          above += x > line ? 1 : 0;
        }
        EXPECT_TRUE(below == 0 || above == 0);
      }
    }
  }
}

constexpr const char* footing = R"(
[geometry]
dimension = 2
min = [0.0, -2.0]
max = [5.0, 0.0]
spacing = 0.25
[approximation]
kinematics = "small_strain"
[[material]]
name = "clay"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.45
cohesion = 1e3
[[symmetry]]
axis = "x"
position = 0.0
[[support]]
name = "base"
side = "bottom"
directions = ["x", "y"]
[[support]]
name = "far"
side = "right"
directions = ["x"]
[drive]
kind = "displacement"
side = "top"
range_min = 0.0
range_max = 1.0
direction = [0.0, -1.0]
target = 0.1
reference_length = 1.0
width = 1.0
)";

constexpr const char* stronger_below = R"(
[[material]]
name = "stiff clay"
model = "von_mises"
youngs_modulus = 1e6
poissons_ratio = 0.45
cohesion = 2e3
region_min = [0.0, -2.0]
region_max = [5.0, -0.5]
)";

// The case, or every error said, a line each.
struct Read {
  std::optional<problem::Cases> found;
  std::string errors;
};

Read read(std::string_view text, const std::vector<std::string>& settings = {}) {
  Read result;
  tables::Diagnosis diagnosis("test.toml");
  std::optional<tables::Complaint> unreadable;
  const auto scene = scene::parse_scene(text, settings, diagnosis, unreadable);
  EXPECT_FALSE(unreadable);
  if (scene) result.found = footing::scene_case(*scene, true, diagnosis);
  for (const tables::Complaint& one : diagnosis.errors()) result.errors += one.text() + '\n';
  return result;
}

problem::Cases cases_of(std::string_view text) {
  const Read result = read(text);
  EXPECT_EQ(result.errors, "");
  return result.found.value();
}

TEST(SceneCase, IsTheFootingWithTheScenesBoxAndSupports) {
  const problem::Cases found = cases_of(footing);
  EXPECT_FALSE(found.davis);
  const problem::Problem& problem = found.associated.lower;
  EXPECT_NEAR(area(problem.mesh), 10.0, 1e-12);
  EXPECT_EQ(problem.footing.live_load[1], -1.0);
  const auto condition = [&](mesh::FanBoundary which) {
    return problem.boundaries[static_cast<std::size_t>(which)];
  };
  EXPECT_EQ(condition(mesh::FanBoundary::base).tangential, problem::Known::footing);
  EXPECT_EQ(condition(mesh::FanBoundary::wall).tangential, problem::Known::traction);
  EXPECT_EQ(condition(mesh::FanBoundary::floor).tangential, problem::Known::support);
  EXPECT_THAT(found.associated.title, HasSubstr("rough"));
}

TEST(SceneCase, ReadsThePapersFootingWithItsWeightAndItsDavisTwin) {
  const problem::Cases found = cases_of(files::read_text(FPM_SHARE_DIR "/scenes/footing.toml"));
  const problem::Soil& soil = found.associated.lower.soils[0];
  EXPECT_EQ(soil.cohesion, 2.5e3);
  EXPECT_DOUBLE_EQ(soil.unit_weight, 1850.0 * 9.81);
  ASSERT_TRUE(found.davis);
  EXPECT_LT(found.davis->lower.soils[0].cohesion, soil.cohesion);
}

TEST(SceneCase, BracketsTwoLayersOfClayBetweenTheWeakerAndTheStronger) {
  const problem::Cases found = cases_of(std::string(footing) + stronger_below);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const bracket::Bracket bounds = bracket::bracket(found.associated, options, {});
  ASSERT_TRUE(bounds.lower && bounds.upper);
  const double stress = found.associated.units.stress;
  // The load of a body grows with its strength: (2 + pi) c of either clay alone bounds the exact
  // value, which is 5 to 7 kPa for this crust of half a half width (coarse meshes: 15 %).
  EXPECT_GT(bounds.upper_bound() * stress, 5141.6);
  EXPECT_LT(bounds.lower_bound() * stress, 2 * 5141.6);
  EXPECT_GT(bounds.lower_bound() * stress, 5141.6 * 0.95);
  EXPECT_LT(bounds.lower_bound(), bounds.upper_bound());
  EXPECT_LT(bounds.gap(), 0.2);
}

TEST(SceneCase, RefusesWhatIsNoSuchFootingByFileLineAndKey) {
  const auto refusal = [](const std::vector<std::string>& settings) {
    const Read result = read(footing, settings);
    EXPECT_NE(result.found.has_value(), !result.errors.empty());
    return result.errors;
  };
  EXPECT_THAT(refusal({"gravity.acceleration=[1.0, -9.81]", "material.0.density=1800.0"}),
              HasSubstr("gravity.acceleration"));
  EXPECT_THAT(refusal({"material.0.tension_cutoff=0"}), HasSubstr("material.0.tension_cutoff"));
  EXPECT_THAT(refusal({"material.0.cohesion={ at = [0, 0], value = 1e3, gradient = [0, -1e3] }"}),
              HasSubstr("material.0.cohesion: it changes from place to place"));
  EXPECT_THAT(refusal({"material.0.unit_weight=18e3", "water.table=[[0, 0], [5, 0]]"}),
              HasSubstr("water: the ground is under water"));
  EXPECT_THAT(refusal({"drive.range_min=0.5"}), HasSubstr("drive.range_min"));
  EXPECT_THAT(refusal({"support.1.side=left"}), HasSubstr("support.1"));
  EXPECT_THAT(refusal({"support.1.directions=[\"y\"]"}), HasSubstr("test.toml"));
  // A soil that bears nothing is refused where its cohesion is written.
  EXPECT_THAT(refusal({"material.0.model=mohr_coulomb", "material.0.friction_angle=30",
                       "material.0.dilation_angle=30", "material.0.cohesion=0"}),
              AllOf(HasSubstr("--set material.0.cohesion=0: material.0.cohesion"),
                    HasSubstr("the soil bears nothing")));
  // All of them at once.
  EXPECT_THAT(refusal({"symmetry.0.position=5.0", "support.1.method=direct", "drive.side=bottom",
                       "support.0.side=top"}),
              AllOf(HasSubstr("the left side is no mirror"), HasSubstr("nothing is pressed")));
  EXPECT_EQ(refusal({}), "");
}

}  // namespace
