#pragma once

#include <string>

namespace scene {

/// A mesh of Gmsh whose groups say where regions and sides are; no file: none.
struct MeshFile {
  std::string file;   // beside the scene; empty once read
  double unit = 1.0;  // [m] of its coordinates
  bool operator==(const MeshFile&) const = default;
};

}  // namespace scene
