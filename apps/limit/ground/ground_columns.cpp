#include "limit/ground/ground_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limit/ground/ground_boundary.hpp"
#include "limit/ground/ground_cut.hpp"
#include "limit/problem/bare_corners.hpp"

namespace limit::ground {

namespace {

// An upright part of the outline, from its lower end to its upper one, and what is on top.
struct Face {
  mesh::Point foot{0.0, 0.0}, crest{0.0, 0.0};
  double inwards = 1.0;  // along x
  double top = 0.0;      // length of the level outline behind the crest
  std::size_t top_side = 0;
};

constexpr double level = 1e-9;  // slope of what is meant to be level or upright

std::vector<Face> faces_of(const GroundScene& scene, const GroundOutline& outline) {
  std::vector<Face> faces;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    const GroundSide& side = scene.sides[static_cast<std::size_t>(segment.side)];
    if (!problem::is_free(boundary_of(scene, side))) continue;
    const mesh::Point &first = outline.at(segment.first), &second = outline.at(segment.second);
    const mesh::Point along = second - first;
    if (std::abs(along.x()) > level * std::abs(along.y())) continue;
    // The ground is to the left.
    Face face{first, second, along.y() > 0.0 ? -1.0 : 1.0};
    if (along.y() < 0.0) std::swap(face.foot, face.crest);
    faces.push_back(face);
  }
  // Of several segments one above the other, one.
  for (bool joined = true; joined;) {
    joined = false;
    for (std::size_t i = 0; i < faces.size() && !joined; ++i) {
      for (std::size_t k = 0; k < faces.size() && !joined; ++k) {
        if (i == k || faces[i].inwards != faces[k].inwards) continue;
        if (faces[i].crest != faces[k].foot) continue;
        faces[i].crest = faces[k].crest;
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(k));
        joined = true;
      }
    }
  }
  for (Face& face : faces) {
    for (const GroundSegment& segment : outline.segments) {
      if (segment.right >= 0) continue;
      const mesh::Point &first = outline.at(segment.first), &second = outline.at(segment.second);
      if (first != face.crest && second != face.crest) continue;
      const mesh::Point back = (first == face.crest ? second : first) - face.crest;
      if (std::abs(back.y()) > level * std::abs(back.x()) || back.x() * face.inwards <= 0.0)
        continue;
      face.top = std::abs(back.x());
      face.top_side = static_cast<std::size_t>(segment.side);
    }
  }
  std::erase_if(faces, [](const Face& face) { return face.top == 0.0; });
  return faces;
}

// What pushes along x, of an earthquake and of water, per volume.
double push_on(const GroundScene& scene, const problem::Soil& soil) {
  return scene.load.kh * soil.unit_weight + soil.seepage.x();
}

// The shear on top of a face, along x.
double shear_on(const GroundScene& scene, const Face& face) {
  const problem::Boundary top = boundary_of(scene, scene.sides[face.top_side]);
  if (top.tangential != problem::Known::traction) return 0.0;
  // Along the outline with the ground to the left, on top towards -x.
  return -(top.shear_stress != 0.0 ? top.shear_stress : top.live_shear_stress);
}

// No slice along an upright face that cannot pull bears anything that pushes it outwards.
void check_push(const GroundScene& scene, const Face& face, std::size_t material,
                tables::Diagnosis& diagnosis) {
  const double push = push_on(scene, scene.materials[material].soil);
  const double shear = shear_on(scene, face);
  const bool is_pushed = push * face.inwards < 0.0;
  if (!is_pushed && shear * face.inwards >= 0.0) return;
  const bool is_shaken = is_pushed && scene.load.kh * face.inwards < 0.0;
  const std::string key = is_shaken   ? "load.kh"
                          : is_pushed ? fmt::format("material.{}.tension_cutoff", material)
                                      : fmt::format("side.{}.shear", face.top_side);
  diagnosis.error(
      key,
      fmt::format("{} pushes the upright face at ({:.6g}, {:.6g}) outwards, where material {} "
                  "bears no tension",
                  is_shaken   ? "an earthquake"
                  : is_pushed ? "water that seeps"
                              : "the shear on top",
                  face.crest.x(), face.crest.y(), scene.materials[material].name),
      "a slice of it falls off at once, however little pushes: allowed are a face that leans back, "
      "a push into the ground, or a trace of tension, as a thousandth of the cohesion");
}

}  // namespace

bool cut_columns(GroundScene& scene, const GroundOutline& outline, tables::Diagnosis& diagnosis) {
  constexpr double lean = 0.1, most = 0.5;  // of the height, of the level ground on top
  const Extent ground = extent_of(scene);
  bool is_any = false;
  for (const Face& face : faces_of(scene, outline)) {
    const double width =
        std::min(lean * (face.crest.y() - face.foot.y()), most * face.top) * face.inwards;
    const std::vector<mesh::Point> wedge{face.foot, face.crest,
                                         face.crest + mesh::Point(width, 0.0)};
    std::vector<GroundRegion> regions;
    for (const GroundRegion& whole : scene.regions) {
      auto columns = parts_within(whole, wedge, ground);
      const problem::Soil& soil = scene.materials[whole.material].soil;
      const bool bears_none = !columns.empty() && soil.tension == 0.0;
      if (bears_none) check_push(scene, face, whole.material, diagnosis);
      // Columns bear what acts straight down.
      if (!bears_none || push_on(scene, soil) != 0.0 || shear_on(scene, face) != 0.0) {
        regions.push_back(whole);
        continue;
      }
      is_any = true;
      GroundMaterial material = scene.materials[whole.material];
      material.soil.stands = true;
      for (GroundPart& part : columns) {
        part.region.material = scene.materials.size();
        regions.push_back(std::move(part.region));
      }
      scene.materials.push_back(std::move(material));
      for (GroundPart& part : parts_beyond(whole, wedge, ground)) {
        regions.push_back(std::move(part.region));
      }
    }
    scene.regions = std::move(regions);
  }
  return is_any;
}

}  // namespace limit::ground
