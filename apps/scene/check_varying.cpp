#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "scene/check.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"

namespace scene {
namespace {

// The coordinates along an axis of the faces of all boxes of materials, within the body.
std::vector<double> faces_along(const Scene& scene, std::size_t axis) {
  const double low = scene.geometry.min[axis], high = scene.geometry.max[axis];
  std::vector<double> faces{low, high};
  for (const Material& material : scene.material) {
    for (const Point* corner : {&material.region_min, &material.region_max}) {
      if (axis < corner->size()) faces.push_back(std::clamp((*corner)[axis], low, high));
    }
  }
  std::ranges::sort(faces);
  return faces;
}

// Corners of the boxes, in the plane, that the body is made of where it is of a material.
std::vector<PlanePoint> corners_of_boxes(const Scene& scene, std::size_t index) {
  const auto x = faces_along(scene, 0), y = faces_along(scene, 1);
  // In space a material may be anywhere along the third axis.
  const bool plane = scene.geometry.dimension == 2;
  std::vector<PlanePoint> corners;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      if (x[i] == x[i + 1] || y[j] == y[j + 1]) continue;
      const std::array<double, 2> middle{0.5 * (x[i] + x[i + 1]), 0.5 * (y[j] + y[j + 1])};
      if (plane && material_at(scene, middle) != index) continue;
      corners.insert(corners.end(),
                     {{x[i], y[j]}, {x[i + 1], y[j]}, {x[i + 1], y[j + 1]}, {x[i], y[j + 1]}});
    }
  }
  return corners;
}

// Corners of a solid's elements that are of a material.
std::vector<PlanePoint> corners_of_elements(const Scene& scene, std::size_t index) {
  std::vector<PlanePoint> corners;
  const ElementBody body = elements_of(scene);
  for (const shape::MeshPart& part : body.joined.parts) {
    if (material_of(scene, static_cast<std::size_t>(part.region)) != index) continue;
    for (const int node : body.mesh.elements[static_cast<std::size_t>(part.element)].nodes) {
      corners.emplace_back(body.mesh.at(node).x(), body.mesh.at(node).y());
    }
  }
  return corners;
}

// Corners of where a material is, in the plane.
std::vector<PlanePoint> corners_of(const Scene& scene, std::size_t index) {
  if (scene.region.empty()) return corners_of_boxes(scene, index);
  if (is_solid(scene)) return corners_of_elements(scene, index);
  std::vector<PlanePoint> corners;
  for (const Region& region : scene.region) {
    if (region.material != scene.material[index].name) continue;
    corners.insert(corners.end(), region.outline.begin(), region.outline.end());
  }
  return corners;
}

// Whether each material after the first has its box.
bool have_boxes(const Scene& scene) {
  const auto n = static_cast<std::size_t>(scene.geometry.dimension);
  return !scene.region.empty() ||
         std::all_of(scene.material.begin() + 1, scene.material.end(), [&](const Material& m) {
           return m.region_min.size() == n && m.region_max.size() == n;
         });
}

}  // namespace

void check_varying(const Scene& scene, std::size_t index, tables::Diagnosis& diagnosis) {
  const Material& material = scene.material[index];
  if (!varies(material) || !box_is_good(scene, diagnosis) || !have_boxes(scene)) return;
  const auto corners = corners_of(scene, index);
  // A linear value is least in a corner.
  const auto check = [&](const tables::LinearField& field, const char* name, bool may_vanish,
                         const char* allowed) {
    const std::string key = fmt::format("material.{}.{}", index, name);
    if (!field.varies() || !diagnosis.good({key})) return;
    for (const PlanePoint& corner : corners) {
      const std::array<double, 2> place{corner.x(), corner.y()};
      const double here = field.at_place(place);
      if (here > 0.0 || (may_vanish && here == 0.0)) continue;
      diagnosis.error(key, fmt::format("{:g} at ({:g}, {:g})", here, corner.x(), corner.y()),
                      allowed);
      return;
    }
  };
  check(material.youngs_modulus, "youngs_modulus", false,
        "allowed is a modulus of more than zero wherever the material is");
  if (material.cohesion) {
    // Particles of cells are within their material.
    const bool may_vanish = scene.geometry.layout == Layout::cell;
    check(*material.cohesion, "cohesion", may_vanish,
          may_vanish ? "allowed is a cohesion of zero or more wherever the material is"
                     : "allowed is a cohesion of more than zero wherever the material is");
  }
}

}  // namespace scene
