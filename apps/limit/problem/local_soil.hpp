#pragma once

#include <array>

#include "limit/problem/problem.hpp"

namespace limit::problem {

/// Which strength stands for one that varies: one that is less everywhere, or more.
enum class Bound { lower, upper };

/// A soil with a linear cohesion and one friction angle that bounds a given one everywhere in a
/// triangle; a soil that is no more than that is returned as it is.
///
/// With the apex a = c / tan(phi) at a place, the strength under the mean pressure p is
/// (a + p) sin(phi): more of a and more of phi are more strength wherever there is any. So the
/// least angle and the least apex, linear as the cohesion is, c / tan(largest phi), bound it from
/// below, and the largest of both from above.
[[nodiscard]] Soil soil_within(const Soil& soil, const std::array<mesh::Point, 3>& corners,
                               Bound bound);

/// The same of the soil of a triangle.
[[nodiscard]] Soil soil_in(const Problem& problem, const mesh::Triangle& triangle, Bound bound);

/// The region, of those on both sides, in whose soil the velocity jumps there: the softer one.
[[nodiscard]] int region_across(const Problem& problem, const mesh::Edge& edge);

/// A soil that bounds from above, along all of a side, that in which the velocity jumps there.
[[nodiscard]] Soil soil_across(const Problem& problem, const mesh::Edge& edge);

/// A soil as it is at a place, and the same everywhere.
[[nodiscard]] Soil soil_at(const Soil& soil, const mesh::Point& place);

}  // namespace limit::problem
