// Pressures that are told from place to place, and triangles between points.
#include "shape/pressure_field.hpp"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <random>
#include <string>

#include "shape/ring.hpp"
#include "shape/triangulation.hpp"

namespace shape {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double rounding = 1e-9;

const Ring square{{0, 0}, {4, 0}, {4, 2}, {0, 2}};

std::vector<Point> random_points(int count) {
  std::mt19937 numbers(7);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Point> points(square.begin(), square.end());
  for (int i = 0; i < count; ++i) points.emplace_back(4.0 * share(numbers), 2.0 * share(numbers));
  return points;
}

double area_of(const std::vector<Point>& points, const std::array<int, 3>& triangle) {
  Ring ring;
  for (const int node : triangle) ring.push_back(points[static_cast<std::size_t>(node)]);
  return signed_area(ring);
}

// No point is within the circle through a triangle's corners (Delaunay's property); the test of it
// is the determinant of lifted points.
TEST(TrianglesBetweenPoints, AreDelaunaysAndFillTheirHull) {
  const std::vector<Point> points = random_points(60);
  const auto triangles = triangles_between(points);
  EXPECT_EQ(triangles.size(), 2U * 64U - 2U - 4U) << "Euler: 2 n - 2 less the hull's corners";
  double area = 0.0;
  for (const auto& triangle : triangles) {
    area += area_of(points, triangle);
    const auto at = [&](std::size_t i) { return points[static_cast<std::size_t>(triangle[i])]; };
    for (const Point& other : points) {
      Eigen::Matrix3d lifted;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point way = at(i) - other;
        lifted.row(static_cast<Eigen::Index>(i)) << way.x(), way.y(), way.squaredNorm();
      }
      EXPECT_LE(lifted.determinant(), rounding);
    }
  }
  EXPECT_NEAR(area, 8.0, rounding);
}

TEST(TrianglesBetweenPoints, FillALatticeWhosePointsAreOnCircles) {
  std::vector<Point> points;
  for (int i = 0; i <= 8; ++i) {
    for (int j = 0; j <= 4; ++j) points.emplace_back(0.5 * i, 0.5 * j);
  }
  double area = 0.0;
  const auto triangles = triangles_between(points);
  for (const auto& triangle : triangles) area += area_of(points, triangle);
  EXPECT_EQ(triangles.size(), 64U);
  EXPECT_NEAR(area, 8.0, rounding);
}

TEST(TrianglesBetweenPoints, AreNoneOnOneLine) {
  EXPECT_THAT(triangles_between(std::vector<Point>{{0, 0}, {1, 0.3}, {2, 0.6}, {4, 1.2}}),
              IsEmpty());
  EXPECT_THAT(triangles_between(std::vector<Point>{{0, 0}, {1, 0}}), IsEmpty());
}

// What the mean of the gradient over a polygon, its wet part and its area come to.
struct Sum {
  Point gradient = Point::Zero();
  double wet = 0.0, area = 0.0;
};

Sum sum_over(const PressureField& field, const Ring& polygon) {
  Sum sum;
  for (const auto& piece : field.within(polygon)) {
    sum.area += piece.area;
    sum.wet += piece.wet ? piece.area : 0.0;
    sum.gradient += piece.area * piece.gradient;
    for (const Point& corner : piece.ring) {
      EXPECT_NEAR(field.at(corner), piece.value + piece.gradient.dot(corner - piece.ring[0]),
                  rounding * 1e4);
    }
  }
  return sum;
}

tables::VaryingNumber points_of(double value, const Point& gradient) {
  std::vector<std::array<double, 3>> told;
  for (const Point& place : random_points(40)) {
    told.push_back({place.x(), place.y(), value + gradient.dot(place)});
  }
  return tables::VaryingNumber(tables::point_samples(told));
}

tables::VaryingNumber raster_of(double value, const Point& gradient) {
  tables::Samples raster;
  raster.kind = tables::Samples::Kind::raster;
  raster.columns = 9;
  raster.step = {0.5, 0.5};
  raster.values.resize(45);
  for (std::size_t i = 0; i < raster.values.size(); ++i) {
    const auto place = raster.place(i);
    raster.values[i] = value + gradient.dot(Point(place[0], place[1]));
  }
  return tables::VaryingNumber(raster);
}

// Whoever tells it, what is linear is linear between, and suction is none: below a line aslant
// there is what there is below a water table.
TEST(ToldPressure, IsLinearBetweenItsValuesAndNoSuction) {
  const double value = 12e3;
  const Point gradient(-2e3, -10e3);
  for (const auto& told : {tables::VaryingNumber(value, {0.0, 0.0}, {gradient.x(), gradient.y()}),
                           points_of(value, gradient), raster_of(value, gradient)}) {
    const PressureField field(told);
    EXPECT_NEAR(field.at({1.0, 0.5}), 5e3, rounding * 1e4);
    EXPECT_EQ(field.at({1.0, 1.5}), 0.0);
    if (told.samples) {
      EXPECT_NEAR(field.at({-1.0, 0.5}), field.at({0.0, 0.5}), rounding * 1e4) << "the nearest";
    }
    // Zero from (0, 1.2) to (4, 0.4).
    const Sum all = sum_over(field, square);
    EXPECT_NEAR(all.area, 8.0, rounding);
    EXPECT_NEAR(all.wet, 3.2, rounding);
    EXPECT_LT((all.gradient - 3.2 * gradient).norm(), rounding * 1e4);
    const Sum part = sum_over(field, {{0.9, 1.0}, {1.3, 0.9}, {1.2, 1.2}});
    EXPECT_NEAR(part.area, 0.055, rounding);
  }
}

TEST(ToldPressure, OfATableIsLinearBetweenItsLines) {
  // Artesian below a layer: 30 kPa at the bottom, 20 at its underside, none at the top.
  const PressureField field{tables::VaryingNumber(
      tables::table_samples({{0.0, 30e3}, {1.0, 20e3}, {2.0, 0.0}}, 1, std::nullopt))};
  EXPECT_NEAR(field.at({3.0, 1.5}), 10e3, rounding * 1e4);
  const Sum all = sum_over(field, square);
  EXPECT_NEAR(all.area, 8.0, rounding);
  EXPECT_NEAR(all.gradient.y(), -4.0 * 30e3, rounding * 1e5) << "by Gauss: what it falls by";
  EXPECT_EQ(all.gradient.x(), 0.0);
  EXPECT_EQ(field.at({0.0, -1.0}), 30e3);
}

std::string complaint_of(const tables::VaryingNumber& told) {
  tables::Diagnosis diagnosis("s.toml");
  const bool is_one = is_pressure_of(told, square, "water.pore_pressure", diagnosis);
  EXPECT_EQ(is_one, diagnosis.errors().empty());
  return is_one ? "" : diagnosis.errors().front().text();
}

TEST(ToldPressure, IsOfAllOfTheGround) {
  using tables::VaryingNumber;
  EXPECT_EQ(complaint_of(points_of(30e3, {0.0, -10e3})), "");
  EXPECT_EQ(complaint_of(raster_of(30e3, {0.0, -10e3})), "");
  EXPECT_EQ(complaint_of(5e3), "");
  EXPECT_EQ(complaint_of(0.0), "") << "none";
  EXPECT_THAT(complaint_of(VaryingNumber(tables::point_samples(
                  {{0.0, 0.0, 1e4}, {4.0, 0.0, 1e4}, {4.0, 2.0, 0.0}, {1.0, 2.0, 0.0}}))),
              HasSubstr("water.pore_pressure: told of nothing at (0, 2), a corner of the ground; "
                        "allowed are values all over the ground, up to its corners"));
  EXPECT_THAT(complaint_of(VaryingNumber(
                  tables::point_samples({{0.0, 0.0, 2e4}, {0.0, 1.0, 1e4}, {0.0, 2.0, 0.0}}))),
              HasSubstr("found points on one line, or less than three"));
  EXPECT_THAT(
      complaint_of(VaryingNumber(tables::table_samples({{0.0, 1e4}, {1.5, 0.0}}, 1, std::nullopt))),
      HasSubstr("told of nothing at (4, 2)"));
  EXPECT_THAT(complaint_of(-5e3), HasSubstr("found nothing above zero, but -5000; water presses "
                                            "with more than zero"));
  tables::Samples raster;
  raster.kind = tables::Samples::Kind::raster;
  raster.lower = {0.25, 0.25};
  raster.step = {0.5, 0.5};
  raster.columns = 8;
  raster.values.assign(32, 1e3);
  EXPECT_THAT(complaint_of(VaryingNumber(raster)),
              HasSubstr("told of nothing at (0, 0), a corner of the ground; allowed are values all "
                        "over the ground, between the middles of the raster's outermost cells"));
  tables::Samples cells = raster;
  cells.nearest = true;
  EXPECT_THAT(complaint_of(VaryingNumber(cells)),
              HasSubstr("found a raster of one value in each cell; the gradient of the pressure is "
                        "a force"));
  raster.values.resize(8);
  EXPECT_THAT(complaint_of(VaryingNumber(raster)),
              HasSubstr("found a raster of one row or column"));
}

}  // namespace
}  // namespace shape
