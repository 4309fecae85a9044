#include "compare/source.hpp"

#include <gmock/gmock.h>

#include "compare/difference.hpp"
#include "files/durable_file.hpp"
#include "files/vtkhdf.hpp"
#include "record/curve_file.hpp"
#include "record/frames.hpp"
#include "support/temporary_folder.hpp"

namespace {

using support::TemporaryFolder;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

std::filesystem::path stored(int schema) {
  return std::filesystem::path(FPM_STORED_CHECKPOINTS) /
         ("schema-" + std::to_string(schema) + ".hdf");
}

bool all_identical(const comparison::Source& a, const comparison::Source& b) {
  const auto all = comparison::differences(a, b, {});
  return !all.empty() && std::ranges::all_of(all, &comparison::Difference::identical);
}

TEST(Source, OfACheckpointIsItsStateAndItsCurve) {
  const comparison::Source source = comparison::open_source(stored(2));
  EXPECT_EQ(source.what, "checkpoint of step 6");
  EXPECT_THAT(source.names, Contains("particles/stress"));
  EXPECT_THAT(source.names, Contains("rows/neighbour"));
  EXPECT_THAT(source.names, Contains("programme/load"));
  EXPECT_THAT(source.names, Contains("curve/mean_pressure_Pa"));
  EXPECT_THAT(source.names, Not(Contains("curve/wall_s")));
  EXPECT_EQ(source.load("particles/stress").unit, "Pa");
  EXPECT_THAT(source.load("particles/stress").shape, ElementsAre(24, 4));
  EXPECT_EQ(source.points.size(), 3U * 24U);
}

// The same run, compressed and of another schema.
TEST(Source, OfOneStateInTwoSchemasIsTheSame) {
  EXPECT_TRUE(
      all_identical(comparison::open_source(stored(1)), comparison::open_source(stored(2))));
}

TEST(Source, OfAFolderIsItsNewestUsableCheckpoint) {
  const TemporaryFolder folder;
  files::create_folder(folder / "checkpoints");
  std::filesystem::copy_file(stored(2), folder.path() / "checkpoints" / "step-000006.hdf");
  files::write_text_durably(folder.path() / "checkpoints" / "step-000007.hdf", "damaged");
  EXPECT_TRUE(
      all_identical(comparison::open_source(folder.path()), comparison::open_source(stored(2))));
}

TEST(Source, OfAFrameIsItsPointsAndFields) {
  const TemporaryFolder folder;
  const std::vector<files::PointField> fields{
      files::scalar_field("plastic_strain", "-", 2, [](std::size_t i) { return double(i); })};
  const auto frame = folder / "frame-000001.hdf";
  record::write_frame(frame, 1, 0.5, std::vector<double>{0, 1, 0, 2, 3, 0}, fields);
  const comparison::Source source = comparison::open_source(frame);
  EXPECT_THAT(source.names, ElementsAre("Points", "plastic_strain"));
  EXPECT_TRUE(all_identical(source, comparison::open_source(frame)));
}

TEST(Source, OfACurveIsItsColumns) {
  const TemporaryFolder folder;
  const auto file = folder / "curve.csv";
  auto curve = record::CurveFile::create(file, 2);
  record::CurveRow row;
  for (row.step = 0; row.step < 3; ++row.step) curve.append(row);
  const comparison::Source source = comparison::open_source(file);
  EXPECT_EQ(source.what, "curve to step 2");
  EXPECT_THAT(source.steps, ElementsAre(0, 1, 2));
  EXPECT_TRUE(all_identical(source, comparison::open_source(file)));
}

TEST(Source, ThatIsNoneIsRefused) {
  const TemporaryFolder folder;
  const auto refusal = [](const std::filesystem::path& path) {
    try {
      (void)comparison::open_source(path);
      return std::string();
    } catch (const files::FileError& failure) {
      return failure.reason();
    }
  };
  EXPECT_THAT(refusal(folder / "none"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal(folder.path()), HasSubstr("it has no checkpoint"));
  files::write_text_durably(folder / "text.hdf", "text");
  EXPECT_THAT(refusal(folder / "text.hdf"), HasSubstr("is no whole HDF5 file"));
  files::write_text_durably(folder / "curve.csv", "text");
  EXPECT_THAT(refusal(folder / "curve.csv"), HasSubstr("header of a curve"));
}

}  // namespace
