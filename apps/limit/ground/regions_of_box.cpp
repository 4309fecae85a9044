#include "limit/ground/regions_of_box.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scene/box.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace limit::ground {
namespace {

constexpr std::array<scene::Side, 4> faces{scene::Side::left, scene::Side::right,
                                           scene::Side::bottom, scene::Side::top};

std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

// Coordinates along an axis of the faces of the box and of its materials' boxes, sorted.
std::vector<double> lines_along(const scene::Scene& box, std::size_t axis) {
  const double low = box.geometry.min[axis], high = box.geometry.max[axis];
  std::vector<double> lines{low, high};
  for (const scene::Material& material : box.material) {
    if (material.region_min.empty()) continue;
    for (const double x : {material.region_min[axis], material.region_max[axis]}) {
      lines.push_back(std::clamp(x, low, high));
    }
  }
  std::ranges::sort(lines);
  const double same = scene::same_place(box.geometry);
  std::vector<double> apart;
  for (const double x : lines) {
    if (apart.empty() || x - apart.back() > same) apart.push_back(x);
  }
  apart.back() = high;
  return apart;
}

struct Rectangle {
  double left, right, bottom, top;
  std::size_t material;
};

// Rows of rectangles, as wide as their material goes; one on another alike are one.
std::vector<Rectangle> rectangles_of(const scene::Scene& box) {
  const auto x = lines_along(box, 0), y = lines_along(box, 1);
  std::vector<Rectangle> all;
  for (std::size_t j = 0; j + 1 < y.size(); ++j) {
    std::vector<Rectangle> row;
    for (std::size_t i = 0; i + 1 < x.size(); ++i) {
      const std::array<double, 2> middle{0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1])};
      const std::size_t material = scene::material_at(box, middle);
      if (!row.empty() && row.back().material == material) {
        row.back().right = x[i + 1];
      } else {
        row.push_back({x[i], x[i + 1], y[j], y[j + 1], material});
      }
    }
    for (const Rectangle& each : row) {
      const auto below = std::ranges::find_if(all, [&](const Rectangle& other) {
        return other.top == each.bottom && other.left == each.left && other.right == each.right &&
               other.material == each.material;
      });
      if (below == all.end()) {
        all.push_back(each);
      } else {
        below->top = each.top;
      }
    }
  }
  return all;
}

// The sides of a box by what is on them.
class Sides {
 public:
  Sides(const scene::Scene& box, bool tension, tables::Diagnosis& diagnosis)
      : box_(box), tension_(tension), diagnosis_(diagnosis) {}

  std::vector<scene::OutlineSide> all() {
    for (std::size_t i = 0; i < box_.support.size(); ++i) {
      if (box_.support[i].side) continue;
      refuse(fmt::format("support.{}", i), "it holds something else than a whole side");
    }
    check_drive();
    for (const scene::Side face : faces) add(face);
    return std::move(sides_);
  }

 private:
  void refuse(const std::string& key, const std::string& found) {
    diagnosis_.error(key, found, "fpm-limit knows what the kinds of [[side]] hold, load and press");
  }

  const scene::Drive* plate() const {
    const scene::Drive& drive = box_.drive;
    const bool presses = drive.kind == scene::DriveKind::displacement || scene::loads_plate(drive);
    return presses ? &drive : nullptr;
  }

  void check_drive() {
    const scene::Drive* drive = plate();
    if (drive == nullptr) return;
    const auto across = index(scene::axis_of(drive->side));
    const scene::Point& way = drive->force.empty() ? drive->direction : drive->force;
    if (way.size() == 2) {
      const double inwards = scene::is_upper(drive->side) ? -way[across] : way[across];
      if (inwards <= 0.0 || way[1 - across] != 0.0) {
        refuse(drive->force.empty() ? "drive.direction" : "drive.force",
               "it does not press straight into the ground");
      }
    }
    if (drive->contact.friction_angle != 0.0 || drive->contact.adhesion != 0.0) {
      refuse("drive", "its plate has a friction or adhesion of its own");
    }
    const bool may_slide = scene::loads_plate(*drive) && drive->lateral == scene::Lateral::free;
    if (may_slide && drive->at.empty() && !box_.load.guided) {
      diagnosis_.error("drive.lateral", "its plate moves along the ground and does not turn",
                       "to fpm-limit a plate moves along its normal alone, load.guided = true, or "
                       "turns as well, false");
    }
    if (drive->at.empty() || box_.load.eccentricity != 0.0) return;
    const std::size_t along = 1 - across;
    const bool is_whole = drive->range_min.empty();
    const double from = is_whole ? box_.geometry.min[along] : drive->range_min[0];
    const double to = is_whole ? box_.geometry.max[along] : drive->range_max[0];
    if (std::abs(drive->at[0] - 0.5 * (from + to)) > scene::same_place(box_.geometry)) {
      diagnosis_.error("drive.at",
                       fmt::format("its plate, from {:.6g} to {:.6g}, is pushed at {:.6g}", from,
                                   to, drive->at[0]),
                       "to fpm-limit load.eccentricity says how far from its middle");
    }
  }

  // Whether a range along a face, empty for all of it, holds a place.
  static bool is_within(const scene::Point& from, const scene::Point& to, double place) {
    return from.empty() || (place >= from[0] && place <= to[0]);
  }

  void add(scene::Side face) {
    const auto along = index(1 - scene::axis_of(face));
    const double low = box_.geometry.min[along], high = box_.geometry.max[along];
    std::vector<double> ends{low, high};
    const auto end_at = [&](const scene::Point& from, const scene::Point& to) {
      if (from.empty()) return;
      for (const double x : {from[0], to[0]}) ends.push_back(std::clamp(x, low, high));
    };
    if (plate() != nullptr && plate()->side == face) end_at(plate()->range_min, plate()->range_max);
    for (const scene::Traction& traction : box_.traction) {
      if (traction.side == face) end_at(traction.range_min, traction.range_max);
    }
    std::ranges::sort(ends);
    const double same = scene::same_place(box_.geometry);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      if (ends[i + 1] - ends[i] > same) add(face, ends[i], ends[i + 1]);
    }
  }

  void add(scene::Side face, double from, double to) {
    const int across = scene::axis_of(face);
    scene::OutlineSide side;
    side.name = fmt::format("{} from {:.6g} to {:.6g}", scene::name_of(face), from, to);
    const double at = scene::side_position(box_.geometry, face);
    for (const double place : {from, to}) {
      side.along.emplace_back(across == 0 ? at : place, across == 0 ? place : at);
    }
    const double middle = 0.5 * (from + to);
    const bool is_held = hold(face, side);
    const bool is_loaded = load(face, middle, is_held, side);
    const scene::Drive* drive = plate();
    if (drive != nullptr && drive->side == face &&
        is_within(drive->range_min, drive->range_max, middle)) {
      if (is_held || is_loaded) {
        refuse("drive", fmt::format("its plate is where a {} is, on the {}",
                                    is_held ? "support" : "traction", scene::name_of(face)));
      }
      side.kind = scene::OutlineKind::footing;
      // Without friction contact holds nothing along its face.
      const bool touches = drive->method == scene::DriveMethod::contact;
      const bool is_rough = drive->lateral == scene::Lateral::fixed && !touches;
      side.base = is_rough ? scene::Base::rough : scene::Base::smooth;
      side.tension = tension_ && !(touches && !drive->contact.tension);
    }
    sides_.push_back(std::move(side));
  }

  bool hold(scene::Side face, scene::OutlineSide& side) {
    const int across = scene::axis_of(face);
    std::array<bool, 2> held{};
    for (std::size_t i = 0; i < box_.support.size(); ++i) {
      const scene::Support& support = box_.support[i];
      if (support.side != face) continue;
      if (support.method == scene::SupportMethod::contact) {
        refuse(fmt::format("support.{}", i), "the ground lies against it by contact");
      }
      for (const scene::Axis axis : support.directions) held[static_cast<std::size_t>(axis)] = true;
    }
    if (scene::is_mirror(box_, face)) {
      if (held[index(1 - across)]) {
        refuse("support",
               fmt::format("the {} is a mirror, and held along itself", scene::name_of(face)));
      }
      side.kind = scene::OutlineKind::symmetry;
      return true;
    }
    if (!held[0] && !held[1]) return false;
    if (!held[index(across)]) {
      refuse("support", fmt::format("the {} is held along itself alone", scene::name_of(face)));
    }
    side.kind = held[0] && held[1] ? scene::OutlineKind::fixed : scene::OutlineKind::roller;
    return true;
  }

  bool load(scene::Side face, double middle, bool is_held, scene::OutlineSide& side) {
    bool is_loaded = false;
    std::array<double, 2> normal{};
    normal[index(scene::axis_of(face))] = scene::is_upper(face) ? 1.0 : -1.0;
    for (std::size_t i = 0; i < box_.traction.size(); ++i) {
      const scene::Traction& traction = box_.traction[i];
      if (traction.side != face || !is_within(traction.range_min, traction.range_max, middle)) {
        continue;
      }
      if (is_held) {
        refuse(fmt::format("traction.{}", i), "it acts where a support or mirror holds");
        continue;
      }
      is_loaded = true;
      const auto& value = traction.value;
      const double pressure = -(value[0] * normal[0] + value[1] * normal[1]);
      // With the ground to the left.
      const double shear = value[1] * normal[0] - value[0] * normal[1];
      const bool grows = scene::grows(box_, scene::LoadKind::traction, traction.name);
      (grows ? side.live_pressure : side.pressure) += pressure;
      (grows ? side.live_shear : side.shear) += shear;
    }
    if (is_loaded) side.kind = scene::OutlineKind::loaded;
    return is_loaded;
  }

  const scene::Scene& box_;
  const bool tension_;
  tables::Diagnosis& diagnosis_;
  std::vector<scene::OutlineSide> sides_;
};

}  // namespace

std::optional<scene::Scene> regions_of_box(const scene::Scene& box, bool tension,
                                           tables::Diagnosis& diagnosis) {
  if (box.geometry.dimension != 2) {
    diagnosis.error("geometry.dimension", "found 3", "fpm-limit's ground is plane");
    return std::nullopt;
  }
  scene::Scene ground = box;
  const auto rectangles = rectangles_of(box);
  for (std::size_t r = 0; r < rectangles.size(); ++r) {
    const Rectangle& each = rectangles[r];
    scene::Region& region = ground.region.emplace_back();
    region.name = fmt::format("{} {}", box.material[each.material].name, r);
    region.material = box.material[each.material].name;
    region.outline = {{each.left, each.bottom},
                      {each.right, each.bottom},
                      {each.right, each.top},
                      {each.left, each.top}};
  }
  ground.side = Sides(box, tension, diagnosis).all();
  ground.support.clear();
  ground.symmetry.clear();
  ground.traction.clear();
  ground.drive.loads.clear();  // of sides what grows is live
  for (scene::Material& material : ground.material) {
    material.region_min.clear();
    material.region_max.clear();
  }
  if (!diagnosis.errors().empty()) return std::nullopt;
  return ground;
}

}  // namespace limit::ground
