#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/mesh_file.hpp"
#include "shape/gmsh.hpp"
#include "shape/mesh_outline.hpp"
#include "tables/diagnosis.hpp"

namespace scene {

/// Reads a mesh, of its text or beside the scene, whose text it then has. What is wrong with it is
/// an error of the diagnosis.
[[nodiscard]] std::optional<shape::GmshMesh> read_mesh(MeshFile& mesh,
                                                       tables::Diagnosis& diagnosis);

/// The group of a dimension that a region or a side names, if it names one. An error of the
/// diagnosis if it names one that is not there or without elements, or has a shape besides, or
/// neither.
/// @param shape_key  of the table: what it has instead of a group
[[nodiscard]] std::optional<int> group_of(const shape::GmshMesh* mesh, int dimension,
                                          const std::string& table, const std::string& shape_key,
                                          bool has_shape, const std::string& group,
                                          tables::Diagnosis& diagnosis);

namespace detail {

template <class Points>
void assign(Points& points, const std::vector<shape::Point>& places) {
  points.clear();
  for (const shape::Point& place : places) points.emplace_back(place.x(), place.y());
}

/// An entry for another part of a group, by another name.
template <class Entry>
Entry& add_part(std::vector<Entry>& entries, std::size_t of, const std::string& group,
                std::size_t part) {
  Entry copy = entries[of];
  copy.name = fmt::format("{} ({})", copy.name.empty() ? group : copy.name, part + 1);
  return entries.emplace_back(std::move(copy));
}

}  // namespace detail

/// Regions and sides of a solid mesh keep their groups, which are all they have.
template <class Region, class Side>
void check_solid_groups(const shape::GmshMesh& mesh, const std::vector<Region>& regions,
                        const std::vector<Side>& sides, tables::Diagnosis& diagnosis) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    (void)group_of(&mesh, 3, fmt::format("region.{}", r), "outline", !regions[r].outline.empty(),
                   regions[r].group, diagnosis);
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    (void)group_of(&mesh, 2, fmt::format("side.{}", s), "along", !sides[s].along.empty(),
                   sides[s].group, diagnosis);
  }
}

/// Gives regions and sides that name groups of a plane mesh their polygons and polylines; one whose
/// group is in several parts becomes as many. Of the mesh only the text is left in the scene, and
/// that if particles are its elements.
/// @returns the mesh's dimension, 0 if there is none or it cannot be read
template <class Region, class Side>
int take_groups(MeshFile& file, std::vector<Region>& regions, std::vector<Side>& sides,
                tables::Diagnosis& diagnosis) {
  std::optional<shape::GmshMesh> mesh;
  const std::string name = file.file;
  if (is_given(file)) {
    mesh = read_mesh(file, diagnosis);
    if (!mesh) return 0;
  }
  const auto takes = [](const auto& entry) { return !entry.group.empty(); };
  if (!name.empty() && std::ranges::none_of(regions, takes) && std::ranges::none_of(sides, takes)) {
    diagnosis.error("mesh.file",
                    fmt::format("found {}, of which no region or side names a group", name),
                    "group of [[region]] and [[side]] is a physical surface and curve of it, of a "
                    "solid a volume and a surface");
  }
  if (file.particles == MeshParticles::cells) file = {};
  if (mesh && mesh->dimension == 3) {
    check_solid_groups(*mesh, regions, sides, diagnosis);
    return 3;
  }
  const shape::GmshMesh* const found = mesh ? &*mesh : nullptr;
  for (std::size_t r = 0, count = regions.size(); r < count; ++r) {
    const auto group = group_of(found, 2, fmt::format("region.{}", r), "outline",
                                !regions[r].outline.empty(), regions[r].group, diagnosis);
    if (!group) continue;
    const std::string name = std::exchange(regions[r].group, "");
    const std::vector<shape::Piece> pieces = shape::pieces_of(*mesh, *group);
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      Region& region = k == 0 ? regions[r] : detail::add_part(regions, r, name, k);
      detail::assign(region.outline, pieces[k].outline);
      region.holes.clear();
      for (const shape::Ring& hole : pieces[k].holes) {
        detail::assign(region.holes.emplace_back(), hole);
      }
    }
  }
  for (std::size_t s = 0, count = sides.size(); s < count; ++s) {
    const auto group = group_of(found, 1, fmt::format("side.{}", s), "along",
                                !sides[s].along.empty(), sides[s].group, diagnosis);
    if (!group) continue;
    const std::string name = std::exchange(sides[s].group, "");
    const auto lines = shape::polylines_of(*mesh, *group);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      detail::assign((k == 0 ? sides[s] : detail::add_part(sides, s, name, k)).along, lines[k]);
    }
  }
  return mesh ? 2 : 0;
}

}  // namespace scene
