#include "scene/outline_faces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/box.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace scene {

std::vector<OuterPiece> outer_pieces(const Scene& scene, const shape::Outline& outline) {
  const auto face_of = [&](const shape::OutlineSegment& segment) -> std::optional<Side> {
    for (const Side face : {Side::left, Side::right, Side::bottom, Side::top}) {
      const int axis = axis_of(face);
      const double at = side_position(scene.geometry, face);
      if (std::abs(outline.at(segment.first)[axis] - at) <= outline.tolerance() &&
          std::abs(outline.at(segment.second)[axis] - at) <= outline.tolerance()) {
        return face;
      }
    }
    return std::nullopt;
  };
  std::vector<OuterPiece> pieces;
  for (const shape::OutlineSegment& segment : outline.segments) {
    if (segment.right >= 0 || segment.side < 0) continue;
    pieces.push_back({static_cast<std::size_t>(segment.side), face_of(segment)});
  }
  return pieces;
}

std::vector<OuterPiece> outer_pieces(const Scene& scene, const ElementBody& body) {
  std::vector<OuterPiece> pieces;
  for (std::size_t f = 0; f < body.side.size(); ++f) {
    if (body.side[f] < 0) continue;
    pieces.push_back({static_cast<std::size_t>(body.side[f]),
                      face_of(scene, body.mesh, body.joined.facets[f].nodes)});
  }
  return pieces;
}

std::vector<OuterPiece> outer_pieces(const Scene& scene) {
  return is_solid(scene) ? outer_pieces(scene, elements_of(scene))
                         : outer_pieces(scene, outline_of(scene));
}

std::vector<std::size_t> OutlineFaces::holders_of(Side face) const {
  std::vector<std::size_t> sides;
  for (const OuterPiece& piece : pieces_) {
    if (piece.face == face && std::ranges::count(sides, piece.side) == 0) {
      sides.push_back(piece.side);
    }
  }
  if (sides.empty()) return {};
  const OutlineKind kind = scene_.side[sides.front()].kind;
  const bool alike =
      std::ranges::all_of(sides, [&](std::size_t s) { return scene_.side[s].kind == kind; });
  return alike && holds(kind) ? sides : std::vector<std::size_t>{};
}

std::size_t OutlineFaces::faces_of(std::size_t side) const {
  std::vector<std::optional<Side>> faces;
  for (const OuterPiece& piece : pieces_) {
    if (piece.side == side && std::ranges::count(faces, piece.face) == 0) {
      faces.push_back(piece.face);
    }
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

std::vector<std::string> tied_surfaces(const Scene& scene) {
  std::vector<std::string> names;
  for (const Cutout& cutout : scene.cutout) {
    if (cutout.kind != CutoutKind::free) names.push_back(cutout.name);
  }
  if (scene.region.empty()) return names;
  for (const OuterPiece& piece : outer_pieces(scene)) {
    const OutlineSide& side = scene.side[piece.side];
    if (!holds(side.kind) || (piece.face && is_held(scene, *piece.face))) continue;
    if (std::ranges::count(names, side.name) == 0) names.push_back(side.name);
  }
  return names;
}

std::vector<std::size_t> regions_at(const Scene& scene, std::size_t side) {
  std::set<std::size_t> regions;
  if (is_solid(scene)) {
    const ElementBody body = elements_of(scene);
    for (std::size_t f = 0; f < body.side.size(); ++f) {
      if (body.side[f] != static_cast<int>(side)) continue;
      const auto part = static_cast<std::size_t>(body.joined.facets[f].part);
      regions.insert(static_cast<std::size_t>(body.joined.parts[part].region));
    }
  } else {
    for (const shape::OutlineSegment& segment : outline_of(scene).segments) {
      if (segment.right >= 0 || segment.side != static_cast<int>(side)) continue;
      regions.insert(static_cast<std::size_t>(segment.left));
    }
  }
  return {regions.begin(), regions.end()};
}

}  // namespace scene
