#include "model/surface.hpp"

#include <algorithm>
#include <cmath>

namespace model {
namespace {

using Place = Eigen::Vector2d;

template <int Dim>
bool is_of(const SurfacePiece<Dim>& piece, const SurfacePart& part) {
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
std::optional<SurfacePiece<2>> clipped(SurfacePiece<2> piece, const SurfacePart& part,
                                       double sliver) {
  if (part.of != SurfacePart::Of::face) return piece;
  const int along = 1 - part.index / 2;
  const auto k = static_cast<std::size_t>(along);
  for (double* x : {&piece.from[along], &piece.to[along]}) {
    *x = std::clamp(*x, part.from[k], part.to[k]);
  }
  if ((piece.to - piece.from).norm() <= sliver) return std::nullopt;
  return piece;
}

// Of a rectangle along the axes the part within a range is known; another piece of a solid is
// within it or not, as its middle is.
std::optional<SurfacePiece<3>> clipped(SurfacePiece<3> piece, const SurfacePart& part,
                                       double sliver) {
  if (part.of != SurfacePart::Of::face) return piece;
  for (int i = 0; i < 3; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i == part.index / 2) continue;
    double width = 0.0;
    for (const Eigen::Vector3d& edge : piece.edges) width += std::abs(edge[i]);
    const double low = std::max(piece.middle[i] - 0.5 * width, part.from[k]);
    const double high = std::min(piece.middle[i] + 0.5 * width, part.to[k]);
    if (width == 0.0 ? high < low : high - low <= sliver) return std::nullopt;
    if (width == 0.0 || high - low >= width - sliver) continue;
    piece.area *= (high - low) / width;
    piece.middle[i] = 0.5 * (low + high);
    for (Eigen::Vector3d& edge : piece.edges) edge[i] *= (high - low) / width;
  }
  return piece;
}

// Calls visit(piece) for the pieces of a part.
template <int Dim, class Visitor>
void for_each_piece(const Model<Dim>& model, const SurfacePart& part, Visitor&& visit) {
  constexpr double sliver = 1e-9;
  for (const SurfacePiece<Dim>& each : model.surface) {
    if (!is_of(each, part)) continue;
    if (const auto piece = clipped(each, part, sliver * model.spacing)) visit(*piece);
  }
}

// Two to the spacing of a particle, along what is `length` long.
template <int Dim>
int points_along(const Model<Dim>& model, fpm::Index particle, double length) {
  const double half = 0.5 * model.spacing_at(particle);
  constexpr double round_off = 1e-9;
  return std::max(1, static_cast<int>(std::ceil(length / half - round_off)));
}

// Points of a part of the surface, whose number is not known beforehand.
template <int Dim>
struct PointList {
  std::vector<fpm::Vector<Dim>> position, normal;
  std::vector<double> weight;
  std::vector<fpm::Index> particle;

  void add(const fpm::Vector<Dim>& place, const fpm::Vector<Dim>& outward, double area,
           fpm::Index owner) {
    position.push_back(place);
    normal.push_back(outward);
    weight.push_back(area);
    particle.push_back(owner);
  }
  void add(const Place& from, const Place& to, fpm::Index owner, int count) {
    const Place along = to - from;
    const Place outward = Place(along.y(), -along.x()).normalized();
    for (int k = 0; k < count; ++k) {
      add(from + (k + 0.5) / count * along, outward, along.norm() / count, owner);
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
      result.position.row(c) = position[k].transpose();
      result.normal.row(c) = normal[k].transpose();
      result.weight[c] = weight[k];
    }
    return result;
  }
};

void add_points(const Model<2>& model, const SurfacePiece<2>& piece, PointList<2>& list) {
  list.add(piece.from, piece.to, piece.particle, point_count(model, piece));
}

// A rectangle has as many to its edges as a straight piece; the centroid is all there is of others.
void add_points(const Model<3>& model, const SurfacePiece<3>& piece, PointList<3>& list) {
  const std::array<int, 2> count{points_along(model, piece.particle, piece.edges[0].norm()),
                                 points_along(model, piece.particle, piece.edges[1].norm())};
  for (int j = 0; j < count[1]; ++j) {
    for (int i = 0; i < count[0]; ++i) {
      const Eigen::Vector3d place = piece.middle + ((i + 0.5) / count[0] - 0.5) * piece.edges[0] +
                                    ((j + 0.5) / count[1] - 0.5) * piece.edges[1];
      list.add(place, piece.outward, piece.area / (count[0] * count[1]), piece.particle);
    }
  }
}

void add_face(const SurfacePiece<2>& piece, PointList<2>& list) {
  list.add(piece.from, piece.to, piece.particle, 1);
}
void add_face(const SurfacePiece<3>& piece, PointList<3>& list) {
  list.add(piece.middle, piece.outward, piece.area, piece.particle);
}
void add_face(const JointPiece<2>& joint, PointList<2>& list) {
  list.add(joint.from, joint.to, joint.first, 1);
}
void add_face(const JointPiece<3>& joint, PointList<3>& list) {
  list.add(joint.middle, joint.normal, joint.area, joint.first);
}

}  // namespace

int point_count(const Model<2>& model, const SurfacePiece<2>& piece) {
  return points_along(model, piece.particle, (piece.to - piece.from).norm());
}

template <int Dim>
SurfacePoints<Dim> surface_points(const Model<Dim>& model, const SurfacePart& part) {
  PointList<Dim> list;
  for_each_piece(model, part,
                 [&](const SurfacePiece<Dim>& piece) { add_points(model, piece, list); });
  SurfacePoints<Dim> surface;
  surface.points = list.points();
  surface.op = fpm::PointOperator<Dim>(model.particles, model.ghosts, surface.points.position,
                                       model.row_options, list.particle);
  return surface;
}

template <int Dim>
fpm::CommonFaces<Dim> surface_faces(const Model<Dim>& model, const SurfacePart& part) {
  PointList<Dim> list;
  for_each_piece(model, part, [&](const SurfacePiece<Dim>& piece) { add_face(piece, list); });
  fpm::CommonFaces<Dim> faces;
  faces.points = list.points();
  faces.first = std::move(list.particle);
  return faces;
}

template <int Dim>
fpm::CommonFaces<Dim> joint_faces(const Model<Dim>& model) {
  PointList<Dim> list;
  fpm::CommonFaces<Dim> faces;
  for (const JointPiece<Dim>& joint : model.joints) {
    const auto body = [&](fpm::Index a) {
      return model.particles.body[static_cast<std::size_t>(a)];
    };
    if (body(joint.first) == body(joint.second)) continue;
    add_face(joint, list);
    faces.second.push_back(joint.second);
  }
  faces.points = list.points();
  faces.first = std::move(list.particle);
  return faces;
}

template SurfacePoints<2> surface_points<2>(const Model<2>&, const SurfacePart&);
template SurfacePoints<3> surface_points<3>(const Model<3>&, const SurfacePart&);
template fpm::CommonFaces<2> joint_faces<2>(const Model<2>&);
template fpm::CommonFaces<3> joint_faces<3>(const Model<3>&);
template fpm::CommonFaces<2> surface_faces<2>(const Model<2>&, const SurfacePart&);
template fpm::CommonFaces<3> surface_faces<3>(const Model<3>&, const SurfacePart&);

}  // namespace model
