#include "limit/programme/parabolas.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limit::programme {

double straightening_shift(const problem::Envelope& envelope, double u) {
  // Wide enough for differences to have digits, narrow beside anything that an envelope does.
  constexpr double wide = 1e-3;
  const problem::Envelope::Place low = envelope.at(u * (1.0 - wide)),
                                 high = envelope.at(u * (1.0 + wide));
  const double before = std::sin(low.friction_angle()), after = std::sin(high.friction_angle());
  return (high.radius() * after - low.radius() * before) / (before - after);
}

// With R0, s and P0 of the place, (R + h)^2 >= (R0 + h)^2 + 2 (R0 + h) s (P - P0) is
// h <= (R^2 - R0^2 - 2 R0 s (P - P0)) / (2 (R0 + s (P - P0) - R)) in every other place, where the
// tangent is above R.
double shift_within(const problem::Envelope& envelope, double u) {
  const problem::Envelope::Place place = envelope.at(u);
  const double touching = place.radius(), sine = std::sin(place.friction_angle());
  double least = straightening_shift(envelope, u);
  const auto look = [&](double radius, double away) {
    constexpr double straight = 1e-10;
    const double below = touching + sine * away - radius;
    if (below <= straight * touching) return;
    const double more = radius * radius - touching * touching - 2.0 * touching * sine * away;
    least = std::min(least, more / (2.0 * below));
  };
  look(0.0, -(place.centre() + envelope.apex()));
  // The quotient is smooth in log(u): what it is less between steps is less than is taken off.
  constexpr double step = 1.15, farthest = 1e6, less = 0.99;
  for (double ratio = step; ratio < farthest; ratio *= step) {
    for (const double other : {u * ratio, u / ratio}) {
      const problem::Envelope::Place there = envelope.at(other);
      look(there.radius(), there.centre() - place.centre());
    }
  }
  return std::max(0.0, less * least);
}

Parabola Parabolas::at(const problem::Soil& soil, const CurvedPoint& point, double guess,
                       problem::Bound bound) const {
  const problem::Envelope& envelope = soil.envelope;
  // Of the apex' pressure, far more than its rounding and than the reserve of the cones.
  constexpr double least = 1e-5;
  const double u = std::max(envelope.told_by_circle(pressure_near(point).value_or(guess)),
                            least * envelope.cohesive);
  const problem::Envelope::Place place = envelope.at(u);
  // An envelope that is next to straight would have one without end.
  constexpr double most = 1e3;
  const double shift = std::min(
      bound == problem::Bound::lower ? shift_within(envelope, u) : straightening_shift(envelope, u),
      most * place.radius());
  return {shift, place.centre(), place.radius(), std::sin(place.friction_angle())};
}

std::optional<double> Parabolas::pressure_near(const CurvedPoint& point) const {
  const auto found = known_.find({point.region, point.is_jump});
  if (found == known_.end() || found->second.empty()) return std::nullopt;
  const std::vector<Known>& all = found->second;
  // To the left and to the right as far as the nearest one so far.
  const auto right =
      std::lower_bound(all.begin(), all.end(), point.place.x(),
                       [](const Known& known, double x) { return known.place.x() < x; });
  double least = std::numeric_limits<double>::infinity(), pressure = 0.0;
  const auto look = [&](const Known& known) {
    const double away = known.place.x() - point.place.x();
    if (away * away >= least) return false;
    const double distance = (known.place - point.place).squaredNorm();
    if (distance < least) {
      least = distance;
      pressure = known.pressure;
    }
    return true;
  };
  for (auto at = right; at != all.end() && look(*at); ++at) {
  }
  for (auto at = right; at != all.begin() && look(*std::prev(at)); --at) {
  }
  return pressure;
}

void Parabolas::take(const std::vector<CurvedPoint>& points, const Eigen::VectorXd& variables) {
  known_.clear();
  for (const CurvedPoint& point : points) {
    known_[{point.region, point.is_jump}].push_back({point.place, -variables[point.variable]});
  }
  for (auto& [of, all] : known_) {
    std::stable_sort(all.begin(), all.end(), [](const Known& one, const Known& other) {
      return one.place.x() < other.place.x();
    });
  }
}

mesh::Point towards(const mesh::Point& from, const mesh::Point& to) {
  constexpr double share = 0.1;
  return from + share * (to - from);
}

}  // namespace limit::programme
