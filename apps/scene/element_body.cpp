#include "scene/element_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene/box.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"
#include "shape/mesh_outline.hpp"
#include "shape/mesh_solids.hpp"
#include "shape/ring.hpp"

namespace scene {
namespace {

constexpr double same = 1e-9;  // of areas and coordinates

std::string text_of(const shape::GmshMesh& mesh, const shape::SpacePoint& place) {
  return mesh.dimension == 2
             ? fmt::format("({:.6g}, {:.6g})", place.x(), place.y())
             : fmt::format("({:.6g}, {:.6g}, {:.6g})", place.x(), place.y(), place.z());
}

shape::SpacePoint middle_of(const shape::GmshMesh& mesh, const std::vector<int>& nodes) {
  shape::SpacePoint sum = shape::SpacePoint::Zero();
  for (const int node : nodes) sum += mesh.at(node);
  return sum / static_cast<double>(nodes.size());
}

std::string name_of_region(const Scene& scene, std::size_t region) {
  const Region& named = scene.region[region];
  if (!named.name.empty()) return named.name;
  return named.group.empty() ? fmt::format("region {}", region) : named.group;
}

// Of each element the region that is its group, -1 for none.
std::vector<int> regions_by_group(const Scene& scene, const shape::GmshMesh& mesh,
                                  tables::Diagnosis& diagnosis) {
  std::map<int, int> of_group;
  for (std::size_t r = 0; r < scene.region.size(); ++r) {
    const auto group = shape::find_group(mesh, 3, scene.region[r].group);
    if (!group) continue;
    const auto [at, is_new] = of_group.emplace(*group, static_cast<int>(r));
    if (is_new) continue;
    diagnosis.error(fmt::format("region.{}.group", r),
                    fmt::format("found \"{}\" again", scene.region[r].group),
                    "a volume is one region");
  }
  std::vector<int> region;
  for (const auto& element : mesh.elements) {
    const auto found = of_group.find(element.group);
    region.push_back(found == of_group.end() ? -1 : found->second);
  }
  return region;
}

// Of each element the region whose polygon holds its middle, -1 for none.
std::vector<int> regions_by_outline(const Scene& scene, const shape::GmshMesh& mesh) {
  const auto ring_of = [](const std::vector<PlanePoint>& corners) {
    shape::Ring ring;
    for (const PlanePoint& corner : corners) ring.emplace_back(corner.x(), corner.y());
    return ring;
  };
  std::vector<std::vector<shape::Ring>> regions;
  for (const Region& each : scene.region) {
    auto& rings = regions.emplace_back();
    rings.push_back(ring_of(each.outline));
    for (const auto& hole : each.holes) rings.push_back(ring_of(hole));
  }
  std::vector<int> region(mesh.elements.size(), -1);
  for (std::size_t e = 0; e < mesh.elements.size(); ++e) {
    if (mesh.dimension_of(mesh.elements[e]) != 2) continue;
    const shape::Point middle = middle_of(mesh, mesh.elements[e].nodes).head<2>();
    const auto holds = [&](const auto& rings) { return shape::is_inside(rings, middle); };
    const auto found = std::ranges::find_if(regions, holds);
    if (found != regions.end()) region[e] = static_cast<int>(found - regions.begin());
  }
  return region;
}

double polygon_area(const Region& region) {
  const auto area = [](const std::vector<PlanePoint>& corners) {
    shape::Ring ring;
    for (const PlanePoint& corner : corners) ring.emplace_back(corner.x(), corner.y());
    return std::abs(shape::signed_area(ring));
  };
  double left = area(region.outline);
  for (const auto& hole : region.holes) left -= area(hole);
  return left;
}

void check_filled(const Scene& scene, const ElementBody& body, tables::Diagnosis& diagnosis) {
  std::vector<double> volume(scene.region.size(), 0.0);
  for (const shape::MeshPart& part : body.joined.parts) {
    const auto& element = body.mesh.elements[static_cast<std::size_t>(part.element)];
    volume[static_cast<std::size_t>(part.region)] += shape::content_of(body.mesh, element).volume;
  }
  for (std::size_t r = 0; r < scene.region.size() && body.mesh.dimension == 2; ++r) {
    const double area = polygon_area(scene.region[r]);
    if (std::abs(volume[r] - area) <= same * area) continue;
    diagnosis.error(fmt::format("region.{}", r),
                    fmt::format("\"{}\" has an area of {:.9g}, of which elements fill {:.9g}",
                                name_of_region(scene, r), area, volume[r]),
                    "where particles are elements, regions are groups of the mesh");
  }
}

std::vector<int> sorted(std::vector<int> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

// The sides of a solid's surface, by the faces of their groups.
void find_solid_sides(const Scene& scene, ElementBody& body, tables::Diagnosis& diagnosis) {
  std::map<std::vector<int>, std::size_t> surface;
  for (std::size_t f = 0; f < body.joined.facets.size(); ++f) {
    if (body.joined.facets[f].beyond < 0) surface.emplace(sorted(body.joined.facets[f].nodes), f);
  }
  for (std::size_t s = 0; s < scene.side.size(); ++s) {
    const std::string key = fmt::format("side.{}.group", s);
    const auto group = shape::find_group(body.mesh, 2, scene.side[s].group);
    for (const auto& face : body.mesh.elements) {
      if (!group || face.group != *group) continue;
      const auto found = surface.find(sorted(face.nodes));
      const std::string at = text_of(body.mesh, middle_of(body.mesh, face.nodes));
      if (found == surface.end()) {
        diagnosis.error(key, fmt::format("its face at {} is not on the surface of the regions", at),
                        "sides are parts of the surface of all regions together");
        break;
      }
      int& side = body.side[found->second];
      if (side >= 0 && side != static_cast<int>(s)) {
        diagnosis.error(key,
                        fmt::format("its face at {} is named by side \"{}\" as well", at,
                                    scene.side[static_cast<std::size_t>(side)].name),
                        "a part of the surface belongs to one side");
        break;
      }
      side = static_cast<int>(s);
    }
  }
}

void find_plane_sides(const Scene& scene, ElementBody& body) {
  const shape::Outline outline = outline_of(scene);
  for (std::size_t f = 0; f < body.joined.facets.size(); ++f) {
    const shape::MeshFacet& facet = body.joined.facets[f];
    if (facet.beyond >= 0) continue;
    const shape::Point middle = middle_of(body.mesh, facet.nodes).head<2>();
    for (const shape::OutlineSegment& segment : outline.segments) {
      if (segment.right >= 0) continue;
      const double away =
          shape::distance(middle, outline.at(segment.first), outline.at(segment.second));
      if (away <= outline.tolerance()) body.side[f] = segment.side;
    }
  }
}

void check_sides(const ElementBody& body, tables::Diagnosis& diagnosis) {
  for (std::size_t f = 0; f < body.joined.facets.size(); ++f) {
    const shape::MeshFacet& facet = body.joined.facets[f];
    if (facet.beyond >= 0 || body.side[f] >= 0) continue;
    diagnosis.error("side",
                    fmt::format("the surface at {} is of no side",
                                text_of(body.mesh, middle_of(body.mesh, facet.nodes))),
                    "every part of the surface belongs to one; elements that meet share all "
                    "corners of their common face");
    return;
  }
}

}  // namespace

bool has_elements(const Scene& scene) {
  return !scene.region.empty() && scene.mesh.particles == MeshParticles::elements;
}

bool is_solid(const Scene& scene) {
  return has_elements(scene) && scene.geometry.dimension == 3;
}

bool is_extruded(const Scene& scene) {
  return !scene.region.empty() && scene.geometry.dimension == 3 && !has_elements(scene);
}

bool is_face_by_itself(const Scene& scene, Side side) {
  return scene.region.empty() || (is_extruded(scene) && axis_of(side) == 2);
}

std::optional<ElementBody> read_elements(const Scene& scene, tables::Diagnosis& diagnosis) {
  ElementBody body;
  try {
    body.mesh = shape::read_gmsh(scene.mesh.text, scene.mesh.unit);
    body.joined = shape::join_elements(
        body.mesh, body.mesh.dimension == 3 ? regions_by_group(scene, body.mesh, diagnosis)
                                            : regions_by_outline(scene, body.mesh));
  } catch (const shape::GmshError& failure) {
    diagnosis.error("mesh", failure.what(), "elements that are particles fill regions once");
    return std::nullopt;
  }
  body.side.assign(body.joined.facets.size(), -1);
  check_filled(scene, body, diagnosis);
  if (body.mesh.dimension == 3) {
    find_solid_sides(scene, body, diagnosis);
  } else {
    find_plane_sides(scene, body);
  }
  if (diagnosis.errors().empty()) check_sides(body, diagnosis);
  if (!diagnosis.errors().empty()) return std::nullopt;
  return body;
}

ElementBody elements_of(const Scene& scene) {
  tables::Diagnosis ignored("");
  return *read_elements(scene, ignored);
}

std::optional<Side> face_of(const Scene& scene, const shape::GmshMesh& mesh,
                            const std::vector<int>& facet) {
  const Geometry& geometry = scene.geometry;
  for (int f = 0; f < 2 * geometry.dimension; ++f) {
    const auto face = static_cast<Side>(f);
    const int axis = axis_of(face);
    const auto i = static_cast<std::size_t>(axis);
    const double slack = same * (geometry.max[i] - geometry.min[i]);
    const bool is_on = std::ranges::all_of(facet, [&](int node) {
      return std::abs(mesh.at(node)[axis] - side_position(geometry, face)) <= slack;
    });
    if (is_on) return face;
  }
  return std::nullopt;
}

}  // namespace scene
