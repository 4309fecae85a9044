#pragma once

#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace run {

/// A rectangle of the surface that is one particle's.
struct Tile {
  Eigen::Vector3d middle, outward;
  std::array<Eigen::Vector3d, 2> edges;  // [m]
  Eigen::Index particle = 0;             // -1: of none
  int side = -1, face = -1;              // as of model::SurfacePiece
  std::vector<Eigen::Vector3d> corners;  // [m] where they are known, in place of the edges'
};

/// What holds, loads or moves a part of the surface.
struct Condition {
  std::string_view colour;
  std::string name, text;
  std::function<bool(const Tile&)> is_of;
};

/// The surface of a body in space.
std::vector<Tile> tiles_of(const scene::Scene& scene, const model::Model<3>& model);

/// What acts on it, in the order of the legend; they refer to the model and the scene.
std::vector<Condition> conditions_of(const scene::Scene& scene, const model::Model<3>& model,
                                     const std::vector<Tile>& tiles);

}  // namespace run
