#include "scene/outline_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/box.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace scene {

bool holds(OutlineKind kind) {
  return kind == OutlineKind::fixed || kind == OutlineKind::roller || kind == OutlineKind::symmetry;
}

std::optional<Side> OutlineFaces::face_of(const shape::OutlineSegment& segment) const {
  for (const Side face : {Side::left, Side::right, Side::bottom, Side::top}) {
    const int axis = axis_of(face);
    const double at = side_position(scene_.geometry, face);
    const double slack = 1e-9 * outline_.size;
    if (std::abs(outline_.at(segment.first)[axis] - at) <= slack &&
        std::abs(outline_.at(segment.second)[axis] - at) <= slack) {
      return face;
    }
  }
  return std::nullopt;
}

std::vector<std::size_t> OutlineFaces::holders_of(Side face) const {
  std::vector<std::size_t> sides;
  for (const shape::OutlineSegment& segment : outline_.segments) {
    if (segment.right >= 0 || face_of(segment) != face) continue;
    const auto side = static_cast<std::size_t>(segment.side);
    if (std::ranges::count(sides, side) == 0) sides.push_back(side);
  }
  if (sides.empty()) return {};
  const OutlineKind kind = scene_.side[sides.front()].kind;
  const bool alike =
      std::ranges::all_of(sides, [&](std::size_t s) { return scene_.side[s].kind == kind; });
  return alike && holds(kind) ? sides : std::vector<std::size_t>{};
}

std::size_t OutlineFaces::faces_of(std::size_t side) const {
  std::vector<std::optional<Side>> faces;
  for (const shape::OutlineSegment& segment : outline_.segments) {
    if (segment.right >= 0 || segment.side != static_cast<int>(side)) continue;
    const auto face = face_of(segment);
    if (std::ranges::count(faces, face) == 0) faces.push_back(face);
  }
  return faces.size();
}

std::string OutlineFaces::name_of_holders(const std::vector<std::size_t>& sides, Side face) const {
  std::string name;
  for (const std::size_t s : sides) {
    name += (name.empty() ? "" : " and ") + scene_.side[s].name;
    if (faces_of(s) > 1) name += fmt::format(" {}", name_of(face));
  }
  return name;
}

}  // namespace scene
