#include "scene/places.hpp"

#include <algorithm>
#include <cmath>

namespace scene {

namespace {

double first_place(const Geometry& geometry) {
  return geometry.layout == Layout::cell ? 0.5 : 0.0;
}

LatticeBox whole(const Geometry& geometry) {
  LatticeBox box;
  const auto counts = lattice_counts(geometry);
  for (std::size_t i = 0; i < counts.size(); ++i) box.last[i] = counts[i] - 1;
  return box;
}

/// Narrows a box to the particles from `min` to `max` along an axis.
void narrow(LatticeBox& box, const Geometry& geometry, std::size_t axis, double min, double max) {
  const double slack = same_place(geometry) / geometry.spacing + geometry.jitter;
  const auto index = [&](double at) {
    return (at - geometry.min[axis]) / geometry.spacing - first_place(geometry);
  };
  // Held by a 64-bit number, whatever the place.
  const auto kept = [&](double value) {
    return static_cast<std::int64_t>(
        std::clamp(value, -1.0, static_cast<double>(box.last[axis]) + 1.0));
  };
  box.first[axis] = std::max(box.first[axis], kept(std::ceil(index(min) - slack)));
  box.last[axis] = std::min(box.last[axis], kept(std::floor(index(max) + slack)));
}

}  // namespace

bool LatticeBox::empty() const {
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] > last[i]) return true;
  }
  return false;
}

bool LatticeBox::meets(const LatticeBox& other) const {
  LatticeBox both = *this;
  for (std::size_t i = 0; i < first.size(); ++i) {
    both.first[i] = std::max(first[i], other.first[i]);
    both.last[i] = std::min(last[i], other.last[i]);
  }
  return !both.empty();
}

LatticeBox lattice_box(const Geometry& geometry, const Point& min, const Point& max) {
  LatticeBox box = whole(geometry);
  for (std::size_t i = 0; i < min.size(); ++i) narrow(box, geometry, i, min[i], max[i]);
  return box;
}

LatticeBox lattice_layer(const Geometry& geometry, Side side, const Point& range_min,
                         const Point& range_max) {
  LatticeBox box = whole(geometry);
  const auto normal = static_cast<std::size_t>(axis_of(side));
  (is_upper(side) ? box.first : box.last)[normal] = is_upper(side) ? box.last[normal] : 0;
  for (std::size_t axis = 0, i = 0; axis < geometry.min.size() && !range_min.empty(); ++axis) {
    if (axis == normal) continue;
    narrow(box, geometry, axis, range_min[i], range_max[i]);
    ++i;
  }
  return box;
}

LatticeBox lattice_box(const Geometry& geometry, const Support& support) {
  if (support.side) return lattice_layer(geometry, *support.side, {}, {});
  if (support.at.empty()) return lattice_box(geometry, support.region_min, support.region_max);
  LatticeBox box = whole(geometry);
  for (std::size_t i = 0; i < support.at.size(); ++i) {
    const double at = (support.at[i] - geometry.min[i]) / geometry.spacing - first_place(geometry);
    // Halfway between two, the first.
    const double half = 0.5 + same_place(geometry) / geometry.spacing;
    box.first[i] = box.last[i] =
        std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil(at - half)), 0, box.last[i]);
  }
  return box;
}

}  // namespace scene
