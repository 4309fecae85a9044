#include "limit/programme/tangents.hpp"

#include <algorithm>
#include <limits>

namespace limit::programme {

std::optional<double> Tangents::pressure_near(int region, bool is_jump,
                                              const mesh::Point& place) const {
  const auto found = known_.find({region, is_jump});
  if (found == known_.end() || found->second.empty()) return std::nullopt;
  const std::vector<Known>& all = found->second;
  // To the left and to the right as far as the nearest one so far.
  const auto right =
      std::lower_bound(all.begin(), all.end(), place.x(),
                       [](const Known& known, double x) { return known.place.x() < x; });
  double least = std::numeric_limits<double>::infinity(), pressure = 0.0;
  const auto look = [&](const Known& known) {
    const double away = known.place.x() - place.x();
    if (away * away >= least) return false;
    const double distance = (known.place - place).squaredNorm();
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

void Tangents::take(const std::vector<Touch>& touches, const Eigen::VectorXd& variables) {
  known_.clear();
  for (const Touch& touch : touches) {
    known_[{touch.region, touch.is_jump}].push_back({touch.place, -variables[touch.variable]});
  }
  for (auto& [of, all] : known_) {
    std::stable_sort(all.begin(), all.end(), [](const Known& one, const Known& other) {
      return one.place.x() < other.place.x();
    });
  }
}

void Tangents::draw_in() {
  constexpr double first = 1e-4, more = 5.0, most = 0.02;
  reserve_ = std::clamp(more * reserve_, first, most);
}

Tangent touched(const problem::Soil& soil, bool is_jump, double pressure) {
  const problem::Envelope::Place place =
      is_jump ? soil.envelope.under(pressure) : soil.envelope.touched_by_circle(pressure);
  Tangent tangent{soil.with_cohesion(place.cohesion()), is_jump ? place.normal : place.centre()};
  tangent.soil.friction_angle = place.friction_angle();
  return tangent;
}

mesh::Point towards(const mesh::Point& from, const mesh::Point& to) {
  constexpr double share = 0.1;
  return from + share * (to - from);
}

}  // namespace limit::programme
