#include "limit/ground/ground_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "limit/ground/ground_boundary.hpp"
#include "limit/ground/ground_cut.hpp"
#include "limit/ground/ground_pressure.hpp"
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

// The least and the largest of what pushes along x in parts of a region, of an earthquake and of
// water, per volume: linear, as a weight is, and so largest in corners.
struct Push {
  double least = 0.0, largest = 0.0;
  double least_of_water = 0.0, largest_of_water = 0.0;  // alone

  [[nodiscard]] bool is_none() const { return least == 0.0 && largest == 0.0; }
  [[nodiscard]] bool is_outwards(const Face& face) const {
    return face.inwards > 0.0 ? least < 0.0 : largest > 0.0;
  }
};

Push push_on(const GroundScene& scene, const problem::Soil& soil,
             const std::vector<GroundPart>& parts, const std::vector<mesh::Point>& wedge) {
  Push push{0.0, 0.0, soil.seepage.x(), soil.seepage.x()};
  if (const auto& told = scene.water.in_triangles) {
    for (const auto& piece : told->field().within(wedge)) {
      push.least_of_water = std::min(push.least_of_water, -piece.gradient.x());
      push.largest_of_water = std::max(push.largest_of_water, -piece.gradient.x());
    }
  }
  for (const GroundPart& part : parts) {
    for (const mesh::Point& place : part.region.outline) {
      const double shaken = scene.load.kh * soil.unit_weight_at(place);
      push.least = std::min(push.least, shaken + push.least_of_water);
      push.largest = std::max(push.largest, shaken + push.largest_of_water);
    }
  }
  return push;
}

// A shear on top of a face, and where it was told.
struct TopShear {
  std::string key;
  double along_x = 0.0;
  double told = 0.0;
};

// Those that act. Along the outline with the ground to the left, on top towards -x.
std::vector<TopShear> shears_on(const GroundScene& scene, const Face& face) {
  const problem::Boundary top = boundary_of(scene, scene.sides[face.top_side]);
  std::vector<TopShear> shears;
  if (top.tangential != problem::Known::traction) return shears;
  const auto look = [&](const char* name, double shear) {
    if (shear != 0.0) {
      shears.push_back({fmt::format("side.{}.{}", face.top_side, name), -shear, shear});
    }
  };
  look("shear", top.shear_stress);
  look("live_shear", top.live_shear_stress);
  return shears;
}

// The scene's own number of a material, parts of which may have others under water and by tables.
std::size_t told_as(const GroundScene& scene, std::size_t material) {
  std::size_t first = 0;
  while (scene.materials[first].name != scene.materials[material].name) ++first;
  return first;
}

// No slice along an upright face that cannot pull bears anything that pushes it outwards.
void check_push(const GroundScene& scene, const Face& face, std::size_t material, const Push& push,
                tables::Diagnosis& diagnosis) {
  const auto refuse = [&](const std::string& key, const std::string& what) {
    diagnosis.error(
        key,
        fmt::format("{} pushes the upright face at ({:.6g}, {:.6g}) outwards, where material {} "
                    "bears no tension",
                    what, face.crest.x(), face.crest.y(), scene.materials[material].name),
        "a slice of it falls off at once, however little pushes: allowed are a face that leans "
        "back, a push into the ground, or a trace of tension, as a thousandth of the cohesion");
  };
  if (push.is_outwards(face)) {
    if (scene.load.kh * face.inwards < 0.0) {
      refuse("load.kh", fmt::format("found {:g}, which", scene.load.kh));
    } else {
      refuse(fmt::format("material.{}.tension_cutoff", told_as(scene, material)),
             fmt::format("found 0, and water that seeps, {:.6g} N/m3 along x,",
                         face.inwards > 0.0 ? push.least_of_water : push.largest_of_water));
    }
  }
  for (const TopShear& shear : shears_on(scene, face)) {
    if (shear.along_x * face.inwards >= 0.0) continue;
    refuse(shear.key, fmt::format("found {:g}, which", shear.told));
  }
}

// Where columns meet what presses on top, few triangles may leave no stress strictly within.
void warn_of_load(const GroundScene& scene, const Face& face, std::size_t material,
                  tables::Diagnosis& diagnosis) {
  const GroundSide& side = scene.sides[face.top_side];
  const problem::Boundary top = boundary_of(scene, side);
  std::string key = fmt::format("side.{}.", face.top_side), found;
  if (top.normal == problem::Known::footing) {
    key += "kind";
    found = "found footing";
  } else if (top.normal_stress != 0.0) {
    key += "pressure";
    found = fmt::format("found {:g}", side.pressure);
  } else if (top.live_normal_stress != 0.0) {
    key += "live_pressure";
    found = fmt::format("found {:g}", side.live_pressure);
  } else {
    return;
  }
  diagnosis.warning(
      key,
      fmt::format("{}, on top of the upright face at ({:.6g}, {:.6g}), where material {} bears no "
                  "tension",
                  found, face.crest.x(), face.crest.y(), scene.materials[material].name),
      "a lower bound may not be found under a load there; a trace of tension, as a thousandth of "
      "the cohesion, has one");
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
      const Push push = push_on(scene, soil, columns, wedge);
      if (bears_none) {
        check_push(scene, face, whole.material, push, diagnosis);
        warn_of_load(scene, face, whole.material, diagnosis);
      }
      // Columns bear what acts straight down.
      if (!bears_none || !push.is_none() || !shears_on(scene, face).empty()) {
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
