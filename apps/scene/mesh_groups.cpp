#include "scene/mesh_groups.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "files/durable_file.hpp"
#include "tables/nearest_name.hpp"
#include "tables/table.hpp"

namespace scene {
namespace {

std::vector<std::string_view> names_of(const shape::GmshMesh& mesh, int dimension) {
  std::vector<std::string_view> names;
  for (const shape::GmshMesh::Group& group : mesh.groups) {
    if (group.dimension == dimension) names.push_back(group.name);
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::optional<shape::GmshMesh> read_mesh(const MeshFile& mesh, tables::Diagnosis& diagnosis) {
  const auto path = std::filesystem::path(diagnosis.source()).parent_path() / mesh.file;
  std::string text;
  try {
    text = files::read_text(path);
  } catch (const files::FileError& failure) {
    diagnosis.error("mesh.file", fmt::format("{}: {}", path.string(), failure.reason()),
                    "allowed is a mesh of Gmsh (.msh), its path from the scene's folder");
    return std::nullopt;
  }
  try {
    shape::GmshMesh found = shape::read_gmsh(text, mesh.unit);
    if (!found.groups.empty()) {
      for (std::size_t g = 0; g < found.groups.size(); ++g) {
        if (found.groups[g].dimension == 2) (void)shape::pieces_of(found, static_cast<int>(g));
      }
      return found;
    }
    diagnosis.error("mesh.file",
                    fmt::format("{} has no physical group with elements", path.string()),
                    "regions are physical surfaces, sides physical curves of Gmsh");
  } catch (const shape::GmshError& failure) {
    const std::string place = failure.line() > 0 ? fmt::format(":{}", failure.line()) : "";
    diagnosis.error(
        "mesh.file", fmt::format("{}{}: {}", path.string(), place, failure.what()),
        "allowed is a plane mesh of Gmsh, MSH 4.1 or 2.2 as text, of straight elements");
  }
  return std::nullopt;
}

std::optional<int> group_of(const shape::GmshMesh* mesh, int dimension, const std::string& table,
                            const std::string& shape_key, bool has_shape, const std::string& group,
                            tables::Diagnosis& diagnosis) {
  const std::string key = table + ".group", shape = table + "." + shape_key;
  if (!diagnosis.good({key, shape})) return std::nullopt;
  if (group.empty()) {
    if (!has_shape) {
      diagnosis.error(shape, "is missing",
                      "needed is a list of points [x, y] and arcs [m], or group");
    }
    return std::nullopt;
  }
  if (has_shape) {
    diagnosis.error(key, fmt::format("found \"{}\" beside {}", group, shape_key),
                    "give one of them");
    return std::nullopt;
  }
  if (mesh == nullptr) {
    diagnosis.error(key, fmt::format("found \"{}\" without a mesh", group),
                    "groups are those of [mesh] file");
    return std::nullopt;
  }
  const auto found = shape::find_group(*mesh, dimension, group);
  if (!found) {
    const auto names = names_of(*mesh, dimension);
    diagnosis.error(key, fmt::format("found \"{}\"", group),
                    fmt::format("the mesh's physical {} with elements are {}",
                                dimension == 2 ? "surfaces" : "curves",
                                names.empty() ? "none" : tables::joined(names)),
                    tables::nearest_name(group, names));
  }
  return found;
}

}  // namespace scene
