#include "shape/gmsh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <system_error>
#include <unordered_map>
#include <utility>

#include "shape/mesh_solids.hpp"
#include "shape/ring.hpp"

namespace shape {
namespace {

/// The words of a text, with the line each is on.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t line() const { return line_; }
  [[nodiscard]] std::size_t left() const { return text_.size() - at_; }

  /// The next word; empty at the end.
  std::string_view next() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// What is between the next two quotes.
  std::string_view quoted() {
    skip_space();
    if (at_ == text_.size() || text_[at_] != '"')
      throw GmshError(line_, "a name in quotes is missing");
    const std::size_t begin = ++at_;
    at_ = text_.find_first_of("\"\n", begin);
    if (at_ == std::string_view::npos || text_[at_] == '\n') {
      throw GmshError(line_, "a name in quotes does not end");
    }
    return text_.substr(begin, at_++ - begin);
  }

  template <class Number>
  Number number(const char* what) {
    const std::string_view word = next();
    Number value{};
    const auto [end, failure] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (failure != std::errc{} || end != word.data() + word.size() || word.empty()) {
      throw GmshError(line_, word.empty() ? fmt::format("the file ends where {} should be", what)
                                          : fmt::format("found {} where {} should be", word, what));
    }
    return value;
  }
  std::int64_t integer(const char* what) { return number<std::int64_t>(what); }
  double real(const char* what) {
    const double value = number<double>(what);
    if (!std::isfinite(value)) throw GmshError(line_, fmt::format("{} is not finite", what));
    return value;
  }
  /// How many of something follow: a word and a space each at least, so that a damaged count cannot
  /// ask for more memory than the file is long.
  std::size_t count(const char* what) {
    const std::int64_t value = integer(what);
    if (value < 0 || static_cast<std::uint64_t>(value) > left()) {
      throw GmshError(line_, fmt::format("found {} as {}, more than the file has", value, what));
    }
    return static_cast<std::size_t>(value);
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_space() {
    for (; at_ < text_.size() && is_space(text_[at_]); ++at_) line_ += text_[at_] == '\n' ? 1 : 0;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
};

// Elements by Gmsh's numbers: of straight edges, their dimension and nodes.
struct Kind {
  int dimension = 0;
  int nodes = 0;
};
std::optional<Kind> kind_of(std::int64_t type) {
  switch (type) {
    case 1:
      return Kind{1, 2};
    case 2:
      return Kind{2, 3};
    case 3:
      return Kind{2, 4};
    case 4:
      return Kind{3, 4};
    case 5:
      return Kind{3, 8};
    case 6:
      return Kind{3, 6};
    case 7:
      return Kind{3, 5};
    case 15:
      return Kind{0, 1};
    default:
      return std::nullopt;
  }
}

class Reader {
 public:
  Reader(std::string_view text, double unit) : words_(text), unit_(unit) {}

  GmshMesh mesh() {
    read_format();
    for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
      if (word == "$PhysicalNames") {
        read_names();
      } else if (word == "$Entities") {
        read_entities();
      } else if (word == "$Nodes") {
        is_old_ ? read_nodes_of_2() : read_nodes_of_4();
      } else if (word == "$Elements") {
        is_old_ ? read_elements_of_2() : read_elements_of_4();
      } else {
        pass_over(word);
        continue;
      }
      expect_end(word);
    }
    if (mesh_.nodes.empty()) throw GmshError(0, "it has no nodes");
    if (mesh_.dimension == 2) check_plane();
    for (const auto& [element, place] : places_) {
      GmshMesh::Element& checked = mesh_.elements[element];
      const int dimension = mesh_.dimension_of(checked);
      if (dimension == 3) check_solid(checked, place);
      if (dimension == 2 && mesh_.dimension == 2) check_face(checked, place);
    }
    return std::move(mesh_);
  }

 private:
  struct Place {
    std::size_t line = 0;
    std::int64_t number = 0;  // of the element in the file
  };

  void read_format() {
    if (words_.next() != "$MeshFormat") {
      throw GmshError(1, "it does not begin with $MeshFormat, as files of Gmsh do");
    }
    const std::string_view version = words_.next();
    is_old_ = version == "2.2";
    if (!is_old_ && version != "4.1") {
      throw GmshError(words_.line(),
                      fmt::format("found format {}: save it as MSH 4.1 or 2.2", version));
    }
    if (words_.integer("the kind of file") != 0) {
      throw GmshError(words_.line(), "it is binary: save it as text (Mesh.Binary = 0)");
    }
    (void)words_.next();
    expect_end("$MeshFormat");
  }

  // Sections end by $End and their name.
  static std::string end_of(std::string_view section) {
    return fmt::format("$End{}", section.substr(1));
  }
  void expect_end(std::string_view section) {
    const std::string_view word = words_.next();
    if (word == end_of(section)) return;
    throw GmshError(words_.line(), fmt::format("found {} where {} should be",
                                               word.empty() ? "the end" : word, end_of(section)));
  }
  void pass_over(std::string_view section) {
    const std::size_t line = words_.line();
    if (section.front() != '$')
      throw GmshError(line, fmt::format("found {} between sections", section));
    const std::string end = end_of(section);
    for (std::string_view word = words_.next(); word != end; word = words_.next()) {
      if (word.empty()) throw GmshError(line, fmt::format("{} is without its {}", section, end));
    }
  }

  void read_names() {
    const std::size_t count = words_.count("the number of physical groups");
    for (std::size_t i = 0; i < count; ++i) {
      const auto dimension = words_.integer("a dimension");
      const auto tag = words_.integer("a group's number");
      names_[{dimension, tag}] = words_.quoted();
    }
  }

  int group_of(std::int64_t dimension, std::int64_t tag) {
    const auto [at, is_new] =
        group_.emplace(std::pair(dimension, tag), static_cast<int>(mesh_.groups.size()));
    if (is_new) {
      const auto name = names_.find({dimension, tag});
      mesh_.groups.push_back({static_cast<int>(dimension), static_cast<int>(tag),
                              name == names_.end() ? fmt::format("{}", tag) : name->second});
    }
    return at->second;
  }

  // Of 4.1: the groups of each entity.
  void read_entities() {
    std::size_t counts[4];
    for (std::size_t& count : counts) count = words_.count("a number of entities");
    for (std::int64_t dimension = 0; dimension < 4; ++dimension) {
      for (std::size_t i = 0; i < counts[dimension]; ++i) {
        const auto tag = words_.integer("an entity's number");
        for (int k = 0; k < (dimension == 0 ? 3 : 6); ++k) (void)words_.real("a coordinate");
        const std::size_t groups = words_.count("a number of groups");
        for (std::size_t k = 0; k < groups; ++k) {
          groups_of_entity_[{dimension, tag}].push_back(words_.integer("a group's number"));
        }
        if (dimension == 0) continue;
        const std::size_t bounding = words_.count("a number of entities");
        for (std::size_t k = 0; k < bounding; ++k) (void)words_.integer("an entity's number");
      }
    }
  }

  void add_node(std::int64_t tag) {
    const double x = words_.real("a coordinate"), y = words_.real("a coordinate");
    const double z = words_.real("a coordinate");
    if (!node_.emplace(tag, static_cast<int>(mesh_.nodes.size())).second) {
      throw GmshError(words_.line(), fmt::format("node {} is there twice", tag));
    }
    mesh_.nodes.emplace_back(unit_ * x, unit_ * y, unit_ * z);
  }
  void read_nodes_of_2() {
    const std::size_t count = words_.count("the number of nodes");
    for (std::size_t i = 0; i < count; ++i) add_node(words_.integer("a node's number"));
  }
  void read_nodes_of_4() {
    const std::size_t blocks = words_.count("a number of blocks");
    for (int k = 0; k < 3; ++k) (void)words_.integer("a number of nodes");
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto dimension = words_.integer("a dimension");
      (void)words_.integer("an entity's number");
      const bool parametric = words_.integer("0 or 1") != 0;
      std::vector<std::int64_t> tags(words_.count("a number of nodes"));
      for (std::int64_t& tag : tags) tag = words_.integer("a node's number");
      for (const std::int64_t tag : tags) {
        add_node(tag);
        for (std::int64_t k = 0; parametric && k < dimension; ++k) (void)words_.real("a parameter");
      }
    }
  }

  // Reads the nodes of an element that is in these groups.
  void add_element(std::int64_t number, std::int64_t type,
                   const std::vector<std::int64_t>& groups) {
    const auto kind = kind_of(type);
    const std::size_t line = words_.line();
    if (!kind) {
      throw GmshError(
          line, fmt::format("element {} is of Gmsh's type {}: allowed are straight lines (1), "
                            "triangles (2), quadrilaterals (3), tetrahedra (4), hexahedra (5), "
                            "prisms (6) and pyramids (7)",
                            number, type));
    }
    GmshMesh::Element element;
    for (int k = 0; k < kind->nodes; ++k) {
      const auto node = words_.integer("a node's number");
      const auto found = node_.find(node);
      if (found == node_.end()) {
        throw GmshError(line, fmt::format("element {} has node {}, which is none", number, node));
      }
      element.nodes.push_back(found->second);
    }
    if (kind->dimension == 0) return;
    if (!groups.empty()) mesh_.dimension = std::max(mesh_.dimension, kind->dimension);
    for (const std::int64_t group : groups) {
      element.group = group_of(kind->dimension, group);
      places_.emplace_back(mesh_.elements.size(), Place{line, number});
      mesh_.elements.push_back(element);
    }
  }
  void read_elements_of_2() {
    const std::size_t count = words_.count("the number of elements");
    for (std::size_t i = 0; i < count; ++i) {
      const auto number = words_.integer("an element's number");
      const auto type = words_.integer("an element's type");
      std::vector<std::int64_t> groups;
      const std::size_t tags = words_.count("a number of tags");
      for (std::size_t k = 0; k < tags; ++k) {
        const auto tag = words_.integer("a tag");
        if (k == 0 && tag != 0) groups.push_back(tag);
      }
      add_element(number, type, groups);
    }
  }
  void read_elements_of_4() {
    const std::size_t blocks = words_.count("a number of blocks");
    for (int k = 0; k < 3; ++k) (void)words_.integer("a number of elements");
    for (std::size_t block = 0; block < blocks; ++block) {
      const auto dimension = words_.integer("a dimension");
      const auto entity = words_.integer("an entity's number");
      const auto type = words_.integer("an element's type");
      const std::size_t count = words_.count("a number of elements");
      // Turned around, a group's number is negative.
      std::vector<std::int64_t> groups;
      if (const auto at = groups_of_entity_.find({dimension, entity});
          at != groups_of_entity_.end()) {
        for (const std::int64_t group : at->second) groups.push_back(std::abs(group));
      }
      for (std::size_t i = 0; i < count; ++i) {
        add_element(words_.integer("an element's number"), type, groups);
      }
    }
  }

  void check_plane() const {
    SpacePoint low = mesh_.nodes.front(), high = low;
    for (const SpacePoint& node : mesh_.nodes) {
      low = low.cwiseMin(node);
      high = high.cwiseMax(node);
    }
    constexpr double flat = 1e-9;
    const double height = mesh_.nodes.front().z();
    for (const SpacePoint& node : mesh_.nodes) {
      if (std::abs(node.z() - height) <= flat * (high - low).head<2>().norm()) continue;
      throw GmshError(
          0, fmt::format("nodes are at z = {:g} and at z = {:g}: without solids in a physical "
                         "group a mesh is plane, z = const",
                         height, node.z()));
    }
  }

  // Turns a solid inside out if its volume is negative.
  void check_solid(GmshMesh::Element& solid, const Place& place) const {
    const SolidShape shape = turn_outward(mesh_, solid);
    if (shape == SolidShape::good) return;
    const SpacePoint& at = mesh_.at(solid.nodes.front());
    throw GmshError(place.line,
                    fmt::format("element {} at ({:g}, {:g}, {:g}) {}", place.number, at.x(), at.y(),
                                at.z(), shape == SolidShape::flat ? "has no volume" : "is folded"));
  }

  // Turns a face counterclockwise.
  void check_face(GmshMesh::Element& face, const Place& place) const {
    if (face.nodes.size() < 3) return;
    const auto at = [&](std::size_t k) {
      return mesh_.plane_at(face.nodes[k % face.nodes.size()]);
    };
    double least = 0.0, most = 0.0, size = 0.0;
    for (std::size_t k = 0; k < face.nodes.size(); ++k) {
      const Point in = at(k + 1) - at(k), out = at(k + 2) - at(k + 1);
      const double turn = cross(in, out);
      least = k == 0 ? turn : std::min(least, turn);
      most = k == 0 ? turn : std::max(most, turn);
      size = std::max(size, in.squaredNorm());
    }
    constexpr double nothing = 1e-12;
    if (std::max(std::abs(least), std::abs(most)) <= nothing * size) {
      throw GmshError(place.line, fmt::format("element {} at ({:g}, {:g}) has no area",
                                              place.number, at(0).x(), at(0).y()));
    }
    if (least * most <= 0.0) {
      throw GmshError(place.line, fmt::format("element {} at ({:g}, {:g}) is folded or not convex",
                                              place.number, at(0).x(), at(0).y()));
    }
    if (most < 0.0) std::reverse(face.nodes.begin(), face.nodes.end());
  }

  Words words_;
  double unit_;
  bool is_old_ = false;                                    // 2.2
  using Numbered = std::pair<std::int64_t, std::int64_t>;  // dimension, number
  std::map<Numbered, std::string> names_;
  std::map<Numbered, int> group_;
  std::map<Numbered, std::vector<std::int64_t>> groups_of_entity_;
  std::unordered_map<std::int64_t, int> node_;
  std::vector<std::pair<std::size_t, Place>> places_;
  GmshMesh mesh_;
};

}  // namespace

GmshMesh read_gmsh(std::string_view text, double unit) {
  return Reader(text, unit).mesh();
}

}  // namespace shape
