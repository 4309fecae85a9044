#include "model/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Place = Eigen::Vector2d;

// What is left of each cell of a tree, and which cell stands for it.
struct CutCells {
  std::vector<shape::Part> part;
  std::vector<fpm::Index> owner;
};

// The cell beside another that takes over what is left of it: the one with most left.
fpm::Index heir(const fpm::Cells<2>& cells, const std::vector<shape::Part>& part,
                const std::vector<char>& stands, fpm::Index a) {
  fpm::Index best = -1;
  const fpm::Index steps = cells.steps(a);
  for (fpm::Index dx = -1; dx <= 1; ++dx) {
    for (fpm::Index dy = -1; dy <= 1; ++dy) {
      const auto at = [steps](fpm::Index d) { return d < 0 ? -1 : d > 0 ? steps : 0; };
      const fpm::Index b = cells.holding(cells.place(a) + fpm::Cells<2>::Place(at(dx), at(dy)));
      if (b < 0 || b == a || stands[static_cast<std::size_t>(b)] == 0) continue;
      const auto k = static_cast<std::size_t>(b);
      if (best < 0 || part[k].area > part[static_cast<std::size_t>(best)].area) best = b;
    }
  }
  return best;
}

CutCells cut(const shape::Body& body, const fpm::Cells<2>& cells) {
  // Less than this of a cell is no particle: its row would be close to singular.
  constexpr double fewest = 0.3;
  constexpr double nothing = 1e-9;
  CutCells result;
  std::vector<char> stands;
  for (fpm::Index a = 0; a < cells.size(); ++a) {
    const double cell = cells.width(a) * cells.width(a);
    result.part.push_back(body.within(cells.lower(a), cells.upper(a)));
    stands.push_back(result.part.back().area >= fewest * cell ? 1 : 0);
  }
  for (fpm::Index a = 0; a < cells.size(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    const double cell = cells.width(a) * cells.width(a);
    if (stands[k] != 0) {
      result.owner.push_back(a);
    } else {
      result.owner.push_back(
          result.part[k].area > nothing * cell ? heir(cells, result.part, stands, a) : -1);
    }
  }
  return result;
}

// Parameters 0 ... 1 at which a segment crosses the lines of the finest cells, both ends included.
std::vector<double> crossings(const fpm::LatticeOptions<2>& lattice, const Place& from,
                              const Place& to) {
  std::set<double> at{0.0, 1.0};
  for (int i = 0; i < 2; ++i) {
    const double length = to[i] - from[i];
    if (std::abs(length) <= 1e-9 * lattice.spacing) continue;
    const double low = (std::min(from[i], to[i]) - lattice.min[i]) / lattice.spacing;
    const double high = (std::max(from[i], to[i]) - lattice.min[i]) / lattice.spacing;
    for (double line = std::ceil(low); line <= high; line += 1.0) {
      const double t = (lattice.min[i] + line * lattice.spacing - from[i]) / length;
      if (t > 0.0 && t < 1.0) at.insert(t);
    }
  }
  return {at.begin(), at.end()};
}

// Cuts the segments of a surface where they pass from one cell to another.
std::vector<SurfacePiece> pieces_of(const shape::Body& body, const fpm::Cells<2>& cells) {
  constexpr double inward = 1e-6;  // spacings, to be on the side of the body
  constexpr double sliver = 1e-9;  // spacings
  const auto& lattice = cells.lattice();
  std::vector<SurfacePiece> pieces;
  for (const shape::SurfaceSegment& segment : body.surface()) {
    const Place along = segment.to - segment.from;
    const Place left = Place(-along.y(), along.x()).normalized() * (inward * lattice.spacing);
    const auto cuts = crossings(lattice, segment.from, segment.to);
    bool first = true;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if ((cuts[k + 1] - cuts[k]) * along.norm() <= sliver * lattice.spacing) continue;
      const Place middle = segment.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      const fpm::Index owner = cells.containing(middle + left);
      const Place end = segment.from + cuts[k + 1] * along;
      if (!first && pieces.back().particle == owner) {
        pieces.back().to = end;
        continue;
      }
      const Place begin = first ? segment.from : pieces.back().to;
      pieces.push_back({begin, end, owner, segment.source});
      first = false;
    }
    if (!first) pieces.back().to = segment.to;
  }
  return pieces;
}

// Pieces that lie on what belongs to no cell, by round-off, go to the nearest particle.
void find_owners(const fpm::Field<2>& position, std::vector<SurfacePiece>& pieces) {
  for (SurfacePiece& piece : pieces) {
    if (piece.particle >= 0) continue;
    const Place middle = 0.5 * (piece.from + piece.to);
    Eigen::Index nearest = 0;
    (position.rowwise() - middle.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    piece.particle = static_cast<fpm::Index>(nearest);
  }
}

void cut_plane_body(const scene::Scene& scene, Model<2>& model) {
  const shape::Body body = scene::body_of(scene);
  const fpm::Cells<2> whole = model.cells;
  const CutCells left = cut(body, whole);
  model.cells = whole.restricted(left.owner);
  model.particles = fpm::make_particles(model.cells);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(model.size());
  fpm::Field<2> moment = fpm::Field<2>::Zero(model.size(), 2);
  for (fpm::Index a = 0; a < whole.size(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    if (left.owner[k] < 0) continue;
    const fpm::Index b = model.cells.holding(whole.place(a));
    area[b] += left.part[k].area;
    moment.row(b) += left.part[k].area * (left.part[k].centroid - model.cells.site(b)).transpose();
  }
  for (Eigen::Index b = 0; b < model.size(); ++b) {
    const double cell = std::pow(model.cells.width(static_cast<fpm::Index>(b)), 2);
    // A whole cell keeps its jitter, and its digits.
    if (moment.row(b).norm() <= 1e-12 * cell * model.spacing &&
        std::abs(area[b] - cell) <= 1e-12 * cell)
      continue;
    model.particles.volume[b] = area[b];
    model.particles.position.row(b) =
        model.cells.site(static_cast<fpm::Index>(b)).transpose() + moment.row(b) / area[b];
  }
  model.surface = pieces_of(body, model.cells);
  find_owners(model.particles.position, model.surface);
}

bool is_of(const SurfacePiece& piece, const SurfacePart& part) {
  const int source =
      part.cutout ? static_cast<int>(*part.cutout) : SurfacePart::source_of(part.face);
  return piece.source == source;
}

// The part of a piece of a face that a range leaves; nothing if there is none.
std::optional<SurfacePiece> clipped(SurfacePiece piece, const SurfacePart& part, double sliver) {
  if (part.cutout) return piece;
  const int along = 1 - part.face.axis;
  for (double* x : {&piece.from[along], &piece.to[along]}) *x = std::clamp(*x, part.from, part.to);
  if ((piece.to - piece.from).norm() <= sliver) return std::nullopt;
  return piece;
}

// Calls visit(piece) for the pieces of a part.
template <int Dim, class Visitor>
void for_each_piece(const Model<Dim>& model, const SurfacePart& part, Visitor&& visit) {
  constexpr double sliver = 1e-9;
  for (const SurfacePiece& each : model.surface) {
    if (!is_of(each, part)) continue;
    if (const auto piece = clipped(each, part, sliver * model.spacing)) visit(*piece);
  }
}

// Points of a part of the surface, whose number is not known beforehand.
template <int Dim>
struct PointList {
  std::vector<Place> position, normal;
  std::vector<double> weight;
  std::vector<fpm::Index> particle;

  void add(const SurfacePiece& piece, int count) {
    const Place along = piece.to - piece.from;
    const Place outward = Place(along.y(), -along.x()).normalized();
    for (int k = 0; k < count; ++k) {
      position.push_back(piece.from + (k + 0.5) / count * along);
      normal.push_back(outward);
      weight.push_back(along.norm() / count);
      particle.push_back(piece.particle);
    }
  }

  fpm::BoundaryPoints<Dim> points() const {
    fpm::BoundaryPoints<Dim> result;
    const auto count = static_cast<Eigen::Index>(weight.size());
    result.position.setZero(count, Dim);
    result.normal.setZero(count, Dim);
    result.weight.resize(count);
    for (Eigen::Index c = 0; c < count; ++c) {
      const auto k = static_cast<std::size_t>(c);
      result.position.row(c).template head<2>() = position[k].transpose();
      result.normal.row(c).template head<2>() = normal[k].transpose();
      result.weight[c] = weight[k];
    }
    return result;
  }
};

}  // namespace

template <int Dim>
void cut_body(const scene::Scene& scene, Model<Dim>& model) {
  if constexpr (Dim == 2) cut_plane_body(scene, model);
}

template <int Dim>
SurfacePoints<Dim> surface_points(const Model<Dim>& model, const SurfacePart& part) {
  PointList<Dim> list;
  for_each_piece(model, part, [&](const SurfacePiece& piece) {
    const double half = 0.5 * model.spacing_at(piece.particle);
    constexpr double round_off = 1e-9;
    const double length = (piece.to - piece.from).norm();
    list.add(piece, std::max(1, static_cast<int>(std::ceil(length / half - round_off))));
  });
  SurfacePoints<Dim> surface;
  surface.points = list.points();
  surface.op = fpm::PointOperator<Dim>(model.particles, model.ghosts, surface.points.position,
                                       model.row_options, list.particle);
  return surface;
}

template <int Dim>
fpm::CommonFaces<Dim> surface_faces(const Model<Dim>& model, const SurfacePart& part) {
  PointList<Dim> list;
  for_each_piece(model, part, [&](const SurfacePiece& piece) { list.add(piece, 1); });
  fpm::CommonFaces<Dim> faces;
  faces.points = list.points();
  faces.first = std::move(list.particle);
  return faces;
}

template void cut_body<2>(const scene::Scene&, Model<2>&);
template void cut_body<3>(const scene::Scene&, Model<3>&);
template SurfacePoints<2> surface_points<2>(const Model<2>&, const SurfacePart&);
template SurfacePoints<3> surface_points<3>(const Model<3>&, const SurfacePart&);
template fpm::CommonFaces<2> surface_faces<2>(const Model<2>&, const SurfacePart&);
template fpm::CommonFaces<3> surface_faces<3>(const Model<3>&, const SurfacePart&);

}  // namespace model
