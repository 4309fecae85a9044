#include "record/frames.hpp"

#include <gmock/gmock.h>

#include "support/temporary_folder.hpp"

namespace record {
namespace {

using ::testing::ElementsAre;

const std::vector<double> points{0, 1, 0, 2, 3, 0};
const std::vector<files::PointField> fields{
    files::scalar_field("plastic_strain", "-", 2, [](std::size_t i) { return 0.5 * double(i); })};

TEST(Frame, IsAFileForParaViewWithItsStepAndTime) {
  const support::TemporaryFolder folder;
  write_frame(folder / "frame.hdf", 7, 0.25, points, fields);
  const auto file = files::Hdf5File::open(folder / "frame.hdf");
  EXPECT_EQ(file.read_attribute("/", "step"), files::Attribute(std::int64_t{7}));
  EXPECT_EQ(file.read_attribute("/", "time"), files::Attribute(0.25));
  EXPECT_THAT(file.read_all<double>("/VTKHDF/Points"), ElementsAre(0, 1, 0, 2, 3, 0));
  EXPECT_THAT(file.read_all<double>("/VTKHDF/PointData/plastic_strain"), ElementsAre(0.0, 0.5));
}

TEST(Frames, AreDueEverySoManyStepsAndOnceEach) {
  const support::TemporaryFolder folder;
  const RunFolder run(folder / "run");
  Frames frames(run, 5, 0, 0, std::nullopt);
  EXPECT_TRUE(frames.due(0));
  EXPECT_TRUE(frames.due(10));
  EXPECT_FALSE(frames.due(11));
  EXPECT_TRUE(frames.lacks(11)) << "the end of a run has one in any case";
  frames.write(10, 0.1, points, fields);
  EXPECT_FALSE(frames.due(10));
  EXPECT_FALSE(frames.lacks(10));
  EXPECT_TRUE(std::filesystem::exists(run.frames() / "frame-000010.hdf"));
}

TEST(Frames, OfEveryZeroStepsAreNone) {
  const support::TemporaryFolder folder;
  const RunFolder run(folder / "run");
  const Frames frames(run, 0, 0, 0, std::nullopt);
  EXPECT_FALSE(frames.due(0));
  EXPECT_FALSE(frames.lacks(7));
  EXPECT_FALSE(std::filesystem::exists(run.frames()));
}

// A killed run may have written a frame that its list does not name.
TEST(Frames, BeyondTheStepARunGoesOnFromAreRemoved) {
  const support::TemporaryFolder folder;
  const RunFolder run(folder / "run");
  {
    Frames frames(run, 1, 0, 0, std::nullopt);
    for (const std::int64_t step : {1, 2, 3}) {
      frames.write(step, 0.1 * static_cast<double>(step), points, fields);
    }
    write_frame(run.frames() / Frames::name(1000000), 1000000, 9.0, points, fields);
  }
  const Frames resumed(run, 1, 0, 2, 0.2);
  EXPECT_FALSE(resumed.lacks(2));
  EXPECT_TRUE(resumed.due(3));
  EXPECT_TRUE(std::filesystem::exists(run.frames() / Frames::name(2)));
  EXPECT_FALSE(std::filesystem::exists(run.frames() / Frames::name(3)));
  EXPECT_FALSE(std::filesystem::exists(run.frames() / Frames::name(1000000)));
}

}  // namespace
}  // namespace record
