// Regions with holes, joined.
#include "shape/outline.hpp"

#include <gmock/gmock.h>

#include "shape/body.hpp"

namespace shape {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const Ring square{{0.0, 0.0}, {4.0, 0.0}, {4.0, 4.0}, {0.0, 4.0}};
const Ring first{{1.0, 1.0}, {1.0, 2.0}, {2.0, 2.0}, {2.0, 1.0}};  // clockwise
const Ring second{{3.0, 3.0}, {3.5, 3.0}, {3.0, 3.5}};             // counterclockwise

Ring closed(Ring ring) {
  ring.push_back(ring.front());
  return ring;
}

TEST(Outline, HasHolesClockwise) {
  const NamedRegion region{"clay", square, {first, second}};
  const NamedLine sides[] = {
      {"rim", closed(square)}, {"first", closed(first)}, {"second", closed(second)}};
  tables::Diagnosis diagnosis("s");
  const Outline outline = join_regions({&region, 1}, sides, diagnosis);
  ASSERT_TRUE(diagnosis.errors().empty()) << diagnosis.errors()[0].text();
  EXPECT_DOUBLE_EQ(outline.area, 16.0 - 1.0 - 0.125);
  EXPECT_EQ(outline.segments.size(), 4U + 4U + 3U);
  const std::vector<Ring> rings = outline.rings(0);
  EXPECT_TRUE(is_inside(rings, {0.5, 0.5}));
  EXPECT_FALSE(is_inside(rings, {1.5, 1.5}));
  EXPECT_FALSE(is_inside(rings, {3.1, 3.1}));
  const Body body(outline, {0.0, 0.0}, {4.0, 4.0}, {});
  EXPECT_DOUBLE_EQ(body.area(), outline.area);
  EXPECT_DOUBLE_EQ(body.within({0.5, 0.5}, {1.5, 1.5}).area, 0.75);
  // The ground is to the left of every piece, of holes as well.
  Point sum = Point::Zero();
  double area = 0.0;
  for (const SurfaceSegment& s : body.surface()) {
    const Point along = s.to - s.from;
    sum += along;
    area += 0.5 * (s.from.x() * s.to.y() - s.from.y() * s.to.x());
    EXPECT_EQ(s.side, s.from.maxCoeff() > 2.5 && s.to.minCoeff() >= 3.0 && s.face < 0 ? 2
                      : s.face < 0                                                    ? 1
                                                                                      : 0);
  }
  EXPECT_LT(sum.norm(), 1e-14);
  EXPECT_DOUBLE_EQ(area, outline.area);
}

TEST(Outline, HasHolesThatOtherRegionsFill) {
  const NamedRegion regions[] = {{"clay", square, {first}}, {"sand", first, {}}};
  const NamedLine side{"rim", closed(square)};
  tables::Diagnosis diagnosis("s");
  const Outline outline = join_regions(regions, {&side, 1}, diagnosis);
  ASSERT_TRUE(diagnosis.errors().empty()) << diagnosis.errors()[0].text();
  EXPECT_DOUBLE_EQ(outline.area, 16.0);
  const Body body(outline, {0.0, 0.0}, {4.0, 4.0}, {});
  ASSERT_EQ(body.joints().size(), 4U);
  EXPECT_EQ(body.pieces(), 1U);
}

std::vector<std::string> errors_with(const std::vector<Ring>& holes) {
  const NamedRegion region{"clay", square, holes};
  const NamedLine side{"rim", closed(square)};
  tables::Diagnosis diagnosis("s");
  (void)join_regions({&region, 1}, {&side, 1}, diagnosis);
  std::vector<std::string> texts;
  for (const auto& error : diagnosis.errors()) texts.push_back(error.text());
  return texts;
}

TEST(Outline, RefusesHolesThatAreNone) {
  EXPECT_THAT(errors_with({first}),
              ElementsAre(HasSubstr("no [[side]] names the outline of a hole")));
  EXPECT_THAT(errors_with({{{5.0, 5.0}, {6.0, 5.0}, {5.0, 6.0}}}),
              ElementsAre(HasSubstr("region.0.holes: the hole at (5, 6) is outside the outline")));
  const Ring inner{{1.2, 1.2}, {1.8, 1.2}, {1.5, 1.8}};
  EXPECT_THAT(errors_with({first, inner}), ElementsAre(HasSubstr("is in another one")));
  EXPECT_THAT(errors_with({{{1.0, 1.0}, {5.0, 1.0}, {1.0, 3.0}}}),
              ElementsAre(HasSubstr("region.0.holes: the polygon crosses itself at (4, 1.5)")));
  EXPECT_THAT(errors_with({{{0.0, 0.0}, {2.0, 1.0}, {1.0, 2.0}}}),
              ElementsAre(HasSubstr("region.0.holes: the polygon touches itself at (0, 0)")));
  EXPECT_THAT(errors_with({{{1.0, 1.0}, {2.0, 2.0}}}),
              ElementsAre(HasSubstr("region.0.holes: found 2 points")));
}

}  // namespace
}  // namespace shape
