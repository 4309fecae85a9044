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

std::optional<shape::GmshMesh> read_mesh(MeshFile& mesh, tables::Diagnosis& diagnosis) {
  const bool is_inline = mesh.file.empty();
  const auto path = std::filesystem::path(diagnosis.source()).parent_path() / mesh.file;
  if (!is_inline && !mesh.text.empty()) {
    diagnosis.error("mesh.text", "found beside a file", "give one of them");
    return std::nullopt;
  }
  const std::string key = is_inline ? "mesh.text" : "mesh.file";
  const std::string source = is_inline ? "the text" : path.string();
  if (!is_inline) {
    try {
      mesh.text = files::read_text(path);
    } catch (const files::FileError& failure) {
      diagnosis.error(key, fmt::format("{}: {}", source, failure.reason()),
                      "allowed is a mesh of Gmsh (.msh), its path from the scene's folder");
      return std::nullopt;
    }
    mesh.file.clear();
  }
  try {
    shape::GmshMesh found = shape::read_gmsh(mesh.text, mesh.unit);
    if (!found.groups.empty()) {
      for (std::size_t g = 0; found.dimension == 2 && g < found.groups.size(); ++g) {
        if (found.groups[g].dimension == 2) (void)shape::pieces_of(found, static_cast<int>(g));
      }
      return found;
    }
    diagnosis.error(key, fmt::format("{} has no physical group with elements", source),
                    "regions are physical surfaces, sides physical curves of Gmsh; of a solid "
                    "volumes and surfaces");
  } catch (const shape::GmshError& failure) {
    const std::string place = failure.line() > 0 ? fmt::format(":{}", failure.line()) : "";
    diagnosis.error(key, fmt::format("{}{}: {}", source, place, failure.what()),
                    "allowed is a mesh of Gmsh, MSH 4.1 or 2.2 as text, of straight elements");
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
                                dimension == 3   ? "volumes"
                                : dimension == 2 ? "surfaces"
                                                 : "curves",
                                names.empty() ? "none" : tables::joined(names)),
                    tables::nearest_name(group, names));
  }
  return found;
}

}  // namespace scene
