// Numbers that change from place to place: what they come to, and files of them.
#include "tables/varying_number.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "tables/sample_text.hpp"
#include "tables/table.hpp"

namespace tables {
namespace {

using ::testing::ElementsAre;

double at(const Samples& samples, double x, double y) {
  return samples.at_place(std::array{x, y});
}

TEST(ATable, IsLinearBetweenItsLinesAndEndsThere) {
  const Samples table = table_samples({{-2.0, 8.0}, {0.0, 4.0}, {1.0, 10.0}}, 1, std::nullopt);
  EXPECT_DOUBLE_EQ(at(table, 99.0, -2.0), 8.0);
  EXPECT_DOUBLE_EQ(at(table, 99.0, -1.5), 7.0);
  EXPECT_DOUBLE_EQ(at(table, 99.0, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(at(table, 99.0, 0.25), 5.5);
  EXPECT_DOUBLE_EQ(at(table, 99.0, 1.0), 10.0);
  EXPECT_DOUBLE_EQ(table.coverage()[0][1], -2.0);
  EXPECT_DOUBLE_EQ(table.coverage()[1][1], 1.0);
  EXPECT_TRUE(std::isinf(table.coverage()[0][0]));
}

TEST(ATable, OfDepthsIsOneOfLevels) {
  const Samples depths = table_samples({{0.0, 4.0}, {2.0, 8.0}}, 1, 10.0);
  EXPECT_DOUBLE_EQ(at(depths, 0.0, 10.0), 4.0);
  EXPECT_DOUBLE_EQ(at(depths, 0.0, 8.5), 7.0);
  EXPECT_THAT(depths.coordinates, ElementsAre(8.0, 10.0));
}

// a + b x + c y + d x y is what bilinear interpolation has exactly.
TEST(ARaster, IsBilinearBetweenTheMiddlesOfItsCells) {
  const auto exact = [](double x, double y) { return 3.0 + 2.0 * x - y + 0.5 * x * y; };
  Samples raster;
  raster.kind = Samples::Kind::raster;
  raster.lower = {1.0, -2.0};
  raster.step = {0.5, 0.25};
  raster.columns = 5;
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 5; ++column) {
      raster.values.push_back(exact(1.0 + 0.5 * column, -2.0 + 0.25 * row));
    }
  }
  for (double x = 1.0; x <= 3.0; x += 0.1) {
    for (double y = -2.0; y <= -1.25; y += 0.05) EXPECT_NEAR(at(raster, x, y), exact(x, y), 1e-13);
  }
  // Beyond the middles as in the nearest of the outer cells, which end half a cell farther.
  EXPECT_DOUBLE_EQ(at(raster, 0.8, -1.9), at(raster, 1.0, -1.9));
  EXPECT_DOUBLE_EQ(at(raster, 3.2, -1.1), exact(3.0, -1.25));
  EXPECT_DOUBLE_EQ(raster.coverage()[0][0], 0.75);
  EXPECT_DOUBLE_EQ(raster.coverage()[1][1], -1.125);
}

TEST(Points, HaveTheValueOfTheNearest) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-1.0, 1.0);
  std::vector<std::array<double, 3>> points;
  for (int i = 0; i < 60; ++i) {
    points.push_back({anywhere(random), anywhere(random), static_cast<double>(i)});
  }
  const Samples samples = point_samples(points);
  for (int trial = 0; trial < 500; ++trial) {
    const double x = 1.3 * anywhere(random), y = 1.3 * anywhere(random);
    const auto distance = [&](const auto& point) { return std::hypot(point[0] - x, point[1] - y); };
    const auto nearest = std::ranges::min_element(points, {}, distance);
    EXPECT_EQ(at(samples, x, y), (*nearest)[2]) << x << ", " << y;
  }
}

// Of one value in each cell: that of the nearest of its middles.
TEST(ARaster, ThatIsNearestHasTheValueOfTheCell) {
  Samples raster;
  raster.kind = Samples::Kind::raster;
  raster.nearest = true;
  raster.lower = {1.0, -2.0};
  raster.step = {0.5, 0.25};
  raster.columns = 3;
  raster.values = {1, 2, 3, 4, 5, 6};
  std::vector<std::array<double, 3>> middles;
  for (std::size_t i = 0; i < 6; ++i) {
    middles.push_back({raster.place(i)[0], raster.place(i)[1], raster.values[i]});
  }
  const Samples points = point_samples(middles);
  for (double x = 0.61; x < 2.5; x += 0.1) {
    for (double y = -2.31; y < -1.4; y += 0.04) EXPECT_EQ(at(raster, x, y), at(points, x, y));
  }
  EXPECT_EQ(varying_text(VaryingNumber(raster)),
            "{ raster = [[4.0, 5.0, 6.0], [1.0, 2.0, 3.0]], lower = [1.0, -2.0], step = [0.5, "
            "0.25], nearest = true }");
}

SampleFile file_of(Samples::Kind kind) {
  SampleFile file;
  file.name = "f";
  file.kind = kind;
  return file;
}

TEST(AGrid, OfEsriIsReadFromTheTopAndFromItsCorner) {
  const Samples raster = read_samples(
      "NCOLS 3\nnrows 2\nxllcorner 10\nyllcorner -1\ncellsize 2\nNODATA_value -9999\n"
      "1 2 3\n4 5 6\n",
      file_of(Samples::Kind::raster), {});
  EXPECT_THAT(raster.lower, ElementsAre(11.0, 0.0));
  EXPECT_THAT(raster.step, ElementsAre(2.0, 2.0));
  EXPECT_THAT(raster.values, ElementsAre(4, 5, 6, 1, 2, 3));
  SampleFile file = file_of(Samples::Kind::raster);
  file.factor = 1e3;
  const Samples other = read_samples(
      "ncols 1\nnrows 2\nxllcenter 10\nyllcenter -1\ndx 2\ndy 0.5\n1.5\n+2e1\n", file, {});
  EXPECT_THAT(other.lower, ElementsAre(10.0, -1.0));
  EXPECT_THAT(other.step, ElementsAre(2.0, 0.5));
  EXPECT_THAT(other.values, ElementsAre(2e4, 1.5e3));
}

struct BadFile {
  const char* text;
  Samples::Kind kind;
  std::size_t line;
  const char* found;
  friend void PrintTo(const BadFile& bad, std::ostream* out) { *out << bad.found; }
};

class BadFiles : public ::testing::TestWithParam<BadFile> {};

TEST_P(BadFiles, AreToldByTheirLine) {
  const BadFile& bad = GetParam();
  try {
    (void)read_samples(bad.text, file_of(bad.kind), at_least(0.0));
    ADD_FAILURE() << "it was read";
  } catch (const SampleError& error) {
    EXPECT_EQ(error.line(), bad.line);
    EXPECT_STREQ(error.what(), bad.found);
    EXPECT_FALSE(error.allowed().empty());
  }
}

constexpr auto table = Samples::Kind::table, raster = Samples::Kind::raster,
               points = Samples::Kind::points;
#define HEAD "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n"
INSTANTIATE_TEST_SUITE_P(
    Samples, BadFiles,
    ::testing::Values(BadFile{"", raster, 0, "found nothing in it"},
                      BadFile{"ncols 2\nrows 2\n", raster, 2, "found \"rows\""},
                      BadFile{"ncols 2\nnrows two\n", raster, 2, "found nrows without one number"},
                      BadFile{"ncols 2\nnrows 2\nxllcorner 0\ncellsize 1\n1 2\n3 4\n", raster, 0,
                              "found no yllcenter"},
                      BadFile{"ncols 2\nnrows 1.5\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n",
                              raster, 0, "found nrows = 1.5"},
                      BadFile{"ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 0\n1\n", raster,
                              0, "found cells 0 wide along x"},
                      BadFile{HEAD "1 2\n", raster, 6, "found 1 rows of values, and nrows is 2"},
                      BadFile{HEAD "1 2\n3\n", raster, 7, "found 1 values, and ncols is 2"},
                      BadFile{HEAD "1 2\n3 four\n", raster, 7, "found \"four\" in column 2"},
                      BadFile{HEAD "1 2\n-3 4\n", raster, 7, "found \"-3\" in column 1"},
                      BadFile{HEAD "1 nan\n3 4\n", raster, 6, "found \"nan\" in column 2"},
                      BadFile{HEAD "NODATA_value 4\n1 2\n3 4\n", raster, 8,
                              "found \"4\", no data, in column 2"},
                      BadFile{"y,c\n# nothing\n", table, 0, "found no values in it"},
                      BadFile{"y,c\n0,1\n1\n", table, 3, "found 1 columns"},
                      BadFile{"y,c\n0,1\n1,\n", table, 3, "found \"\" in column 2"},
                      BadFile{"0,1\n", table, 0, "found a table of one line"},
                      BadFile{"1,1\n0,2\n", table, 0, "found 1 followed by 0"},
                      BadFile{"x,y,c\n0,0,-2\n", points, 2, "found \"-2\" in column 3"},
                      BadFile{"0,0,1\n1,0,2\n0,0,3\n", points, 0, "found two points at (0, 0)"}));
#undef HEAD

}  // namespace
}  // namespace tables
