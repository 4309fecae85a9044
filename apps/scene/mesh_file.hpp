#pragma once

#include <string>

#include "scene/choices.hpp"

namespace scene {

/// A mesh of Gmsh whose groups say where regions and sides are; neither file nor text: none.
struct MeshFile {
  std::string file;   // beside the scene; empty once read
  double unit = 1.0;  // [m] of its coordinates
  MeshParticles particles = MeshParticles::cells;
  std::string text;  // of the file; once read that of a body whose particles are elements
  bool operator==(const MeshFile&) const = default;
};

/// Whether there is a mesh.
[[nodiscard]] inline bool is_given(const MeshFile& mesh) {
  return !mesh.file.empty() || !mesh.text.empty();
}

}  // namespace scene
