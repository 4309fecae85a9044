#include "limit/ground/ground_lift.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "limit/ground/ground_cut.hpp"
#include "limit/ground/ground_pressure.hpp"
#include "shape/outline.hpp"
#include "shape/water.hpp"

namespace limit::ground {

namespace {

constexpr double rounding = 1e-3;  // of the largest pressure: of points written with few digits

// [Pa] What differences are held against: of what is linear, the largest is known of places alone.
double largest_of(const GroundOutline& outline, const shape::PressureField& field) {
  double largest = field.largest();
  for (const mesh::Point& place : outline.points) largest = std::max(largest, field.at(place));
  return largest;
}

// A water's unit weight in a scene's units, where those are known.
std::optional<double> weight_of_water(const problem::UnitNames& units) {
  if (units.length != "m") return std::nullopt;
  if (units.stress == "Pa") return 9810.0;
  if (units.stress == "kPa") return 9.81;
  return std::nullopt;
}

void say_standing(const GroundScene& scene, const GroundOutline& outline,
                  const shape::PressureField& field, problem::Case& result) {
  double most = rounding * largest_of(outline, field);
  std::string words;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    if (side.kind != SideKind::free && side.kind != SideKind::loaded) continue;
    for (const int end : {segment.first, segment.second}) {
      const mesh::Point& place = outline.at(end);
      const double pressure = field.at(place);
      if (pressure <= most) continue;
      most = pressure;
      words = fmt::format(
          "water stands on the side \"{}\", as told: with up to {:.6g} {}, at "
          "({:.6g}, {:.6g})",
          side.name, pressure, scene.units.stress, place.x(), place.y());
      if (const auto weight = weight_of_water(scene.units)) {
        words += fmt::format(", {:.3g} m deep", pressure / *weight);
      }
    }
  }
  if (!words.empty()) result.notes.push_back(words);
}

// [Pa] Of what is told the most above the ground straight above, the water on that and the largest
// pressure on any side.
class Lift {
 public:
  Lift(const GroundScene& scene, const GroundOutline& outline, const shape::PressureField& field)
      : scene_(scene), outline_(outline), field_(field) {
    for (const GroundRegion& region : scene.regions) {
      const double weight =
          (1.0 - scene.load.kv) * scene.materials[region.material].soil.unit_weight;
      heavy_.push_back({region.outline, weight});
      for (const auto& hole : region.holes) heavy_.push_back({hole, -weight});
    }
    for (const GroundSide& side : scene.sides) pressed_ = std::max(pressed_, side.pressure);
    most_ = rounding * largest_of(outline, field);
  }

  void look_at(const mesh::Point& place, double pressure) {
    if (pressure - pressed_ <= most_) return;
    const double lift = pressure - pressed_ - shape::overburden(heavy_, place).value;
    if (lift <= most_ || !is_within(place)) return;
    const double above = lift - field_.at({place.x(), top_at(place.x())});
    if (above <= most_) return;
    most_ = above;
    words_ = fmt::format(
        "the pressure of the water at ({:.6g}, {:.6g}) is {:.6g} {} above what all that is "
        "straight above it presses with: it lifts ground that little else holds down, whatever the "
        "load",
        place.x(), place.y(), most_, scene_.units.stress);
  }
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  [[nodiscard]] bool is_within(const mesh::Point& place) const {
    return std::ranges::any_of(scene_.regions, [&](const GroundRegion& region) {
      return shape::is_inside(region.outline, place);
    });
  }
  [[nodiscard]] double top_at(double x) const {
    double top = -INFINITY;
    for (const GroundSegment& segment : outline_.segments) {
      const mesh::Point &a = outline_.at(segment.first), &b = outline_.at(segment.second);
      if (std::min(a.x(), b.x()) > x || std::max(a.x(), b.x()) < x) continue;
      const double share = a.x() == b.x() ? 0.0 : (x - a.x()) / (b.x() - a.x());
      top = std::max(top, a.y() + share * (b.y() - a.y()));
    }
    return top;
  }

  const GroundScene& scene_;
  const GroundOutline& outline_;
  const shape::PressureField& field_;
  std::vector<shape::HeavyRing> heavy_;
  double pressed_ = 0.0, most_ = 0.0;
  std::string words_;
};

void say_lift(const GroundScene& scene, const GroundOutline& outline,
              const shape::PressureField& field, problem::Case& result) {
  const bool is_even = std::ranges::none_of(scene.materials, [](const GroundMaterial& material) {
    return material.soil.has_uneven_weight();
  });
  // Where weights are sought, they are what is asked for.
  if (!is_even || scene.load.sought == Sought::gravity) return;
  Lift lift(scene, outline, field);
  const Extent ground = extent_of(scene);
  const mesh::Point &low = ground.low, &high = ground.high;
  for (const auto& piece : field.within({low, {high.x(), low.y()}, high, {low.x(), high.y()}})) {
    const mesh::Point& first = piece.ring.front();
    // On the ground's own outline a place counts as within or not, as rounding has it.
    mesh::Point middle(0.0, 0.0);
    for (const mesh::Point& place : piece.ring)
      middle += place / static_cast<double>(piece.ring.size());
    for (const mesh::Point& corner : piece.ring) {
      const mesh::Point place = corner + 1e-6 * (middle - corner);
      lift.look_at(place, piece.value + piece.gradient.dot(place - first));
    }
  }
  if (!lift.words().empty()) result.reasons.push_back(lift.words());
}

}  // namespace

void say_pressure(const GroundScene& scene, const GroundOutline& outline, problem::Case& result) {
  if (!scene.water.pore_pressure) return;
  const auto say = [&](const shape::PressureField& field) {
    say_standing(scene, outline, field, result);
    say_lift(scene, outline, field, result);
  };
  if (scene.water.in_triangles) {
    say(scene.water.in_triangles->field());
  } else {
    say(shape::PressureField(*scene.water.pore_pressure));
  }
}

}  // namespace limit::ground
