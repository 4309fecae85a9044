#include "scene/complete_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "scene/box.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"
#include "shape/mesh_solids.hpp"

namespace scene {
namespace {

// Where a footing lies: its face, as of a box around the ground under it, the coordinate across it
// and its size.
struct BaseFace {
  Side face = Side::top;
  double position = 0.0;  // [m]
  double area = 0.0;      // [m2]
};

std::optional<BaseFace> base_of(const Scene& scene, const ElementBody& body, std::size_t footing,
                                tables::Diagnosis& diagnosis) {
  std::optional<BaseFace> base;
  constexpr double same = 1e-9;
  const auto& geometry = scene.geometry;
  const double slack = same * (geometry.max[1] - geometry.min[1]);
  for (std::size_t f = 0; f < body.side.size(); ++f) {
    if (body.side[f] != static_cast<int>(footing)) continue;
    for (const auto& piece : shape::flat_pieces(body.mesh, body.joined.facets[f].nodes)) {
      int axis = 0;
      piece.area.cwiseAbs().maxCoeff(&axis);
      const double area = piece.area.norm();
      const auto face = static_cast<Side>(2 * axis + (piece.area[axis] > 0.0 ? 1 : 0));
      const bool is_straight = std::abs(piece.area[axis]) >= (1.0 - same) * area;
      const bool is_level =
          !base || (face == base->face && std::abs(piece.middle[axis] - base->position) <= slack);
      if (!is_straight || !is_level) {
        diagnosis.error(fmt::format("side.{}.group", footing),
                        fmt::format("the base at ({:.6g}, {:.6g}, {:.6g}) is {}", piece.middle.x(),
                                    piece.middle.y(), piece.middle.z(),
                                    is_straight ? "beside the rest of it" : "aslant"),
                        "a footing has one flat base, across an axis");
        return std::nullopt;
      }
      if (!base) base = BaseFace{face, piece.middle[axis], 0.0};
      base->area += area;
    }
  }
  return base;
}

}  // namespace

void complete_box_of_elements(Scene& scene, const ElementBody& body, tables::Diagnosis& diagnosis) {
  Geometry& geometry = scene.geometry;
  const auto n = static_cast<std::size_t>(geometry.dimension);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Point low(n, infinity), high(n, -infinity);
  std::vector<double> volume;
  for (const shape::MeshPart& part : body.joined.parts) {
    const auto& element = body.mesh.elements[static_cast<std::size_t>(part.element)];
    volume.push_back(shape::content_of(body.mesh, element).volume);
    for (const int node : element.nodes) {
      for (std::size_t i = 0; i < n; ++i) {
        const double x = body.mesh.at(node)[static_cast<Eigen::Index>(i)];
        low[i] = std::min(low[i], x);
        high[i] = std::max(high[i], x);
      }
    }
  }
  const double spacing = std::ranges::min(shape::spacings(body.mesh, body.joined, volume));
  const auto check = [&](double given, double is, const char* key) {
    constexpr double round_off = 1e-9;
    if (std::abs(given - is) <= round_off * std::abs(is) + round_off * spacing) return;
    diagnosis.error(key, fmt::format("found {:.6g}, and the mesh has {:.6g}", given, is),
                    "where particles are elements, leave it out: the mesh says it");
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (geometry.min.size() == n) check(geometry.min[i], low[i], "geometry.min");
    if (geometry.max.size() == n) check(geometry.max[i], high[i], "geometry.max");
  }
  if (geometry.spacing > 0.0) check(geometry.spacing, spacing, "geometry.spacing");
  geometry.min = low;
  geometry.max = high;
  geometry.spacing = spacing;
}

void complete_drive_of_solid(Scene& scene, const ElementBody& body, tables::Diagnosis& diagnosis) {
  const auto footing = footing_of(scene);
  if (!footing) return;
  const auto base = base_of(scene, body, *footing, diagnosis);
  if (!base) return;
  const OutlineSide& side = scene.side[*footing];
  Drive& drive = *drive_of_footing(scene);
  drive.on_footing = true;
  drive.side = base->face;
  drive.level = base->position;
  if (drive.kind == DriveKind::displacement && drive.direction.empty()) {
    drive.direction = {0.0, 0.0, 0.0};
    drive.direction[static_cast<std::size_t>(axis_of(base->face))] =
        is_upper(base->face) ? -1.0 : 1.0;
  }
  // Of the reaction the mean pressure is taken over the base, whatever its shape.
  if (!drive.width) drive.width = base->area;
  drive.lateral = side.base == Base::rough ? Lateral::fixed : Lateral::free;
  if (drive.method == DriveMethod::automatic) {
    choose_plate(side, drive);
  }
}

}  // namespace scene
