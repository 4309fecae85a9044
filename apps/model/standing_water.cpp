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

template <int Dim>
struct Piece {
  // Where the pressure is looked up: of a straight piece its ends, in space its middle.
  std::vector<fpm::Vector<Dim>> at;
  fpm::Vector<Dim> middle, outward;
  double area = 0.0;
  int cut = -1, side = -1, face = -1;
};

Piece<2> piece_of(const SurfacePiece<2>& piece) {
  const Eigen::Vector2d along = piece.to - piece.from;
  const Eigen::Vector2d outward = Eigen::Vector2d(along.y(), -along.x()).normalized();
  const Eigen::Vector2d middle = 0.5 * (piece.from + piece.to);
  return {{piece.from, piece.to}, middle, outward, along.norm(), piece.cut, piece.side, piece.face};
}

Piece<3> piece_of(const SurfacePiece<3>& piece) {
  return {{piece.middle}, piece.middle, piece.outward, piece.area,
          piece.cut,      piece.side,   piece.face};
}

template <int Dim>
std::vector<Piece<Dim>> pieces_of(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<Piece<Dim>> pieces;
  for (const SurfacePiece<Dim>& piece : model.surface) pieces.push_back(piece_of(piece));
  for (int f = 0; f < 2 * Dim && model.surface.empty(); ++f) {
    const auto points = side_points(scene, model, static_cast<scene::Side>(f), {}, {}).points;
    for (fpm::Index c = 0; c < points.size(); ++c) {
      const fpm::Vector<Dim> at = points.position.row(c).transpose();
      const fpm::Vector<Dim> outward = points.normal.row(c).transpose();
      Piece<Dim>& piece = pieces.emplace_back(Piece<Dim>{{at}, at, outward, points.weight[c]});
      piece.face = f;
      if constexpr (Dim == 2) {
        const Eigen::Vector2d half =
            0.5 * points.weight[c] * Eigen::Vector2d(-outward.y(), outward.x());
        piece.at = {at - half, at + half};
      }
    }
  }
  return pieces;
}

// Whether a plate that is displaced holds it.
template <int Dim>
bool is_driven(const scene::Scene& scene, const Piece<Dim>& piece) {
  const auto side = static_cast<scene::Side>(piece.face);
  return std::ranges::any_of(scene::all_drives(scene), [&](const scene::Drive* drive) {
    return drive->kind == scene::DriveKind::displacement && !drive->level && drive->side == side &&
           is_within_range<Dim>(scene, side, piece.middle, drive->range_min, drive->range_max);
  });
}

template <int Dim>
bool is_held(const scene::Scene& scene, const Piece<Dim>& piece) {
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

template <int Dim>
std::vector<StandingWater<Dim>> standing_water(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<StandingWater<Dim>> standing;
  if (!scene::has_water(scene)) return standing;
  const scene::PoreWater water(scene);
  double largest = 0.0;
  std::map<std::string, std::size_t> known;
  for (const Piece<Dim>& piece : pieces_of(scene, model)) {
    std::vector<double> pressures;
    for (const fpm::Vector<Dim>& at : piece.at) {
      pressures.push_back(water.pressure_at({at.data(), Dim}));
      largest = std::max(largest, pressures.back());
    }
    if (is_held(scene, piece)) continue;
    const auto [name, is_new] = known.try_emplace(
        name_of_surface(scene, piece.cut, piece.side, piece.face), standing.size());
    if (is_new) standing.push_back({name->first, -1.0, piece.middle});
    StandingWater<Dim>& here = standing[name->second];
    for (std::size_t i = 0; i < pressures.size(); ++i) {
      here.force -=
          pressures[i] * piece.area / static_cast<double>(pressures.size()) * piece.outward;
      if (pressures[i] <= here.pressure) continue;
      here.pressure = pressures[i];
      here.at = piece.at[i];
    }
  }
  constexpr double rounding = 1e-3;  // of points written with few digits
  std::erase_if(standing, [&](const auto& s) { return s.pressure <= rounding * largest; });
  return standing;
}

template std::vector<StandingWater<2>> standing_water(const scene::Scene&, const Model<2>&);
template std::vector<StandingWater<3>> standing_water(const scene::Scene&, const Model<3>&);

}  // namespace model
