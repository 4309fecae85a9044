#include "model/prism_faces.hpp"

namespace model {
namespace {

Eigen::Vector3d in_space(const Eigen::Vector2d& place, double z) {
  return {place.x(), place.y(), z};
}

// Unit normal of a straight piece, to its right.
Eigen::Vector3d right_of(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = (to - from).normalized();
  return {along.y(), -along.x(), 0.0};
}

}  // namespace

SurfacePiece<3> prism_wall(const SurfacePiece<2>& piece, double middle, double height) {
  SurfacePiece<3> wall;
  wall.middle = in_space(middle_of(piece), middle);
  wall.outward = right_of(piece.from, piece.to);
  wall.area = (piece.to - piece.from).norm() * height;
  wall.particle = piece.particle;
  wall.cut = piece.cut;
  wall.side = piece.side;
  wall.face = piece.face;
  wall.edges = {in_space(piece.to - piece.from, 0.0), height * Eigen::Vector3d::UnitZ()};
  return wall;
}

JointPiece<3> prism_joint(const JointPiece<2>& joint, double middle, double height) {
  return {in_space(0.5 * (joint.from + joint.to), middle), right_of(joint.from, joint.to),
          (joint.to - joint.from).norm() * height, joint.first, joint.second};
}

SurfacePiece<3> prism_end(const Model<2>& section, fpm::Index particle, double z, int face) {
  SurfacePiece<3> end;
  end.middle = in_space(section.particles.position.row(particle).transpose(), z);
  end.outward = {0.0, 0.0, face == 5 ? 1.0 : -1.0};
  end.area = section.particles.volume[particle];
  end.particle = particle;
  end.face = face;
  const double width = section.cells.width(particle);
  if (end.area == width * width) {
    end.edges = {width * Eigen::Vector3d::UnitX(), width * Eigen::Vector3d::UnitY()};
  }
  return end;
}

}  // namespace model
