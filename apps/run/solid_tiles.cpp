#include "run/solid_tiles.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model/surface_corners.hpp"
#include "run/drawing_style.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"
#include "scene/outline_faces.hpp"
#include "scene/scene.hpp"

namespace run {
namespace {

using Place = Eigen::Vector3d;

/// A rectangle of some area, as level as may be.
std::array<Place, 2> square(const Place& outward, double area) {
  const bool is_level = std::abs(outward.y()) > 0.99;
  const Place first = (is_level ? Place::UnitX() : Place(Place::UnitY().cross(outward)));
  const Place across = outward.cross(first).normalized();
  return {std::sqrt(area) * across.cross(outward), std::sqrt(area) * across};
}

std::vector<Tile> tiles_of_surface(const model::Model<3>& model) {
  std::vector<Tile> tiles;
  for (const model::SurfacePiece<3>& piece : model.surface) {
    const bool has_edges = piece.edges[0].norm() > 0.0 && piece.edges[1].norm() > 0.0;
    tiles.push_back({piece.middle,
                     piece.outward,
                     has_edges ? piece.edges : square(piece.outward, piece.area),
                     piece.particle,
                     piece.side,
                     piece.face,
                     {}});
  }
  return tiles;
}

std::vector<Tile> tiles_of_solid(const scene::Scene& scene, const model::Model<3>& model) {
  std::vector<Tile> tiles = tiles_of_surface(model);
  if (!scene::has_elements(scene)) return tiles;
  const std::vector<std::vector<Place>> corners = model::surface_corners(scene, model);
  for (std::size_t i = 0; i < tiles.size(); ++i) tiles[i].corners = corners[i];
  return tiles;
}

/// Those of a box: of each particle that is next to a face of it.
std::vector<Tile> tiles_of_box(const model::Model<3>& model) {
  constexpr double next = 0.75;  // spacings; half a one where particles are the middles of cells
  std::vector<Tile> tiles;
  for (int face = 0; face < 6; ++face) {
    const int axis = face / 2;
    const bool upper = face % 2 == 1;
    const double level = upper ? model.box_max[axis] : model.box_min[axis];
    Place outward = Place::Zero();
    outward[axis] = upper ? 1.0 : -1.0;
    for (Eigen::Index a = 0; a < model.size(); ++a) {
      const Place at = model.particles.position.row(a).transpose();
      const double spacing = model.spacing_at(a);
      if (std::abs(at[axis] - level) > next * spacing) continue;
      Place from = (at.array() - 0.5 * spacing).max(model.box_min.array());
      Place to = (at.array() + 0.5 * spacing).min(model.box_max.array());
      from[axis] = to[axis] = level;
      const int first = (axis + 1) % 3, second = (axis + 2) % 3;
      tiles.push_back(
          {0.5 * (from + to),
           outward,
           {Place::Unit(first) * (to - from)[first], Place::Unit(second) * (to - from)[second]},
           a,
           -1,
           face,
           {}});
    }
  }
  return tiles;
}

bool is_in(const scene::Point& range_min, const scene::Point& range_max, int across,
           const Place& at) {
  std::size_t i = 0;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == across) continue;
    if (!range_min.empty() && at[axis] < range_min[i]) return false;
    if (!range_max.empty() && at[axis] > range_max[i]) return false;
    ++i;
  }
  return true;
}

std::function<bool(const Tile&)> on_face(scene::Side side, const scene::Point& range_min = {},
                                         const scene::Point& range_max = {}) {
  return [=](const Tile& tile) {
    return tile.face == static_cast<int>(side) &&
           is_in(range_min, range_max, scene::axis_of(side), tile.middle);
  };
}

void add_sides(const scene::Scene& scene, std::vector<Condition>& conditions) {
  using scene::OutlineKind;
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    const scene::OutlineSide& side = scene.side[i];
    if (side.kind == OutlineKind::free) continue;
    std::string text{scene::name_of(side.kind)};
    if (side.pressure != 0.0) text += fmt::format(", pressure {:g} Pa", side.pressure);
    if (side.live_pressure != 0.0) text += fmt::format(", up to {:g} Pa", side.live_pressure);
    if (side.shear != 0.0) text += fmt::format(", shear {:g} Pa", side.shear);
    if (side.live_shear != 0.0) text += fmt::format(", shear up to {:g} Pa", side.live_shear);
    conditions.push_back({side.kind == OutlineKind::loaded    ? loaded_colour
                          : side.kind == OutlineKind::footing ? moved_colour
                                                              : held_colour,
                          side.name, text,
                          [i](const Tile& tile) { return tile.side == static_cast<int>(i); }});
  }
}

// Whether it is what sides of the outline are on a face of the box, and so shown already.
bool is_of_sides(const scene::Scene& scene, const scene::Support& support) {
  if (scene.side.empty() || !support.side) return false;
  const scene::OutlineFaces faces(scene, scene::outer_pieces(scene));
  return support.name == faces.name_of_holders(faces.holders_of(*support.side), *support.side);
}

void add_supports(const scene::Scene& scene, const model::Model<3>& model,
                  std::vector<Condition>& conditions) {
  for (const scene::Support& support : scene.support) {
    if (is_of_sides(scene, support)) continue;
    std::string text = "held in";
    for (const scene::Axis axis : support.directions) text += fmt::format(" {}", name_of(axis));
    if (support.side) {
      conditions.push_back({held_colour, support.name, text, on_face(*support.side)});
    } else if (!support.at.empty()) {
      const Place at(support.at[0], support.at[1], support.at[2]);
      text += fmt::format(" at ({:g}, {:g}, {:g}) m", at.x(), at.y(), at.z());
      Eigen::Index nearest = 0;
      (model.particles.position.rowwise() - at.transpose())
          .rowwise()
          .squaredNorm()
          .minCoeff(&nearest);
      conditions.push_back({held_colour, support.name, text,
                            [=](const Tile& tile) { return tile.particle == nearest; }});
    } else {
      const auto is_of = [&model, from = support.region_min,
                          to = support.region_max](const Tile& tile) {
        if (tile.particle < 0) return false;
        const auto at = model.particles.position.row(tile.particle);
        for (int axis = 0; axis < 3; ++axis) {
          const auto i = static_cast<std::size_t>(axis);
          if (at[axis] < from[i] || at[axis] > to[i]) return false;
        }
        return true;
      };
      conditions.push_back({held_colour, support.name, text, is_of});
    }
  }
}

void add_mirrors(const scene::Scene& scene, const model::Model<3>& model,
                 const std::vector<Tile>& tiles, std::vector<Condition>& conditions) {
  for (const scene::Symmetry& mirror : scene.symmetry) {
    const int axis = static_cast<int>(mirror.axis);
    const bool upper = mirror.position > 0.5 * (model.box_min[axis] + model.box_max[axis]);
    const auto face = static_cast<scene::Side>(2 * axis + (upper ? 1 : 0));
    const auto is_told = [&](const Tile& tile) {  // as a [[side]]
      return tile.face == static_cast<int>(face) && tile.side >= 0 &&
             scene.side[static_cast<std::size_t>(tile.side)].kind == scene::OutlineKind::symmetry;
    };
    if (std::ranges::any_of(tiles, is_told)) continue;
    conditions.push_back(
        {held_colour, std::string(scene::name_of(face)), "symmetry", on_face(face)});
  }
}

void add_loads(const scene::Scene& scene, std::vector<Condition>& conditions) {
  for (const scene::Traction& traction : scene.traction) {
    conditions.push_back({loaded_colour, traction.name,
                          fmt::format("traction ({:g}, {:g}, {:g}) Pa", traction.value[0],
                                      traction.value[1], traction.value[2]),
                          on_face(traction.side, traction.range_min, traction.range_max)});
  }
  for (const scene::NamedDrive& named : scene::drives_of(scene)) {
    const scene::Drive& drive = *named.drive;
    const bool displaces = drive.kind == scene::DriveKind::displacement;
    if (!displaces && !scene::loads_plate(drive)) continue;
    std::function<bool(const Tile&)> is_of = on_face(drive.side, drive.range_min, drive.range_max);
    // Its [[side]] is shown already.
    if (drive.on_footing) is_of = [](const Tile&) { return false; };
    conditions.push_back({moved_colour, drive.name.empty() ? "plate" : drive.name,
                          displaces ? fmt::format("moved by {:g} m", drive.target) : "loaded plate",
                          is_of});
  }
}

}  // namespace

std::vector<Tile> tiles_of(const scene::Scene& scene, const model::Model<3>& model) {
  return model.surface.empty() ? tiles_of_box(model) : tiles_of_solid(scene, model);
}

std::vector<Condition> conditions_of(const scene::Scene& scene, const model::Model<3>& model,
                                     const std::vector<Tile>& tiles) {
  std::vector<Condition> conditions;
  add_sides(scene, conditions);
  add_supports(scene, model, conditions);
  add_mirrors(scene, model, tiles, conditions);
  add_loads(scene, conditions);
  return conditions;
}

}  // namespace run
