#pragma once

#include <optional>
#include <vector>

#include "scene/choices.hpp"
#include "shape/gmsh.hpp"
#include "shape/mesh_parts.hpp"
#include "tables/diagnosis.hpp"

namespace scene {

struct Scene;

/// A body whose particles are the elements of its mesh.
struct ElementBody {
  shape::GmshMesh mesh;
  shape::MeshBody joined;  // parts by the scene's regions
  std::vector<int> side;   // of the scene, of each facet; -1 within the body
};

/// Whether a scene's particles are the elements of its mesh.
[[nodiscard]] bool has_elements(const Scene& scene);

/// Whether a scene's regions are volumes of a mesh.
[[nodiscard]] bool is_solid(const Scene& scene);

/// Whether they are polygons in space: prisms along z.
[[nodiscard]] bool is_extruded(const Scene& scene);

/// Whether loads name a face of the box rather than a [[side]]: those of a box, and the ends of
/// prisms.
[[nodiscard]] bool is_face_by_itself(const Scene& scene, Side side);

/// Reads the body of a scene whose particles are elements. What is no body is an error of the
/// diagnosis: regions that elements do not fill or share, surface without a side, sides that are no
/// surface.
[[nodiscard]] std::optional<ElementBody> read_elements(const Scene& scene,
                                                       tables::Diagnosis& diagnosis);

/// That of a checked scene.
[[nodiscard]] ElementBody elements_of(const Scene& scene);

/// The face of the box that a facet of the surface lies on.
[[nodiscard]] std::optional<Side> face_of(const Scene& scene, const shape::GmshMesh& mesh,
                                          const std::vector<int>& facet);

}  // namespace scene
