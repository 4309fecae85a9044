#include "study/levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace study {

namespace {

/// The numbers of cells that must stay whole: of the extents, and of the places that are whole now.
class WholeNumbers {
 public:
  explicit WholeNumbers(const scene::Geometry& geometry) : geometry_(geometry) {
    for (std::size_t axis = 0; axis < geometry.max.size(); ++axis) {
      add(geometry.max[axis] - geometry.min[axis]);
    }
  }

  /// A place along an axis; one at an end of the body says nothing.
  void place(double at, std::size_t axis) {
    if (axis < geometry_.min.size()) add(at - geometry_.min[axis]);
  }
  void places(const scene::Point& point) {
    for (std::size_t axis = 0; axis < point.size(); ++axis) place(point[axis], axis);
  }
  /// A range on a side: of the axes that are left.
  void range(const scene::Point& point, scene::Side side) {
    std::size_t k = 0;
    for (std::size_t axis = 0; axis < geometry_.min.size() && k < point.size(); ++axis) {
      if (static_cast<int>(axis) != scene::axis_of(side)) place(point[k++], axis);
    }
  }

  /// A length that cells resolve without being whole in it.
  void length(double value) {
    least_ = std::min(least_, static_cast<std::int64_t>(std::floor(value / geometry_.spacing)));
  }

  [[nodiscard]] std::int64_t divisor() const { return divisor_; }
  [[nodiscard]] std::int64_t least() const { return std::max<std::int64_t>(least_, 1); }

 private:
  void add(double length) {
    const double cells = length / geometry_.spacing;
    const auto whole = static_cast<std::int64_t>(std::llround(cells));
    constexpr double exact = 1e-6;
    if (whole <= 0 || std::abs(cells - static_cast<double>(whole)) > exact) return;
    divisor_ = std::gcd(divisor_, whole);
    least_ = least_ == 0 ? whole : std::min(least_, whole);
  }

  const scene::Geometry& geometry_;
  std::int64_t divisor_ = 0;
  std::int64_t least_ = 0;
};

}  // namespace

std::vector<double> spacings_on_offer(const scene::Scene& scene) {
  WholeNumbers numbers(scene.geometry);
  numbers.range(scene.drive.range_min, scene.drive.side);
  numbers.range(scene.drive.range_max, scene.drive.side);
  for (const scene::Traction& traction : scene.traction) {
    numbers.range(traction.range_min, traction.side);
    numbers.range(traction.range_max, traction.side);
  }
  for (const scene::Material& material : scene.material) {
    numbers.places(material.region_min);
    numbers.places(material.region_max);
  }
  for (const scene::Cutout& cutout : scene.cutout) {
    if (cutout.radius) numbers.length(*cutout.radius);
  }
  const std::int64_t divisor = numbers.divisor();
  // With fewer cells across the least of them, values are not on their way to the limit yet.
  constexpr double fewest = 6.0;
  constexpr double ratio = 1.5;
  constexpr std::int64_t finest = 8;  // times finer than the scene's own
  std::vector<double> spacings;
  auto k = static_cast<std::int64_t>(
      std::ceil(fewest * static_cast<double>(divisor) / static_cast<double>(numbers.least())));
  for (; k <= finest * divisor;
       k = static_cast<std::int64_t>(std::ceil(ratio * static_cast<double>(k)))) {
    spacings.push_back(scene.geometry.spacing * static_cast<double>(divisor) /
                       static_cast<double>(k));
  }
  return spacings;
}

}  // namespace study
