#include "model/extrude.hpp"

#include <cmath>

#include "model/grid_cells.hpp"

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

void add_layer(const Model<2>& section, fpm::Index layer, double z, double thickness,
               Model<3>& model) {
  const auto n = static_cast<fpm::Index>(section.size());
  const fpm::Index first = layer * n;
  model.particles.position.block(first, 0, n, 2) = section.particles.position;
  model.particles.position.block(first, 2, n, 1).setConstant(z);
  model.particles.volume.segment(first, n) = thickness * section.particles.volume;
  model.material.insert(model.material.end(), section.material.begin(), section.material.end());
  model.particles.body.insert(model.particles.body.end(), section.particles.body.begin(),
                              section.particles.body.end());
  for (const SurfacePiece<2>& piece : section.surface) {
    SurfacePiece<3>& wall = model.surface.emplace_back();
    wall.middle = in_space(middle_of(piece), z);
    wall.outward = right_of(piece.from, piece.to);
    wall.area = (piece.to - piece.from).norm() * thickness;
    wall.particle = first + piece.particle;
    wall.cut = piece.cut;
    wall.side = piece.side;
    wall.face = piece.face;
    wall.edges = {in_space(piece.to - piece.from, 0.0), thickness * Eigen::Vector3d::UnitZ()};
  }
  for (const JointPiece<2>& joint : section.joints) {
    model.joints.push_back(
        {in_space(0.5 * (joint.from + joint.to), z), right_of(joint.from, joint.to),
         (joint.to - joint.from).norm() * thickness, first + joint.first, first + joint.second});
  }
}

// An end of the prisms: face 4, front, or 5, back.
void add_end(const Model<2>& section, fpm::Index layer, double z, int face, Model<3>& model) {
  const auto n = static_cast<fpm::Index>(section.size());
  for (fpm::Index a = 0; a < n; ++a) {
    SurfacePiece<3>& end = model.surface.emplace_back();
    end.middle = in_space(section.particles.position.row(a).transpose(), z);
    end.outward = {0.0, 0.0, face == 5 ? 1.0 : -1.0};
    end.area = section.particles.volume[a];
    end.particle = layer * n + a;
    end.face = face;
    const double width = section.cells.width(a);
    if (end.area == width * width) {
      end.edges = {width * Eigen::Vector3d::UnitX(), width * Eigen::Vector3d::UnitY()};
    }
  }
}

}  // namespace

void extrude(const Model<2>& section, Model<3>& model) {
  const double low = model.box_min[2], high = model.box_max[2];
  const auto layers = static_cast<fpm::Index>(std::lround((high - low) / model.spacing));
  const double thickness = (high - low) / layers;
  model.particles.position.resize(layers * section.size(), 3);
  model.particles.volume.resize(layers * section.size());
  for (fpm::Index k = 0; k < layers; ++k) {
    add_layer(section, k, low + (k + 0.5) * thickness, thickness, model);
  }
  add_end(section, 0, low, 4, model);
  add_end(section, layers - 1, high, 5, model);
  model.background = cells_behind(model);
}

}  // namespace model
