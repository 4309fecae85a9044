#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "shape/point.hpp"

namespace shape {

/// What of a mesh of Gmsh says where regions and sides are, and may be a body's particles: the
/// solids, faces and lines of its physical groups.
struct GmshMesh {
  struct Group {
    int dimension = 0;  // 1 lines, 2 faces, 3 solids
    int tag = 0;
    std::string name;  // its tag if the file gives it none
  };
  struct Element {
    int group = 0;
    // 2 of a line; 3 or 4 of a face, counterclockwise in a plane mesh; of a solid as Gmsh orders
    // them, turned so that its volume is positive (mesh_solids.hpp).
    std::vector<int> nodes;
  };
  int dimension = 2;  // 3: there are solids, and nodes anywhere
  std::vector<Group> groups;
  std::vector<SpacePoint> nodes;  // [m] of a plane mesh in one plane z = const
  std::vector<Element> elements;

  [[nodiscard]] const SpacePoint& at(int node) const {
    return nodes[static_cast<std::size_t>(node)];
  }
  [[nodiscard]] Point plane_at(int node) const { return at(node).head<2>(); }
  [[nodiscard]] int dimension_of(const Element& element) const {
    return groups[static_cast<std::size_t>(element.group)].dimension;
  }
};

/// What is wrong with a mesh.
class GmshError : public std::runtime_error {
 public:
  /// @param line  of the file; 0: of the file as a whole
  GmshError(std::size_t line, const std::string& what) : std::runtime_error(what), line_(line) {}
  [[nodiscard]] std::size_t line() const { return line_; }

 private:
  std::size_t line_;
};

}  // namespace shape
