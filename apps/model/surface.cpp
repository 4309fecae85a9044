#include "model/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "model/cut_cells.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Place = Eigen::Vector2d;

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

// Unit normal of a segment, to its left.
Place left_of(const Place& from, const Place& to) {
  const Place along = (to - from).normalized();
  return {-along.y(), along.x()};
}

constexpr double inward = 1e-6;  // spacings, to be on one side of a segment

// Cuts the segments of a surface where they pass from one cell to another.
std::vector<SurfacePiece> pieces_of(const shape::Body& body, const CutCells& cut,
                                    const fpm::Cells<2>& cells, const std::vector<char>& present) {
  constexpr double sliver = 1e-9;  // spacings
  const auto& lattice = cells.lattice();
  std::vector<SurfacePiece> pieces;
  for (const shape::SurfaceSegment& segment : body.surface()) {
    if (present[static_cast<std::size_t>(segment.region)] == 0) continue;
    const Place along = segment.to - segment.from;
    const Place left = left_of(segment.from, segment.to) * (inward * lattice.spacing);
    const auto cuts = crossings(lattice, segment.from, segment.to);
    bool first = true;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      if ((cuts[k + 1] - cuts[k]) * along.norm() <= sliver * lattice.spacing) continue;
      const Place middle = segment.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      const fpm::Index owner = cut.particle_at(middle + left, segment.region, cells);
      const Place end = segment.from + cuts[k + 1] * along;
      if (!first && pieces.back().particle == owner) {
        pieces.back().to = end;
        continue;
      }
      const Place begin = first ? segment.from : pieces.back().to;
      pieces.push_back({begin, end, owner, segment.cut, segment.side, segment.face});
      first = false;
    }
    if (!first) pieces.back().to = segment.to;
  }
  return pieces;
}

// Cuts a joint into pieces as long as the cells beside it are wide.
std::vector<double> joint_cuts(const shape::Joint& joint, const fpm::Cells<2>& cells) {
  const Place along = joint.to - joint.from;
  const double length = along.norm();
  std::vector<double> cuts{0.0};
  while (cuts.back() < length) {
    const double next = cuts.back() + 0.5 * cells.lattice().spacing;
    const fpm::Index cell = cells.containing(joint.from + std::min(1.0, next / length) * along);
    cuts.push_back(cuts.back() + (cell < 0 ? cells.lattice().spacing : cells.width(cell)));
  }
  // Stretched or shrunk to its length, whichever is less.
  if (cuts.size() > 2 && cuts.back() - length > length - cuts[cuts.size() - 2]) cuts.pop_back();
  for (double& cut : cuts) cut /= cuts.back();
  return cuts;
}

// Of two regions one of which is not there the joint is surface.
std::vector<SurfacePiece> exposed(const shape::Body& body, const CutCells& cut,
                                  const fpm::Cells<2>& cells, const std::vector<char>& present) {
  std::vector<SurfacePiece> pieces;
  for (const shape::Joint& joint : body.joints()) {
    const bool left = present[static_cast<std::size_t>(joint.left)] != 0;
    if (left == (present[static_cast<std::size_t>(joint.right)] != 0)) continue;
    const int region = left ? joint.left : joint.right;
    const Place from = left ? joint.from : joint.to, to = left ? joint.to : joint.from;
    const Place within = left_of(from, to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts(joint, cells);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Place middle = from + 0.5 * (cuts[k] + cuts[k + 1]) * (to - from);
      SurfacePiece piece{from + cuts[k] * (to - from), from + cuts[k + 1] * (to - from),
                         cut.particle_at(middle + within, region, cells)};
      piece.side = exposed_side;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

std::vector<JointPiece> joints_of(const shape::Body& body, const CutCells& cut,
                                  const fpm::Cells<2>& cells, const std::vector<char>& present) {
  std::vector<JointPiece> pieces;
  for (const shape::Joint& joint : body.joints()) {
    if (present[static_cast<std::size_t>(joint.left)] == 0 ||
        present[static_cast<std::size_t>(joint.right)] == 0) {
      continue;
    }
    const Place along = joint.to - joint.from;
    const Place left = left_of(joint.from, joint.to) * (inward * cells.lattice().spacing);
    const auto cuts = joint_cuts(joint, cells);
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
      const Place middle = joint.from + 0.5 * (cuts[k] + cuts[k + 1]) * along;
      pieces.push_back({joint.from + cuts[k] * along, joint.from + cuts[k + 1] * along,
                        cut.particle_at(middle + left, joint.left, cells),
                        cut.particle_at(middle - left, joint.right, cells)});
    }
  }
  return pieces;
}

fpm::Index nearest_to(const Place& place, const fpm::Field<2>& position) {
  Eigen::Index nearest = 0;
  (position.rowwise() - place.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<fpm::Index>(nearest);
}

// Pieces that lie on what belongs to no cell, by round-off, go to the nearest particle.
void find_owners(const fpm::Field<2>& position, std::vector<SurfacePiece>& pieces) {
  for (SurfacePiece& piece : pieces) {
    if (piece.particle >= 0) continue;
    const Place middle = 0.5 * (piece.from + piece.to);
    piece.particle = nearest_to(middle, position);
  }
}

// What has no owner lies on what belongs to no cell, by round-off.
void find_owners(const fpm::Field<2>& position, std::vector<JointPiece>& pieces) {
  for (JointPiece& piece : pieces) {
    const Place middle = 0.5 * (piece.from + piece.to);
    for (fpm::Index* particle : {&piece.first, &piece.second}) {
      if (*particle < 0) *particle = nearest_to(middle, position);
    }
  }
}

void cut_plane_body(const scene::Scene& scene, Model<2>& model) {
  const shape::Body body = scene::body_of(scene);
  const fpm::Cells<2> whole = model.cells;
  const CutCells cut(body, whole);
  std::vector<char> present(static_cast<std::size_t>(body.regions()), 1);
  for (std::size_t r = 0; r < scene.region.size(); ++r) present[r] = scene.region[r].present;
  model.cells = cut.standing(present);
  model.particles = fpm::make_particles(model.cells);
  Eigen::VectorXd area = Eigen::VectorXd::Zero(model.size());
  fpm::Field<2> moment = fpm::Field<2>::Zero(model.size(), 2);
  cut.for_each_share(model.cells, [&](fpm::Index b, double share, const Place& centroid) {
    area[b] += share;
    moment.row(b) += share * (centroid - model.cells.site(b)).transpose();
  });
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
  model.surface = pieces_of(body, cut, model.cells, present);
  for (const SurfacePiece& piece : exposed(body, cut, model.cells, present)) {
    model.surface.push_back(piece);
  }
  find_owners(model.particles.position, model.surface);
  if (scene.region.empty()) return;
  model.joints = joints_of(body, cut, model.cells, present);
  find_owners(model.particles.position, model.joints);
  for (const int region : cut.regions(model.cells)) {
    model.material.push_back(
        static_cast<MaterialIndex>(scene::material_of(scene, static_cast<std::size_t>(region))));
  }
}

bool is_of(const SurfacePiece& piece, const SurfacePart& part) {
  switch (part.of) {
    case SurfacePart::Of::cutout:
      return piece.cut == part.index;
    case SurfacePart::Of::side:
      return piece.side == part.index &&
             !part.without[piece.face < 0 ? SurfacePart::no_face
                                          : static_cast<std::size_t>(piece.face)];
    case SurfacePart::Of::exposed:
      return piece.side == exposed_side;
    case SurfacePart::Of::face:
      break;
  }
  return piece.face == part.index;
}

// The part of a piece of a face that a range leaves; nothing if there is none.
std::optional<SurfacePiece> clipped(SurfacePiece piece, const SurfacePart& part, double sliver) {
  if (part.of != SurfacePart::Of::face) return piece;
  const int along = 1 - part.index / 2;
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

template <int Dim>
fpm::CommonFaces<Dim> joint_faces(const Model<Dim>& model) {
  PointList<Dim> list;
  fpm::CommonFaces<Dim> faces;
  for (const JointPiece& joint : model.joints) {
    const auto body = [&](fpm::Index a) {
      return model.particles.body[static_cast<std::size_t>(a)];
    };
    if (body(joint.first) == body(joint.second)) continue;
    list.add({joint.from, joint.to, joint.first}, 1);
    faces.second.push_back(joint.second);
  }
  faces.points = list.points();
  faces.first = std::move(list.particle);
  return faces;
}

template void cut_body<2>(const scene::Scene&, Model<2>&);
template void cut_body<3>(const scene::Scene&, Model<3>&);
template SurfacePoints<2> surface_points<2>(const Model<2>&, const SurfacePart&);
template SurfacePoints<3> surface_points<3>(const Model<3>&, const SurfacePart&);
template fpm::CommonFaces<2> joint_faces<2>(const Model<2>&);
template fpm::CommonFaces<3> joint_faces<3>(const Model<3>&);
template fpm::CommonFaces<2> surface_faces<2>(const Model<2>&, const SurfacePart&);
template fpm::CommonFaces<3> surface_faces<3>(const Model<3>&, const SurfacePart&);

}  // namespace model
