// What is said of ground: in which units, and beside the bounds.
#include <gmock/gmock.h>

#include "limit/ground/ground_cases.hpp"
#include "limit/ground/ground_skins.hpp"

namespace {

using namespace limit;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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

// A trace of cohesion where there is none is said, in the scene's unit; where there is some,
// neither given nor said.
TEST(Ground, SaysWhatCohesionItsMechanismsHave) {
  problem::Problem problem;
  problem.soils = {{0.0, 0.6, 18.0}, {5.0, 0.0, 18.0}};
  std::vector<std::string> notes;
  ground::strengthen(problem, 0.25, {"psf", "ft"}, notes);
  EXPECT_EQ(problem.soils[0].cohesion, 0.25);
  EXPECT_EQ(problem.soils[1].cohesion, 5.0);
  EXPECT_THAT(notes, ElementsAre(HasSubstr("a cohesion of 0.25 psf where there is none")));
  notes.clear();
  ground::strengthen(problem, 0.5, {"psf", "ft"}, notes);
  EXPECT_THAT(notes, ElementsAre());
  EXPECT_EQ(problem.soils[0].cohesion, 0.25);
}

}  // namespace
