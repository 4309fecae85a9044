#include "limit/programme/polygons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace limit::programme {

namespace {

// The circles that touch an envelope in two places; the line through them.
Line chord(const problem::Envelope::Place& first, const problem::Envelope::Place& second) {
  const double slope = (second.radius() - first.radius()) / (second.centre() - first.centre());
  return {first.radius() - slope * first.centre(), slope};
}

Line tangent(const problem::Envelope::Place& place) {
  const double slope = std::sin(place.friction_angle());
  return {place.radius() - slope * place.centre(), slope};
}

// No circle within all of these is beyond the envelope, which is concave: it has one of the radii
// of its circles between two of them, and no less than the last one's beyond it.
std::vector<Line> chords(const problem::Envelope& envelope, double middle, double ratio) {
  std::array<problem::Envelope::Place, 4> corners;
  for (std::size_t i = 0; i < 4; ++i) {
    corners[i] = envelope.at(middle * std::pow(ratio, static_cast<double>(i) - 1.5));
  }
  problem::Envelope::Place apex;
  apex.normal = -envelope.apex();
  return {chord(corners[1], corners[2]), chord(corners[0], corners[1]),
          chord(corners[2], corners[3]), chord(apex, corners[0]), Line{corners[3].radius(), 0.0}};
}

std::vector<Line> tangents(const problem::Envelope& envelope, double middle, double ratio) {
  std::vector<Line> lines;
  for (const double power : {0.0, -1.0, 1.0, -2.0, 2.0}) {
    lines.push_back(tangent(envelope.at(middle * std::pow(ratio, power))));
  }
  return lines;
}

}  // namespace

std::vector<Line> Polygons::lines(const problem::Soil& soil, const CurvedPoint& point, double guess,
                                  Polygon kind) const {
  const double pressure = pressure_near(point).value_or(guess);
  const double middle = soil.envelope.told_by_circle(pressure);
  return kind == Polygon::chords ? chords(soil.envelope, middle, ratio_)
                                 : tangents(soil.envelope, middle, ratio_);
}

std::optional<double> Polygons::pressure_near(const CurvedPoint& point) const {
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

void Polygons::take(const std::vector<CurvedPoint>& points, const Eigen::VectorXd& variables) {
  known_.clear();
  for (const CurvedPoint& point : points) {
    known_[{point.region, point.is_jump}].push_back({point.place, -variables[point.variable]});
  }
  for (auto& [of, all] : known_) {
    std::stable_sort(all.begin(), all.end(), [](const Known& one, const Known& other) {
      return one.place.x() < other.place.x();
    });
  }
  // A chord from u to r u is a (1 - a) (log r)^2 / 8 below the envelope, at most: 0.16 % at 1.25.
  constexpr double finest = 1.25;
  ratio_ = std::max(finest, std::sqrt(ratio_) * 0.7);
}

mesh::Point towards(const mesh::Point& from, const mesh::Point& to) {
  constexpr double share = 0.1;
  return from + share * (to - from);
}

}  // namespace limit::programme
