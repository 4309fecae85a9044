#include "record/curve_file.hpp"

#include <gmock/gmock.h>

#include "files/durable_file.hpp"
#include "support/temporary_folder.hpp"

namespace record {
namespace {

CurveRow row(std::int64_t step) {
  CurveRow row;
  row.step = step;
  row.load_parameter = static_cast<double>(step) / 3.0;
  row.mean_pressure = 58437.0 / 7.0 * static_cast<double>(step);
  row.jacobian_actions = 10 * step;
  row.wall = 0.1;
  return row;
}

TEST(CurveFile, ShowsEveryRowAtOnce) {
  const support::TemporaryFolder folder;
  CurveFile curve = CurveFile::create(folder / "curve.csv", 2);
  EXPECT_TRUE(read_curve(folder / "curve.csv").empty());
  curve.append(row(1));
  EXPECT_THAT(read_curve(folder / "curve.csv"), ::testing::ElementsAre(row(1)));
  curve.append(row(2));
  EXPECT_THAT(read_curve(folder / "curve.csv"), ::testing::ElementsAre(row(1), row(2)));
}

// A run killed after any byte of its curve and resumed from step 3 ends with the curve of a run
// that was never killed.
TEST(CurveFile, ResumedAfterAKillAtAnyByteEqualsTheUninterruptedOne) {
  const support::TemporaryFolder folder;
  CurveFile whole = CurveFile::create(folder / "whole.csv", 2);
  for (int step = 1; step <= 5; ++step) whole.append(row(step));
  const std::string text = files::read_text(folder / "whole.csv");
  std::size_t checkpointed = 0;  // bytes up to the end of the row of step 3
  for (int line = 0; line < 4; ++line) checkpointed = text.find('\n', checkpointed) + 1;
  for (std::size_t length = checkpointed; length <= text.size(); ++length) {
    files::write_text_durably(folder / "killed.csv", text.substr(0, length));
    CurveFile resumed = CurveFile::resume(folder / "killed.csv", folder / "killed.csv", 2, 3);
    resumed.append(row(4));
    resumed.append(row(5));
    ASSERT_EQ(files::read_text(folder / "killed.csv"), text) << "killed after byte " << length;
  }
}

TEST(CurveFile, BranchesIntoAnotherFolderAndLeavesItsSource) {
  const support::TemporaryFolder folder;
  CurveFile source = CurveFile::create(folder / "a.csv", 2);
  for (int step = 1; step <= 3; ++step) source.append(row(step));
  const std::string before = files::read_text(folder / "a.csv");
  CurveFile branch = CurveFile::resume(folder / "b.csv", folder / "a.csv", 2, 2);
  branch.append(row(3));
  EXPECT_EQ(files::read_text(folder / "b.csv"), before);
  EXPECT_EQ(files::read_text(folder / "a.csv"), before);
}

TEST(CurveFile, ResumesAtStepZeroWithOnlyItsHeader) {
  const support::TemporaryFolder folder;
  CurveFile::create(folder / "curve.csv", 2).append(row(1));
  (void)CurveFile::resume(folder / "curve.csv", folder / "curve.csv", 2, 0);
  EXPECT_TRUE(read_curve(folder / "curve.csv").empty());
}

TEST(CurveFile, RefusesACurveThatLacksTheStepOfTheCheckpoint) {
  const support::TemporaryFolder folder;
  CurveFile curve = CurveFile::create(folder / "curve.csv", 2);
  curve.append(row(1));
  curve.append(row(2));
  curve.append(row(4));
  const std::string before = files::read_text(folder / "curve.csv");
  const auto resume = [&](std::int64_t step) {
    (void)CurveFile::resume(folder / "curve.csv", folder / "curve.csv", 2, step);
  };
  EXPECT_THROW(resume(3), files::FileError);
  EXPECT_THROW(resume(5), files::FileError);
  EXPECT_EQ(files::read_text(folder / "curve.csv"), before);
}

TEST(CurveFile, RefusesDoubledRowsAndForeignFiles) {
  const support::TemporaryFolder folder;
  const std::string head = curve_header(2) + "\n";
  const std::string one = curve_line(row(1)) + "\n", two = curve_line(row(2)) + "\n";
  for (const std::string& text : {head + one + one + two, std::string("a,b\n1,2\n"),
                                  head + one + "2,broken\n" + two, curve_header(3) + "\n" + one}) {
    files::write_text_durably(folder / "curve.csv", text);
    EXPECT_THROW((void)CurveFile::resume(folder / "curve.csv", folder / "curve.csv", 2, 2),
                 files::FileError)
        << text;
  }
}

}  // namespace
}  // namespace record
