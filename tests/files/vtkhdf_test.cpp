#include "files/vtkhdf.hpp"

#include <gmock/gmock.h>

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
  {
    Hdf5File written = Hdf5File::create(folder / "frame.hdf");
    write_vtkhdf(written, std::vector<double>{0, 1, 0, 2, 3, 0}, sample_fields());
    written.close();
  }
  const Hdf5File file = Hdf5File::open(folder / "frame.hdf");
  EXPECT_EQ(file.read_attribute("/VTKHDF", "Type"), Attribute(std::string("UnstructuredGrid")));
  EXPECT_EQ(file.read_attribute("/VTKHDF", "Version"), Attribute(std::vector<std::int64_t>{1, 0}));
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

}  // namespace
}  // namespace files
