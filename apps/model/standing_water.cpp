#include "model/standing_water.hpp"

#include <algorithm>
#include <map>

#include "model/side_points.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"
#include "scene/water.hpp"

namespace model {
namespace {

using Place = Eigen::Vector2d;

struct Piece {
  Place from, to;  // with the body to the left
  int cut = -1, side = -1, face = -1;
};

std::vector<Piece> pieces_of(const scene::Scene& scene, const Model<2>& model) {
  std::vector<Piece> pieces;
  for (const SurfacePiece<2>& piece : model.surface) {
    pieces.push_back({piece.from, piece.to, piece.cut, piece.side, piece.face});
  }
  for (int f = 0; f < 4 && model.surface.empty(); ++f) {
    const auto points = side_points(scene, model, static_cast<scene::Side>(f), {}, {}).points;
    for (fpm::Index c = 0; c < points.size(); ++c) {
      const Place at = points.position.row(c).transpose();
      const Place outward = points.normal.row(c).transpose();
      const Place half = 0.5 * points.weight[c] * Place(-outward.y(), outward.x());
      pieces.push_back({at - half, at + half, -1, -1, f});
    }
  }
  return pieces;
}

// Whether a plate that is displaced holds it.
bool is_driven(const scene::Scene& scene, const Piece& piece) {
  const auto side = static_cast<scene::Side>(piece.face);
  const Place middle = 0.5 * (piece.from + piece.to);
  return std::ranges::any_of(scene::all_drives(scene), [&](const scene::Drive* drive) {
    return drive->kind == scene::DriveKind::displacement && !drive->level && drive->side == side &&
           is_within_range<2>(scene, side, middle, drive->range_min, drive->range_max);
  });
}

bool is_held(const scene::Scene& scene, const Piece& piece) {
  if (piece.face >= 0 && scene::is_held(scene, static_cast<scene::Side>(piece.face))) return true;
  if (piece.face >= 0 && is_driven(scene, piece)) return true;
  if (piece.cut >= 0) {
    return scene.cutout[static_cast<std::size_t>(piece.cut)].kind != scene::CutoutKind::free;
  }
  if (piece.side < 0) return false;
  const scene::OutlineKind kind = scene.side[static_cast<std::size_t>(piece.side)].kind;
  return kind != scene::OutlineKind::free && kind != scene::OutlineKind::loaded;
}

}  // namespace

std::vector<StandingWater> standing_water(const scene::Scene& scene, const Model<2>& model) {
  std::vector<StandingWater> standing;
  if (!scene::has_water(scene)) return standing;
  const scene::PoreWater water(scene);
  const auto pressure_at = [&](const Place& place) { return water.pressure_at({place.data(), 2}); };
  double largest = 0.0;
  std::map<std::string, std::size_t> known;
  for (const Piece& piece : pieces_of(scene, model)) {
    const double ends[] = {pressure_at(piece.from), pressure_at(piece.to)};
    largest = std::max({largest, ends[0], ends[1]});
    if (is_held(scene, piece)) continue;
    const auto [at, is_new] = known.try_emplace(
        name_of_surface(scene, piece.cut, piece.side, piece.face), standing.size());
    if (is_new) standing.push_back({at->first, -1.0, piece.from});
    StandingWater& here = standing[at->second];
    const Place along = piece.to - piece.from;
    here.force -= 0.5 * (ends[0] + ends[1]) * Place(along.y(), -along.x());
    for (int end = 0; end < 2; ++end) {
      if (ends[end] <= here.pressure) continue;
      here.pressure = ends[end];
      here.at = end == 0 ? piece.from : piece.to;
    }
  }
  constexpr double rounding = 1e-3;  // of points written with few digits
  std::erase_if(standing, [&](const StandingWater& s) { return s.pressure <= rounding * largest; });
  return standing;
}

}  // namespace model
