#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace support {

/// A mesh of Gmsh (MSH 2.2) of a box, of one kind of element. Its regions are the physical groups
/// "low" and "high", below and above half of the layers; its sides "x0", "x1", "y0", "y1", "z0",
/// "z1".
struct BoxMesh {
  enum class Kind { triangles, quadrilaterals, tetrahedra, hexahedra, prisms };
  Kind kind = Kind::triangles;
  std::array<int, 3> cells{4, 4, 4};  // along x, y, z; z does not count in a plane
  std::array<double, 3> size{1.0, 1.0, 1.0};
  double jitter = 0.0;  // of the cells' widths, of nodes within
  // Where a place of the box is taken.
  std::function<std::array<double, 3>(std::array<double, 3>)> map = [](auto place) {
    return place;
  };

  [[nodiscard]] bool is_plane() const {
    return kind == Kind::triangles || kind == Kind::quadrilaterals;
  }
};

namespace detail {

class BoxMeshText {
 public:
  explicit BoxMeshText(const BoxMesh& mesh) : mesh_(mesh), n_(mesh.cells) {
    if (mesh.is_plane()) n_[2] = 0;
  }

  std::string text() {
    const int low = n_[1] / 2;
    for (int k = 0; k < std::max(1, n_[2]); ++k) {
      for (int j = 0; j < n_[1]; ++j) {
        for (int i = 0; i < n_[0]; ++i) add_cell(i, j, k, j < low ? 1 : 2);
      }
    }
    add_sides();
    std::string all = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n";
    const int d = mesh_.is_plane() ? 2 : 3;
    all += fmt::format("{}\n{} 1 \"low\"\n{} 2 \"high\"\n", 2 + 2 * d, d, d);
    constexpr std::array<const char*, 6> names{"x0", "x1", "y0", "y1", "z0", "z1"};
    for (int s = 0; s < 2 * d; ++s) {
      all += fmt::format("{} {} \"{}\"\n", d - 1, 11 + s, names[static_cast<std::size_t>(s)]);
    }
    all += fmt::format("$EndPhysicalNames\n$Nodes\n{}\n", (n_[0] + 1) * (n_[1] + 1) * (n_[2] + 1));
    for (int k = 0; k <= n_[2]; ++k) {
      for (int j = 0; j <= n_[1]; ++j) {
        for (int i = 0; i <= n_[0]; ++i) {
          const auto at = place({i, j, k});
          all += fmt::format("{} {} {} {}\n", node(i, j, k), at[0], at[1], at[2]);
        }
      }
    }
    return all + fmt::format("$EndNodes\n$Elements\n{}\n{}$EndElements\n", count_, elements_);
  }

 private:
  [[nodiscard]] int node(int i, int j, int k) const {
    return 1 + i + (n_[0] + 1) * (j + (n_[1] + 1) * k);
  }

  // A node within is moved by the same numbers wherever the mesh is made.
  std::array<double, 3> place(const std::array<int, 3>& index) const {
    std::array<double, 3> at{};
    bool within = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (n_[i] > 0) {
        at[i] = mesh_.size[i] * index[i] / n_[i];
        within = within && index[i] > 0 && index[i] < n_[i];
      }
    }
    std::uint64_t state = static_cast<std::uint64_t>(node(index[0], index[1], index[2]));
    for (std::size_t i = 0; i < 3; ++i) {
      for (int round = 0; round < 3; ++round) {
        state = state * 6364136223846793005U + 1442695040888963407U;
      }
      const double random = static_cast<double>(state >> 11U) / 9007199254740992.0;
      if (within && n_[i] > 0) {
        at[i] += mesh_.jitter * (2.0 * random - 1.0) * mesh_.size[i] / n_[i];
      }
    }
    return mesh_.map(at);
  }

  void add(int type, int group, const std::vector<int>& nodes) {
    elements_ += fmt::format("{} {} 2 {} {}", ++count_, type, group, group);
    for (const int k : nodes) elements_ += fmt::format(" {}", k);
    elements_ += '\n';
  }

  void add_cell(int i, int j, int k, int group) {
    const auto c = [&](int x, int y, int z) { return node(i + x, j + y, k + z); };
    using Kind = BoxMesh::Kind;
    switch (mesh_.kind) {
      case Kind::quadrilaterals:
        return add(3, group, {c(0, 0, 0), c(1, 0, 0), c(1, 1, 0), c(0, 1, 0)});
      case Kind::triangles:
        add(2, group, {c(0, 0, 0), c(1, 0, 0), c(1, 1, 0)});
        return add(2, group, {c(0, 0, 0), c(1, 1, 0), c(0, 1, 0)});
      case Kind::hexahedra:
        return add(5, group,
                   {c(0, 0, 0), c(1, 0, 0), c(1, 1, 0), c(0, 1, 0), c(0, 0, 1), c(1, 0, 1),
                    c(1, 1, 1), c(0, 1, 1)});
      case Kind::prisms:
        add(6, group, {c(0, 0, 0), c(1, 0, 0), c(1, 1, 0), c(0, 0, 1), c(1, 0, 1), c(1, 1, 1)});
        return add(6, group,
                   {c(0, 0, 0), c(1, 1, 0), c(0, 1, 0), c(0, 0, 1), c(1, 1, 1), c(0, 1, 1)});
      case Kind::tetrahedra:
        break;
    }
    // Kuhn's six, around the diagonal: every other is left-handed, which the reader turns.
    constexpr std::array<std::array<int, 3>, 6> ways{
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (const auto& way : ways) {
      std::array<int, 3> at{0, 0, 0};
      std::vector<int> nodes{c(0, 0, 0)};
      for (const int axis : way) {
        at[static_cast<std::size_t>(axis)] = 1;
        nodes.push_back(c(at[0], at[1], at[2]));
      }
      add(4, group, nodes);
    }
  }

  void add_sides() {
    for (int axis = 0; axis < (mesh_.is_plane() ? 2 : 3); ++axis) {
      for (const bool upper : {false, true}) add_side(axis, upper);
    }
  }

  void add_side(int axis, bool upper) {
    const int group = 11 + 2 * axis + (upper ? 1 : 0);
    const int one = axis == 0 ? 1 : 0, other = axis == 2 ? 1 : 2;
    const auto at = [&](int a, int b) {
      std::array<int, 3> index{};
      index[static_cast<std::size_t>(axis)] = upper ? n_[static_cast<std::size_t>(axis)] : 0;
      index[static_cast<std::size_t>(one)] = a;
      index[static_cast<std::size_t>(other)] = b;
      return node(index[0], index[1], index[2]);
    };
    for (int a = 0; a < n_[static_cast<std::size_t>(one)]; ++a) {
      if (mesh_.is_plane()) {
        add(1, group, {at(a, 0), at(a + 1, 0)});
        continue;
      }
      for (int b = 0; b < n_[static_cast<std::size_t>(other)]; ++b) {
        // The prisms' triangles are those across z.
        if (mesh_.kind == BoxMesh::Kind::tetrahedra ||
            (mesh_.kind == BoxMesh::Kind::prisms && axis == 2)) {
          add(2, group, {at(a, b), at(a + 1, b), at(a + 1, b + 1)});
          add(2, group, {at(a, b), at(a + 1, b + 1), at(a, b + 1)});
        } else {
          add(3, group, {at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)});
        }
      }
    }
  }

  const BoxMesh& mesh_;
  std::array<int, 3> n_;
  std::string elements_;
  int count_ = 0;
};

}  // namespace detail

inline std::string name_of(BoxMesh::Kind kind) {
  constexpr std::array<const char*, 5> names{"Triangles", "Quadrilaterals", "Tetrahedra",
                                             "Hexahedra", "Prisms"};
  return names.at(static_cast<std::size_t>(kind));
}

inline std::string text_of(const BoxMesh& mesh) {
  return detail::BoxMeshText(mesh).text();
}

}  // namespace support
