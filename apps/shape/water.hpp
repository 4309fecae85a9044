#pragma once

#include <span>

#include "shape/point.hpp"
#include "tables/diagnosis.hpp"

namespace shape {

/// Ground of one unit weight [N/m3]; a hole in it has less than none.
struct HeavyRing {
  Ring ring;
  double unit_weight = 0.0;
};

/// A pressure [Pa] at a place, and how it changes around there [Pa/m].
struct Pressure {
  double value = 0.0;
  Point gradient = Point::Zero();
};

/// The weight of the ground above a place, over the area it rests on; of regions that adjoin each
/// other, between whose corners it is linear along x.
[[nodiscard]] Pressure overburden(std::span<const HeavyRing> ground, const Point& place);

/// Whether the overburden has a value on either side of each place: it jumps below an upright face
/// with ground before and behind it. What is so is an error of the diagnosis.
/// @param key  of what asks for it
[[nodiscard]] bool has_overburden(std::span<const HeavyRing> ground, const char* key,
                                  tables::Diagnosis& diagnosis);

/// Whether a polyline is a water table over all of the ground between two corners of a box: from
/// left to right, no two points above each other. What is none is an error of `water.table`.
[[nodiscard]] bool is_water_table(const Ring& table, const Point& low, const Point& high,
                                  tables::Diagnosis& diagnosis);

}  // namespace shape
