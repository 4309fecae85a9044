#include "shape/ring.hpp"

#include <algorithm>

namespace shape {

// About the first corner, so that its digits are those of the polygon wherever that is.
double signed_area(const Ring& ring) {
  double twice = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    twice += cross(ring[k] - ring.front(), ring[(k + 1) % ring.size()] - ring.front());
  }
  return 0.5 * twice;
}

double distance(const Point& place, const Point& first, const Point& second) {
  const Point along = second - first;
  const double share = std::clamp((place - first).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (place - first - share * along).norm();
}

std::optional<Point> crossing(const Point& a, const Point& b, const Point& c, const Point& d) {
  const auto turns = [](const Point& p, const Point& q, const Point& r) {
    return cross(q - p, r - p);
  };
  const double ac = turns(a, b, c), ad = turns(a, b, d), ca = turns(c, d, a), cb = turns(c, d, b);
  if (!(ac * ad < 0.0 && ca * cb < 0.0)) return std::nullopt;
  return Point(a + ca / (ca - cb) * (b - a));
}

bool is_inside(const Ring& polygon, const Point& place) {
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const double x = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (place.x() < x) inside = !inside;
  }
  return inside;
}

bool is_inside(std::span<const Ring> rings, const Point& place) {
  return std::count_if(rings.begin(), rings.end(),
                       [&](const Ring& ring) { return is_inside(ring, place); }) %
             2 ==
         1;
}

}  // namespace shape
