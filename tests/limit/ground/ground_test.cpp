// Scenes of polygons: what is refused and how, meshes, and small brackets of known answers.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <set>
#include <string_view>

#include "limit/bracket/strength_reduction.hpp"
#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_mesh.hpp"
#include "limit/ground/ground_outline.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

// A footing on two layers; the lower one carries a name.
constexpr const char* layered = R"([load]
sought = "footing"
[[material]]
name = "crust"
cohesion = 2.0
[[material]]
name = "soft"
cohesion = 1.0
[[region]]
name = "crust"
material = "crust"
outline = [[0, -1], [4, -1], [4, 0], [0, 0]]
[[region]]
name = "soft"
material = "soft"
outline = [[0, -2], [4, -2], [4, -1], [0, -1]]
[[side]]
name = "footing"
kind = "footing"
along = [[0, 0], [1, 0]]
[[side]]
name = "surface"
kind = "free"
along = [[1, 0], [4, 0]]
[[side]]
name = "axis"
kind = "symmetry"
along = [[0, 0], [0, -2]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[0, -2], [4, -2], [4, 0]]
)";

constexpr const char* cut = R"([load]
sought = "gravity"
[[material]]
name = "clay"
cohesion = 1.0
unit_weight = 1.0
[[region]]
material = "clay"
outline = [[-2, -1], [2, -1], [2, 1], [0, 1], [0, 0], [-2, 0]]
[[side]]
name = "cut"
kind = "free"
along = [[-2, 0], [0, 0], [0, 1], [2, 1]]
[[side]]
name = "rigid"
kind = "fixed"
along = [[-2, 0], [-2, -1], [2, -1], [2, 1]]
)";

// A block whose top is sheared, between free sides.
constexpr const char* sheared = R"([load]
sought = "traction"
[[material]]
name = "clay"
cohesion = 1.0
[[region]]
material = "clay"
outline = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[side]]
name = "top"
kind = "loaded"
live_shear = 1
along = [[0, 1], [4, 1]]
[[side]]
name = "left"
kind = "free"
along = [[0, 0], [0, 1]]
[[side]]
name = "right"
kind = "free"
along = [[4, 0], [4, 1]]
[[side]]
name = "floor"
kind = "fixed"
along = [[0, 0], [4, 0]]
)";

// The case, or every error said, a line each.
struct Read {
  std::optional<ground::GroundScene> scene;
  std::optional<problem::Cases> found;
  std::string errors;
};

Read read(std::string_view text, const std::vector<std::string>& settings = {}) {
  Read result;
  tables::Diagnosis diagnosis("ground.toml");
  std::optional<tables::Complaint> unreadable;
  result.scene = ground::read_ground_scene(text, settings, diagnosis, unreadable);
  if (unreadable) result.errors += unreadable->text() + '\n';
  if (result.scene) result.found = ground::ground_case(*result.scene, diagnosis);
  for (const tables::Complaint& one : diagnosis.errors()) result.errors += one.text() + '\n';
  return result;
}

TEST(GroundScene, IsToldFromASceneOfARunByItsRegions) {
  EXPECT_TRUE(ground::is_ground_scene(layered));
  EXPECT_FALSE(ground::is_ground_scene("[geometry]\ndimension = 2\n"));
  EXPECT_FALSE(ground::is_ground_scene("not = = TOML"));
}

TEST(GroundScene, RefusesWhatIsNoGroundByFileLineAndKey) {
  const auto with = [](const std::string& setting) { return read(layered, {setting}).errors; };
  // Line 11 is the first region's outline.
  EXPECT_THAT(read(layered + std::string("[[regoin]]\n")).errors,
              AllOf(HasSubstr("ground.toml:33"), HasSubstr("did you mean \"region\"")));
  EXPECT_THAT(with("material.soft.cohesion=-1"), HasSubstr("a number >= 0 [Pa]"));
  EXPECT_THAT(with("material.soft.cohesion=0"), HasSubstr("neither cohesion nor friction"));
  EXPECT_THAT(with("material.soft.dilation_angle=5"), HasSubstr("material.1.dilation_angle"));
  EXPECT_THAT(with("region.soft.material=rock"), HasSubstr("materials are crust, soft"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], 3]"),
              HasSubstr("a list of points [x, y]"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2]]"), HasSubstr("found 2 points"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2e200], [4, -2], [4, -1], [0, -1]]"),
              HasSubstr("the ground is 2e+200 m across"));
  EXPECT_THAT(read(layered, {"region.crust.outline=[[4e7, 0], [40000004, 0], [4e7, 2]]",
                             "region.soft.outline=[[4e7, 0], [40000004, 0], [4e7, -2]]"})
                  .errors,
              HasSubstr("4e+07 m away from the origin"));
  EXPECT_THAT(
      with("region.soft.outline=[[0, -2], [4, -1], [4, -2], [0, -1]]"),
      AllOf(HasSubstr("--set region.soft.outline"), HasSubstr("crosses itself at (2, -1.5)")));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], [4, -1], [2, -1], [2, -1.5], [2, -1], "
                   "[0, -1]]"),
              HasSubstr("touches itself at (2, -1)"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], [4, -0.5], [0, -0.5]]"),
              HasSubstr("\"crust\" and \"soft\" overlap"));
  EXPECT_THAT(with("region.soft.outline=[[0, -1], [4, -1], [4, 0], [0, 0]]"),
              HasSubstr("\"crust\" and \"soft\" overlap"));
  EXPECT_THAT(with("region.soft.outline=[[1, -0.6], [2, -0.6], [2, -0.3], [1, -0.3]]"),
              HasSubstr("\"crust\" and \"soft\" overlap"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], [4, -1.0000001], [0, -1.0000001]]"),
              HasSubstr("almost"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], [4, -1.2], [0, -1.2]]"),
              HasSubstr("shares no side"));
  EXPECT_THAT(with("region.soft.outline=[[0, -2], [4, -2], [4, -1], [2, -1], [2.2, -1.5], "
                   "[1.8, -1.5], [1, -1], [0, -1]]"),
              HasSubstr("outline of a hole"));
  EXPECT_THAT(with("side.surface.along=[[1, 0], [3, 0]]"),
              AllOf(HasSubstr("no [[side]] names"), HasSubstr("(4, 0) - (3, 0)")));
  EXPECT_THAT(with("side.surface.along=[[0.5, 0], [4, 0]]"), HasSubstr("is named by side"));
  EXPECT_THAT(with("side.surface.along=[[1, 0], [4, 0.5]]"), HasSubstr("off the ground's outline"));
  EXPECT_THAT(with("side.surface.pressure=1"), HasSubstr("kind loaded or footing"));
  EXPECT_THAT(with("side.surface.tension=false"), HasSubstr("it belongs to kind footing"));
  EXPECT_THAT(with("load.eccentricity=0.1"), HasSubstr("guided = false"));
  EXPECT_THAT(with("load.sought=gravity"), HasSubstr("a unit_weight that grows"));
  EXPECT_EQ(read(layered).errors, "");
}

TEST(GroundScene, RefusesWhatWouldTakeTooManyTriangles) {
  const std::string thin = read(layered, {"region.crust.outline=[[0, -1e-4], [4, -1e-4], [4, 0], "
                                          "[1, 0], [0, 0]]",
                                          "region.soft.outline=[[0, -2], [4, -2], [4, -1e-4], "
                                          "[0, -1e-4]]"})
                               .errors;
  EXPECT_THAT(thin, AllOf(HasSubstr("region.crust.outline"), HasSubstr("so narrow at ("),
                          HasSubstr("12000 triangles")));
}

double area(const mesh::Mesh& mesh) {
  double twice = 0.0;
  for (const mesh::Triangle& triangle : mesh.triangles) twice += mesh::twice_area(mesh, triangle);
  return twice / 2.0;
}

TEST(GroundMesh, CoversTheGroundAndConformsToLayersAndSides) {
  for (const char* text : {layered, cut}) {
    const Read made = read(text);
    ASSERT_TRUE(made.found) << made.errors;
    for (const problem::Problem& problem :
         {made.found->associated.lower, made.found->associated.upper}) {
      const mesh::Mesh& mesh = problem.mesh;
      EXPECT_NO_THROW((void)mesh::edges_of(mesh));
      const double expected = text == layered ? 8.0 : 6.0;
      EXPECT_NEAR(area(mesh), expected, 1e-9 * expected);
      for (const mesh::Triangle& triangle : mesh.triangles) {
        if (text != layered) continue;
        for (const int node : triangle.nodes) {
          const double y = mesh.nodes[static_cast<std::size_t>(node)].y();
          EXPECT_TRUE(triangle.region == 0 ? y >= -1.0 - 1e-9 : y <= -1.0 + 1e-9);
        }
      }
      double footing = 0.0;
      for (const mesh::BoundaryEdge& edge : mesh.boundary) {
        if (text != layered || edge.boundary != 0) continue;
        footing += (mesh.nodes[static_cast<std::size_t>(edge.second)] -
                    mesh.nodes[static_cast<std::size_t>(edge.first)])
                       .norm();
      }
      EXPECT_NEAR(footing, text == layered ? 1.0 : 0.0, 1e-9);
    }
  }
}

TEST(GroundMesh, HasAFanAtEverySingularPointAndNowhereElse) {
  const auto singular = [](const char* text, const std::vector<std::string>& settings = {}) {
    const Read made = read(text, settings);
    tables::Diagnosis diagnosis("ground.toml");
    const ground::GroundOutline outline = ground::ground_outline(*made.scene, diagnosis);
    std::set<std::pair<double, double>> places;
    for (const int point : ground::singular_points(*made.scene, outline)) {
      places.emplace(outline.at(point).x(), outline.at(point).y());
    }
    return places;
  };
  using Places = std::set<std::pair<double, double>>;
  EXPECT_EQ(singular(layered), (Places{{1.0, 0.0}}));
  EXPECT_EQ(singular(cut), (Places{{0.0, 0.0}}));
  // Where one stress cannot have both sides' tractions: a shear beside a side without, and a
  // pressure up to the crest of a slope, but not up to an upright cut.
  EXPECT_EQ(singular(sheared), (Places{{0.0, 1.0}, {4.0, 1.0}}));
  EXPECT_EQ(singular(sheared, {"side.left.kind=roller", "side.right.kind=fixed"}),
            (Places{{0.0, 1.0}}));
  const std::vector<std::string> pressed{"side.top.live_shear=0", "side.top.live_pressure=1"};
  EXPECT_EQ(singular(sheared, pressed), Places{});
  std::vector<std::string> crest = pressed;
  for (const char* setting :
       {"region.0.outline=[[-1, 0], [4, 0], [4, 1], [0, 1]]", "side.left.along=[[-1, 0], [0, 1]]",
        "side.floor.along=[[-1, 0], [4, 0]]"}) {
    crest.emplace_back(setting);
  }
  EXPECT_EQ(singular(sheared, crest), (Places{{0.0, 1.0}}));
  // Where faces of soil that leans on friction meet, and where it crops out beside another one.
  EXPECT_EQ(singular(cut, {"material.0.cohesion=0.1", "material.0.friction_angle=30",
                           "material.0.unit_weight=18"}),
            (Places{{0.0, 0.0}, {0.0, 1.0}}));
  // As many triangles meet there as rays have been asked for: 1.5 x 24 over 270 degrees.
  const mesh::Mesh mesh = read(cut).found->associated.lower.mesh;
  int at_toe = 0;
  for (const mesh::Triangle& triangle : mesh.triangles) {
    for (const int node : triangle.nodes) {
      if (mesh.nodes[static_cast<std::size_t>(node)] == mesh::Point(0, 0)) ++at_toe;
    }
  }
  EXPECT_EQ(at_toe, 36);
}

TEST(Ground, IsReportedInTheUnitsOfItsScene) {
  const auto problem = shipped("eccentric", {"units.stress=psf", "units.length=ft"});
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->associated.unit, "psf");
  std::string said;
  for (const auto& [what, value] : problem->associated.data) said += value + '\n';
  EXPECT_NE(said.find("psf/ft"), std::string::npos) << said;
  EXPECT_NE(said.find(" ft"), std::string::npos) << said;
  for (const char* other : {" Pa", " m\n", "N/m3"}) {
    EXPECT_EQ(said.find(other), std::string::npos) << said;
  }
  // A factor has none.
  EXPECT_EQ(shipped("slope_safety", {"units.stress=psf"})->associated.unit, "");
}

// On the meshes to begin with; what is asserted is that the known value lies inside.
bracket::Solution coarse(const Read& made) {
  bracket::BracketOptions options;
  options.max_triangles = 1;
  return bracket::solution_of(made.found->associated, options, {});
}

class Shipped : public ::testing::TestWithParam<KnownGround> {};

TEST_P(Shipped, HoldsTheKnownValue) {
  const KnownGround& known = GetParam();
  const auto problem = shipped(known.scene);
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LE(*found.lower, known.high) << known.source;
  EXPECT_GE(*found.upper, known.low) << known.source;
  // A mesh that is not refined at all; this only finds gross errors.
  EXPECT_LE(found.gap(), 0.3);
}

// All but the slopes, which take a minute; the validation has them.
std::vector<KnownGround> quick_grounds() {
  std::vector<KnownGround> quick = known_grounds();
  std::erase_if(quick, [](const KnownGround& known) {
    return std::string_view(known.scene).starts_with("slope");
  });
  return quick;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Shipped, ::testing::ValuesIn(quick_grounds()),
                         [](const auto& info) { return std::string(info.param.scene); });

TEST(Ground, AUniformTractionOnAStripCarriesPrandtlsPressure) {
  const Read made = read(layered, {"load.sought=traction", "side.footing.kind=loaded",
                                   "side.footing.live_pressure=2.0", "material.soft.cohesion=2.0"});
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  const double exact = 2.0 + std::numbers::pi;  // c / live_pressure = 1
  EXPECT_LT(*found.lower, exact);
  EXPECT_GT(*found.upper, exact);
  EXPECT_LT(found.gap(), 0.1);
}

// With one triangle in a corner, its stress would have the top's shear and none: no load at all.
TEST(Ground, AShearMayMeetAFreeSide) {
  const Read made = read(sheared);
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, 1.0);  // the block slips along its floor under the cohesion
  EXPECT_LT(found.gap(), 0.1);
}

TEST(Ground, StrengthOfClayIsReducedByTheFactorOfItsLoad) {
  // Without friction the factor of safety is the multiplier of all loads: 3.777 of a cut whose
  // gamma H / c is one; here half of it.
  const Read made = read(cut, {"load.sought=strength", "material.clay.unit_weight=2.0"});
  ASSERT_TRUE(made.found) << made.errors;
  const bracket::Solution found = coarse(made);
  ASSERT_TRUE(found.lower && found.upper);
  EXPECT_LT(*found.lower, 3.778 / 2);
  EXPECT_GT(*found.upper, 3.776 / 2);
  EXPECT_LT(found.gap(), 0.1);
  // Each bound is what its own field proves: the strength divided by it carries the loads.
  EXPECT_GE(found.bracket.lower->certificate.multiplier * made.found->associated.units.multiplier(),
            1.0);
  EXPECT_LE(found.bracket.upper->certificate.multiplier * made.found->associated.units.multiplier(),
            1.0);
}

TEST(Ground, UnitsDoNotMatter) {
  const Read si = read(layered);
  const Read kilo =
      read(layered, {"material.crust.cohesion=0.002", "material.soft.cohesion=0.001"});
  const bracket::Solution a = coarse(si), b = coarse(kilo);
  ASSERT_TRUE(a.lower && b.lower && a.upper && b.upper);
  constexpr double digits = 1e-6;  // of the solver, see Bracket.DoesNotDependOnTheUnits
  EXPECT_NEAR(*a.lower / *b.lower, 1e3, 1e3 * digits);
  EXPECT_NEAR(*a.upper / *b.upper, 1e3, 1e3 * digits);
}

// The same meshes: what the footing cannot use makes no bound better.
TEST(Ground, AFootingThatMayLiftOffBearsNoMoreThanABondedOne) {
  std::vector<bracket::Solution> found;
  for (const bool tension : {true, false}) {
    auto problem = shipped("eccentric_lift_off");
    ASSERT_TRUE(problem);
    problem::Case& made = problem->associated;
    EXPECT_THAT(made.assumptions, Contains(HasSubstr("may lift off the soil")));
    // Smooth, so that no slip is paid for where it lifts off.
    for (problem::Problem* each : {&made.lower, &made.upper}) {
      each->boundaries[0].may_open = !tension;
      each->boundaries[0].tangential = problem::Known::traction;
    }
    bracket::BracketOptions options;
    options.max_triangles = 1;
    found.push_back(bracket::solution_of(made, options, {}));
    ASSERT_TRUE(found.back().lower && found.back().upper);
  }
  EXPECT_LT(*found[1].lower, *found[0].lower);
  EXPECT_LT(*found[1].upper, *found[0].upper);
  // Meyerhof's effective width, half the base.
  EXPECT_GT(*found[1].upper, 0.5e3 * (2.0 + std::numbers::pi));
}

// Of the base, nine tenths lift off: little stiffness beside the mean stresses of clay, which are
// free.
TEST(Ground, ALoadCloseToTheEdgeOfABaseThatLiftsOffNeedsNoFallBack) {
  const auto problem = shipped("eccentric_lift_off", {"load.eccentricity=0.9"});
  ASSERT_TRUE(problem);
  bracket::BracketOptions options;
  options.max_triangles = 1;
  const bracket::Solution found = bracket::solution_of(problem->associated, options, {});
  ASSERT_TRUE(found.lower && found.upper);
  ASSERT_EQ(found.bracket.attempts.size(), 2U);
  for (const bracket::Attempt& attempt : found.bracket.attempts) {
    EXPECT_EQ(attempt.status, solver::SolverStatus::solved) << attempt.message;
  }
  EXPECT_GT(*found.upper, 0.1e3 * (2.0 + std::numbers::pi));  // Meyerhof's effective width
}

TEST(Ground, AFootingThatMayLiftOffBearsNoLoadBesideIt) {
  const std::vector<std::string> beside{"side.footing.tension=false", "load.guided=false",
                                        "load.eccentricity=0.5"};
  EXPECT_THAT(read(layered, beside).errors,
              AllOf(HasSubstr("load.eccentricity"), HasSubstr("half its width (0.5)")));
}

TEST(Ground, ASmoothFootingBearsNoInclinedLoad) {
  const std::vector<std::string> inclined{"side.footing.base=smooth", "load.guided=false",
                                          "load.inclination=5"};
  EXPECT_THAT(read(layered, inclined).errors,
              AllOf(HasSubstr("load.inclination"), HasSubstr("5 degrees"), HasSubstr("smooth")));
}

TEST(StrengthReduction, DividesCohesionAndTheTangent) {
  const problem::Soil soil{10.0, 0.5, 18.0};
  const problem::Soil weak = bracket::weakened(soil, 2.0);
  EXPECT_DOUBLE_EQ(weak.cohesion, 5.0);
  EXPECT_DOUBLE_EQ(std::tan(weak.friction_angle), std::tan(0.5) / 2.0);
  EXPECT_EQ(weak.unit_weight, 18.0);
}

}  // namespace
