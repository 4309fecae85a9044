// Scenes of polygons: what is refused and how.
#include <gmock/gmock.h>

#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_scenes.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
using ::testing::HasSubstr;

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
  EXPECT_THAT(with("side.surface.name=rigid"), HasSubstr("found \"rigid\" again"));
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

TEST(GroundScene, TakesRegionsAndSidesFromAMesh) {
  std::string text =
      "[mesh]\nfile = \"" FPM_SHARE_DIR
      "/scenes/tunnel.msh\"\n[load]\nsought = "
      "\"gravity\"\n[[material]]\nname = \"clay\"\ncohesion = 1.0\nunit_weight = 1.0\n";
  for (const char* soil : {"soft clay", "stiff clay"}) {
    text += std::string("[[region]]\nmaterial = \"clay\"\ngroup = \"") + soil + "\"\n";
  }
  for (const char* name : {"level", "slope", "tunnel", "base", "left", "right", "footing"}) {
    const char* kind = std::string(name) == "base" ? "fixed" : "free";
    text += std::string("[[side]]\nname = \"") + name + "\"\nkind = \"" + kind + "\"\ngroup = \"" +
            name + "\"\n";
  }
  EXPECT_EQ(read(text, {}).errors, "");
  EXPECT_THAT(read(text, {"side.tunnel.group=tunel"}).errors,
              HasSubstr("did you mean \"tunnel\"?"));
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

TEST(GroundScene, AFootingThatMayLiftOffBearsNoLoadBesideIt) {
  const std::vector<std::string> beside{"side.footing.tension=false", "load.guided=false",
                                        "load.eccentricity=0.5"};
  EXPECT_THAT(read(layered, beside).errors,
              AllOf(HasSubstr("load.eccentricity"), HasSubstr("half its width (0.5)")));
}

TEST(GroundScene, ASmoothFootingBearsNoInclinedLoad) {
  const std::vector<std::string> inclined{"side.footing.base=smooth", "load.guided=false",
                                          "load.inclination=5"};
  EXPECT_THAT(read(layered, inclined).errors,
              AllOf(HasSubstr("load.inclination"), HasSubstr("5 degrees"), HasSubstr("smooth")));
}

}  // namespace
