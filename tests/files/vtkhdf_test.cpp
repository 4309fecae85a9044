#include "files/vtkhdf.hpp"

#include <gmock/gmock.h>

#include "files/durable_file.hpp"
#include "support/temporary_folder.hpp"

namespace files {
namespace {

using ::testing::ElementsAre;

// Two particles with one field of each kind.
std::vector<PointField> sample_fields() {
  const auto at = [](std::size_t i, int c) { return static_cast<double>(10 * i) + c; };
  return {scalar_field("plastic_strain", "-", 2, [](std::size_t i) { return 0.5 * double(i); }),
          vector_field("displacement", "m", 2, 2, at), tensor_field("stress", "Pa", 2, 4, at)};
}

TEST(PointField, PadsPlaneVectorsAndTensorsToThreeDimensions) {
  const auto fields = sample_fields();
  EXPECT_THAT(fields[0].values, ElementsAre(0.0, 0.5));
  EXPECT_THAT(fields[1].values, ElementsAre(0, 1, 0, 10, 11, 0));
  EXPECT_THAT(fields[2].values, ElementsAre(0, 1, 2, 3, 0, 0, 10, 11, 12, 13, 0, 0));
}

TEST(VtkHdf, HasTheLayoutOfAnUnstructuredGridOfVertices) {
  const support::TemporaryFolder folder;
  write_frame(folder / "frame.hdf", 7, 0.25, std::vector<double>{0, 1, 0, 2, 3, 0},
              sample_fields());
  const Hdf5File file = Hdf5File::open(folder / "frame.hdf");
  EXPECT_EQ(file.read_attribute("/VTKHDF", "Type"), Attribute(std::string("UnstructuredGrid")));
  EXPECT_EQ(file.read_attribute("/VTKHDF", "Version"), Attribute(std::vector<std::int64_t>{1, 0}));
  EXPECT_EQ(file.read_attribute("/", "step"), Attribute(std::int64_t{7}));
  EXPECT_EQ(file.read_attribute("/", "time"), Attribute(0.25));
  EXPECT_THAT(file.read_all<std::int64_t>("/VTKHDF/NumberOfPoints"), ElementsAre(2));
  EXPECT_THAT(file.read_all<std::int64_t>("/VTKHDF/NumberOfCells"), ElementsAre(2));
  EXPECT_THAT(file.read_all<std::int64_t>("/VTKHDF/NumberOfConnectivityIds"), ElementsAre(2));
  EXPECT_THAT(file.read_all<std::int64_t>("/VTKHDF/Connectivity"), ElementsAre(0, 1));
  EXPECT_THAT(file.read_all<std::int64_t>("/VTKHDF/Offsets"), ElementsAre(0, 1, 2));
  EXPECT_THAT(file.read_all<std::uint8_t>("/VTKHDF/Types"), ElementsAre(1, 1));
  EXPECT_THAT(file.info("/VTKHDF/Points").shape, ElementsAre(2, 3));
  EXPECT_THAT(file.info("/VTKHDF/PointData/plastic_strain").shape, ElementsAre(2));
  EXPECT_THAT(file.info("/VTKHDF/PointData/displacement").shape, ElementsAre(2, 3));
  EXPECT_THAT(file.info("/VTKHDF/PointData/stress").shape, ElementsAre(2, 6));
  EXPECT_EQ(file.info("/VTKHDF/PointData/stress").unit, "Pa");
}

TEST(VtkHdf, RefusesFieldsOfAnotherSize) {
  const support::TemporaryFolder folder;
  Hdf5File file = Hdf5File::create(folder / "frame.hdf");
  EXPECT_THROW(write_vtkhdf(file, std::vector<double>(3), sample_fields()), std::invalid_argument);
  EXPECT_THROW(write_vtkhdf(file, std::vector<double>(5), {}), std::invalid_argument);
}

TEST(FrameSeries, HoldsNamesAndTimesThatReadBackExactly) {
  const support::TemporaryFolder folder;
  FrameSeries series(folder / "run.hdf.series");
  series.append("frames/frame-000010.hdf", 0.1);
  series.append("frames/frame-000020.hdf", 1.0 / 3.0);
  EXPECT_EQ(read_text(folder / "run.hdf.series"),
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
  EXPECT_EQ(read_text(folder / "b.series"), read_text(folder / "a.series"));
}

TEST(FrameSeries, ResumesFromNothingAsFromAnEmptyList) {
  const support::TemporaryFolder folder;
  EXPECT_TRUE(FrameSeries::resume(folder / "none.series", 1.0).entries().empty());
}

TEST(FrameSeries, RefusesAListThatIsNotItsOwn) {
  const support::TemporaryFolder folder;
  write_text_durably(folder / "run.hdf.series", "{}");
  EXPECT_THROW((void)FrameSeries::resume(folder / "run.hdf.series", 1.0), FileError);
  FrameSeries series(folder / "cut.series");
  series.append("f", 0.1);
  const std::string text = read_text(folder / "cut.series");
  for (std::size_t length = 0; length < text.size(); ++length) {
    write_text_durably(folder / "cut.series", text.substr(0, length));
    EXPECT_THROW((void)FrameSeries::resume(folder / "cut.series", 1.0), FileError) << length;
  }
}

}  // namespace
}  // namespace files
