// Stands for ground_mesh.cpp in a program that may be passed on under the terms of this project.
#include <stdexcept>

#include "limit/ground/ground_mesh.hpp"

namespace limit::ground {

const bool can_mesh_ground = false;

mesh::Mesh ground_mesh(const GroundScene&, const GroundOutline&, const GroundFineness&) {
  throw std::logic_error("ground mesh: built without CGAL");
}

}  // namespace limit::ground
