#include "limit/ground/ground_columns.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "limit/ground/ground_cut.hpp"

namespace limit::ground {

namespace {

// An upright part of the outline, from its lower end to its upper one, and what is on top.
struct Face {
  mesh::Point foot{0.0, 0.0}, crest{0.0, 0.0};
  double inwards = 1.0;  // along x
  double top = 0.0;      // length of the level outline behind the crest
};

constexpr double level = 1e-9;  // slope of what is meant to be level or upright

bool is_bare(const GroundSide& side) {
  return side.kind == SideKind::free ||
         (side.kind == SideKind::loaded && side.pressure == 0.0 && side.shear == 0.0 &&
          side.live_pressure == 0.0 && side.live_shear == 0.0);
}

std::vector<Face> faces_of(const GroundScene& scene, const GroundOutline& outline) {
  std::vector<Face> faces;
  for (const GroundSegment& segment : outline.segments) {
    if (segment.right >= 0) continue;
    if (!is_bare(scene.sides[static_cast<std::size_t>(segment.side)])) continue;
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
    }
  }
  std::erase_if(faces, [](const Face& face) { return face.top == 0.0; });
  return faces;
}

// Whether it is no more than weight, straight down, that acts on a soil of no tension.
bool stands(const GroundScene& scene, const GroundMaterial& material) {
  const bool is_shaken = scene.load.kh != 0.0;
  return material.soil.tension == 0.0 && material.soil.seepage.x() == 0.0 && !is_shaken;
}

}  // namespace

bool cut_columns(GroundScene& scene, const GroundOutline& outline) {
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
      if (columns.empty() || !stands(scene, scene.materials[whole.material])) {
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
