// Stands for ground_mesh.cpp in a program that may be passed on under the terms of this project.
#include <stdexcept>

#include "limit/ground/ground_mesh.hpp"

namespace limit::ground {

Mesh ground_mesh(const GroundScene&, const GroundOutline&, const GroundFineness&) {
  throw std::invalid_argument(
      "this fpm-limit was built without CGAL, which meshes ground of polygons and is under the "
      "GPL; `./fpmw build` builds one with it (cmake -DFPM_WITH_CGAL=ON)");
}

}  // namespace limit::ground
