#include "record/frame_series.hpp"

#include <gtest/gtest.h>

#include "files/durable_file.hpp"
#include "support/temporary_folder.hpp"

namespace record {
namespace {

TEST(FrameSeries, HoldsNamesAndTimesThatReadBackExactly) {
  const support::TemporaryFolder folder;
  FrameSeries series(folder / "run.hdf.series");
  series.append("frames/frame-000010.hdf", 0.1);
  series.append("frames/frame-000020.hdf", 1.0 / 3.0);
  EXPECT_EQ(files::read_text(folder / "run.hdf.series"),
            "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n"
            "    { \"name\": \"frames/frame-000010.hdf\", \"time\": 0.1 },\n"
            "    { \"name\": \"frames/frame-000020.hdf\", \"time\": 0.3333333333333333 }\n"
            "  ]\n}\n");
  EXPECT_EQ(FrameSeries::resume(folder / "run.hdf.series", 1.0).entries(), series.entries());
}

TEST(FrameSeries, ResumesWithoutTheFramesAfterTheCheckpoint) {
  const support::TemporaryFolder folder;
  FrameSeries uninterrupted(folder / "a.series");
  FrameSeries killed(folder / "b.series");
  for (const double time : {0.1, 0.2}) {
    uninterrupted.append("f", time);
    killed.append("f", time);
  }
  killed.append("later", 0.25);
  FrameSeries resumed = FrameSeries::resume(folder / "b.series", 0.2);
  resumed.append("f", 0.3);
  uninterrupted.append("f", 0.3);
  EXPECT_EQ(files::read_text(folder / "b.series"), files::read_text(folder / "a.series"));
}

TEST(FrameSeries, ResumesFromNothingAsFromAnEmptyList) {
  const support::TemporaryFolder folder;
  EXPECT_TRUE(FrameSeries::resume(folder / "none.series", 1.0).entries().empty());
}

TEST(FrameSeries, RefusesAListThatIsNotItsOwn) {
  const support::TemporaryFolder folder;
  for (const char* foreign : {"", "{}", "[]", "7", "{\"files\": 7}", "{\"files\": [7]}",
                              "{\"files\": [{\"name\": \"f\"}]}",
                              "{\"files\": [{\"name\": \"f\", \"time\": \"0.1\"}]}"}) {
    files::write_text_durably(folder / "run.hdf.series", foreign);
    EXPECT_THROW((void)FrameSeries::resume(folder / "run.hdf.series", 1.0), files::FileError)
        << foreign;
  }
  FrameSeries series(folder / "cut.series");
  series.append("f", 0.1);
  const std::string text = files::read_text(folder / "cut.series");
  // Only the end of its last line may be missing.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    files::write_text_durably(folder / "cut.series", text.substr(0, length));
    EXPECT_THROW((void)FrameSeries::resume(folder / "cut.series", 1.0), files::FileError) << length;
  }
}

}  // namespace
}  // namespace record
