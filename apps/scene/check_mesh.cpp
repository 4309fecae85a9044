// Rules on meshes, and on bodies whose particles are elements.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "scene/check.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"

namespace scene {
namespace {

class Refusal {
 public:
  explicit Refusal(tables::Diagnosis& diagnosis) : diagnosis_(diagnosis) {}
  void operator()(bool refused, const std::string& key, const std::string& found,
                  const std::string& allowed) {
    if (refused && diagnosis_.good({key})) diagnosis_.error(key, found, allowed);
  }

 private:
  tables::Diagnosis& diagnosis_;
};

// What belongs to cells.
void check_elements(const Scene& scene, Refusal& refuse) {
  const std::string why = "particles that are elements are as far apart as they are in the mesh";
  refuse(scene.geometry.jitter > 0.0, "geometry.jitter",
         fmt::format("found {}", scene.geometry.jitter), why);
  refuse(scene.grading.enabled, "grading.enabled", "found true", why);
  refuse(!scene.refine.empty(), "refine.0", "found where particles are elements", why);
  refuse(!scene.cutout.empty(), "cutout.0", "found where particles are elements",
         "leave it out of the mesh");
}

void check_solid(const Scene& scene, Refusal& refuse) {
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    const OutlineSide& side = scene.side[i];
    const auto refuse_shear = [&](const char* name, double value) {
      refuse(value != 0.0, fmt::format("side.{}.{}", i, name), fmt::format("found {}", value),
             "a face of a solid has no one direction along it: give a pressure");
    };
    refuse_shear("shear", side.shear);
    refuse_shear("live_shear", side.live_shear);
  }
  for (std::size_t i = 0; i < scene.traction.size(); ++i) {
    refuse(true, fmt::format("traction.{}", i), "found on a body of volumes",
           "give a loaded [[side]] a pressure");
  }
  for (std::size_t i = 0; i < scene.support.size(); ++i) {
    const Support& support = scene.support[i];
    const bool known = support.side && (support.method == SupportMethod::automatic ||
                                        support.method == SupportMethod::ghosts);
    refuse(!known, fmt::format("support.{}", i),
           support.side ? fmt::format("found the method {}", name_of(support.method))
                        : "found without a side",
           "a body of volumes is held by its sides of kind fixed or roller");
  }
  refuse(scene.drive.kind == DriveKind::displacement &&
             std::ranges::none_of(
                 scene.side,
                 [](const OutlineSide& side) { return side.kind == OutlineKind::footing; }),
         "drive.kind", "found displacement, and no side of kind footing",
         "what a drive moves of a body of volumes is its footing");
}

}  // namespace

void check_mesh(const Scene& scene, int dimension, tables::Diagnosis& diagnosis) {
  if (!diagnosis.errors().empty()) return;
  Refusal refuse(diagnosis);
  const bool elements = scene.mesh.particles == MeshParticles::elements;
  refuse(elements && dimension == 0, "mesh.particles", "found elements without a mesh",
         "give mesh.file");
  refuse(dimension == 3 && scene.geometry.dimension == 2, "geometry.dimension",
         "found 2 with a solid mesh", "volumes are regions of dimension 3");
  refuse(dimension == 2 && scene.geometry.dimension == 3, "geometry.dimension",
         "found 3 with a plane mesh",
         "a solid mesh has a physical group of tetrahedra or the like");
  refuse(dimension == 3 && !elements, "mesh.particles", "found cells with a solid mesh",
         "particles of a solid are its elements: \"elements\"");
  if (elements) check_elements(scene, refuse);
  if (dimension == 3) check_solid(scene, refuse);
}

}  // namespace scene
