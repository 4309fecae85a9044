// A box with parts cut out: what of it is in a cell, and the pieces of its surface.
#include "shape/body.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace shape {
namespace {

using ::testing::HasSubstr;

constexpr double round_off = 1e-12;

const Ring triangle{{0.2, -0.5}, {2.0, -0.5}, {2.0, 1.2}};  // its long side cuts a corner off

// sum s = 0 and sum s x X = |Omega| I, with the body to the left of every segment.
void expect_closed(const Body& body) {
  Point sum = Point::Zero();
  Eigen::Matrix2d moment = Eigen::Matrix2d::Zero();
  for (const SurfaceSegment& s : body.surface()) {
    const Point along = s.to - s.from;
    const Point area(along.y(), -along.x());
    sum += area;
    moment += area * (0.5 * (s.from + s.to)).transpose();
  }
  EXPECT_LT(sum.norm(), round_off);
  EXPECT_LT((moment - body.area() * Eigen::Matrix2d::Identity()).norm(), round_off);
}

TEST(Body, OfNoCutsIsItsBox) {
  const Body body({-1.0, 0.0}, {1.0, 1.0}, {});
  EXPECT_DOUBLE_EQ(body.area(), 2.0);
  EXPECT_EQ(body.pieces(), 1U);
  EXPECT_EQ(body.surface().size(), 4U);
  EXPECT_EQ(body.within({0.0, 0.0}, {0.5, 0.25}).area, 0.125);
  EXPECT_EQ(body.distance_to_hollows({0.0, 0.0}, {0.5, 0.25}),
            std::numeric_limits<double>::infinity());
  expect_closed(body);
}

TEST(Body, LosesWhatIsInsideARingOrOutsideIt) {
  const Body without({0.0, 0.0}, {1.0, 1.0}, {{triangle, false}});
  const Body only({0.0, 0.0}, {1.0, 1.0}, {{triangle, true}});
  EXPECT_NEAR(without.area() + only.area(), 1.0, round_off);
  expect_closed(without);
  expect_closed(only);
}

TEST(Body, HasASurfaceThatSaysWhereItIsFrom) {
  const Body body({0.0, 0.0}, {2.0, 2.0},
                  {{circle({1.0, 1.0}, 0.4, 1e-4), false}, {triangle, false}});
  expect_closed(body);
  std::map<int, double> length;
  for (const SurfaceSegment& s : body.surface()) {
    EXPECT_EQ(s.cut < 0, s.face >= 0);
    length[s.cut < 0 ? -1 - s.face : s.cut] += (s.to - s.from).norm();
  }
  EXPECT_NEAR(length[-1], 2.0, round_off);  // left
  EXPECT_NEAR(length[-4], 2.0, round_off);  // top
  EXPECT_NEAR(length[-2], 0.8, round_off);  // right, above the triangle
  EXPECT_NEAR(length[0], 0.8 * M_PI, 1e-3);
  // The triangle's long side leaves the bottom where it has risen by 0.5.
  const double corner = 0.2 + 0.5 * 1.8 / 1.7;
  EXPECT_NEAR(length[-3], corner, round_off);
  EXPECT_NEAR(length[1], std::hypot(2.0 - corner, 1.2), round_off);
}

// An edge through the corners of cells, which Boost's intersection with a box does not bear.
TEST(Body, IsPartedByEdgesThroughCornersOfCells) {
  const Body body(
      {0.0, 0.0}, {3.0, 2.0},
      {{{{0.0, 0.8}, {3.0, 0.4}, {3.0, 0.6}, {2.4, 0.6}, {1.0, 2.0}, {0.0, 2.0}}, true}});
  double area = 0.0;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 20; ++j) {
      const double width = 0.1;
      const Part part = body.within(Point(i, j) * width, Point(i + 1, j + 1) * width);
      EXPECT_LE(part.area, width * width * (1.0 + 1e-12));
      area += part.area;
    }
  }
  EXPECT_NEAR(area, body.area(), 1e-12);
  EXPECT_NEAR(area, 3.0 * 0.6 + 0.5 * (1.0 + 2.4) * 1.4 - 0.5 * 3.0 * (0.8 + 0.4), 1e-12);
}

// The parts of the cells of any grid are the body.
TEST(Body, IsTheSumOfItsParts) {
  const Body body({0.0, 0.0}, {1.0, 1.0},
                  {{circle({0.6, 0.7}, 0.23, 1e-5), false}, {triangle, false}});
  double area = 0.0;
  Point moment = Point::Zero();
  constexpr int cells = 7;
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      const Part part = body.within(Point(i, j) / cells, Point(i + 1, j + 1) / cells);
      area += part.area;
      moment += part.area * part.centroid;
    }
  }
  EXPECT_NEAR(area, body.area(), round_off);
  Point expected = Point::Zero();  // by the surface: half of x^2 n, y^2 n
  for (const SurfaceSegment& s : body.surface()) {
    const Point along = s.to - s.from;
    const Point normal(along.y(), -along.x());
    const auto square = [&](int k) {  // Simpson's rule is exact
      const double m = 0.5 * (s.from[k] + s.to[k]);
      return (s.from[k] * s.from[k] + 4.0 * m * m + s.to[k] * s.to[k]) / 6.0;
    };
    for (int k = 0; k < 2; ++k) expected[k] += 0.5 * square(k) * normal[k];
  }
  EXPECT_LT((moment - expected).norm(), round_off);
}

TEST(Body, CutsLinesToo) {
  const Body body({0.0, 0.0}, {2.0, 2.0}, {{circle({0.0, 0.0}, 1.0, 1e-6), false}});
  const Stretch stretch = body.along({0.0, 0.5}, {2.0, 0.5});
  const double at = std::sqrt(0.75);
  EXPECT_NEAR(stretch.length, 2.0 - at, 1e-5);
  EXPECT_NEAR(stretch.middle.x(), 0.5 * (2.0 + at), 1e-5);
  EXPECT_EQ(body.along({0.0, 0.1}, {0.5, 0.1}).length, 0.0);
  EXPECT_NEAR(body.distance_to_hollows({1.0, 1.0}, {2.0, 2.0}), std::sqrt(2.0) - 1.0, 1e-5);
}

TEST(Circle, HasItsCornersOnItAndNoChordFurtherThanTheSagitta) {
  for (const double sagitta : {1e-2, 1e-5}) {
    const Ring ring = circle({1.0, -2.0}, 0.5, sagitta);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      EXPECT_NEAR((ring[k] - Point(1.0, -2.0)).norm(), 0.5, round_off);
      const Point middle = 0.5 * (ring[k] + ring[(k + 1) % ring.size()]);
      EXPECT_LE(0.5 - (middle - Point(1.0, -2.0)).norm(), sagitta * (1.0 + 1e-9));
    }
  }
}

TEST(Ring, IsObjectedToWithAReason) {
  EXPECT_EQ(objection(triangle), "");
  EXPECT_EQ(objection({triangle[2], triangle[1], triangle[0]}), "");  // either way around
  EXPECT_THAT(objection({{0.0, 0.0}, {1.0, 0.0}}), HasSubstr("fewer than three"));
  EXPECT_THAT(objection({{0.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}, {0.0, 1.0}}), HasSubstr("crosses"));
  EXPECT_NE(objection({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}), "");  // no area
  EXPECT_THAT(objection({{0.0, 0.0}, {1.0, 0.0}, {1.0, std::nan("")}}), HasSubstr("finite"));
  EXPECT_THROW(Body({0.0, 0.0}, {1.0, 1.0}, {{{{0.0, 0.0}, {1.0, 0.0}}, false}}),
               std::invalid_argument);
}

TEST(Body, MayFallApart) {
  const Ring stripe{{0.4, -1.0}, {0.6, -1.0}, {0.6, 2.0}, {0.4, 2.0}};
  EXPECT_EQ(Body({0.0, 0.0}, {1.0, 1.0}, {{stripe, false}}).pieces(), 2U);
}

}  // namespace
}  // namespace shape
