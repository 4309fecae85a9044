#include "model/extrude.hpp"

#include <cmath>

#include "model/grid_cells.hpp"
#include "model/prism_faces.hpp"

namespace model {
namespace {

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
    model.surface.push_back(prism_wall(piece, z, thickness));
    model.surface.back().particle += first;
  }
  for (const JointPiece<2>& joint : section.joints) {
    model.joints.push_back(prism_joint(joint, z, thickness));
    model.joints.back().first += first;
    model.joints.back().second += first;
  }
}

void add_end(const Model<2>& section, fpm::Index layer, double z, int face, Model<3>& model) {
  const auto n = static_cast<fpm::Index>(section.size());
  for (fpm::Index a = 0; a < n; ++a) {
    model.surface.push_back(prism_end(section, a, z, face));
    model.surface.back().particle += layer * n;
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
  for (const ThinLayer<2>& thin : section.thin_layers) {
    model.thin_layers.push_back({thin.layer, thin.beside, {thin.place.x(), thin.place.y(), low}});
  }
  add_end(section, 0, low, 4, model);
  add_end(section, layers - 1, high, 5, model);
  model.background = cells_behind(model);
}

}  // namespace model
