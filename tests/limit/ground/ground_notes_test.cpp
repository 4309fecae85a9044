// What is said of ground: in which units, and beside the bounds.
#include <gmock/gmock.h>

#include "limit/ground/ground_cases.hpp"

namespace {

using namespace limit;
using ::testing::AllOf;
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

// 9810 is N/m3: in other units its default would be a thousand times too much.
TEST(Ground, InOtherUnitsWantsTheWeightOfWater) {
  const auto read = [](const std::vector<std::string>& settings) {
    tables::Diagnosis diagnosis("scene");
    std::optional<tables::Complaint> unreadable;
    const auto file = std::filesystem::path(FPM_SHARE_DIR) / "scenes/limit/slope_water.toml";
    std::string text = std::get<std::string>(scene::text_of(file));
    const std::string given = "unit_weight = 10e3 ";
    text.erase(text.find(given), given.size());
    const auto scene = ground::read_ground_scene(text, settings, diagnosis, unreadable);
    if (scene) static_cast<void>(ground::ground_case(*scene, diagnosis));
    std::string said;
    for (const tables::Complaint& one : diagnosis.errors()) said += one.text() + '\n';
    for (const tables::Complaint& one : diagnosis.warnings()) said += one.text() + '\n';
    return said;
  };
  EXPECT_EQ(read({}), "");
  EXPECT_THAT(read({"units.stress=kPa"}),
              AllOf(HasSubstr("water.unit_weight: absent"), HasSubstr("kPa/m"), HasSubstr("9.81")));
  EXPECT_EQ(read({"units.stress=kPa", "water.unit_weight=9.81"}), "");
  // Ground that floats is a mistake, mostly.
  EXPECT_THAT(read({"material.silty sand.unit_weight=20"}),
              AllOf(HasSubstr("material.0.unit_weight: found 20, less than that of water, 9810"),
                    HasSubstr("in one unit")));
}

}  // namespace
