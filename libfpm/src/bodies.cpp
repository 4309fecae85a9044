#include "fpm/bodies.hpp"

#include <algorithm>
#include <numeric>

namespace fpm {
namespace {

// Adds a face of a cell.
template <int Dim>
void append_face(const Cells<Dim>& cells, Index cell, const Face& face, CommonFaces<Dim>& faces) {
  const Eigen::Index c = faces.points.weight.size();
  faces.points.position.conservativeResize(c + 1, Dim);
  faces.points.normal.conservativeResize(c + 1, Dim);
  faces.points.weight.conservativeResize(c + 1);
  const Vector<Dim> lower = cells.lower(cell), upper = cells.upper(cell);
  Vector<Dim> place = 0.5 * (lower + upper);
  place[face.axis] = face.upper ? upper[face.axis] : lower[face.axis];
  double area = 1.0;
  for (int i = 0; i < Dim; ++i) {
    if (i != face.axis) area *= upper[i] - lower[i];
  }
  faces.points.position.row(c) = place.transpose();
  faces.points.normal.row(c).setZero();
  faces.points.normal(c, face.axis) = face.upper ? 1.0 : -1.0;
  faces.points.weight[c] = area;
}

// Sets that can be united; the smallest member stands for each.
class Union {
 public:
  explicit Union(Index size) : parent_(static_cast<std::size_t>(size)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index find(Index a) {
    while (parent(a) != a) a = parent(a) = parent(parent(a));
    return a;
  }
  void unite(Index a, Index b) {
    a = find(a);
    b = find(b);
    parent(std::max(a, b)) = std::min(a, b);
  }

 private:
  Index& parent(Index a) { return parent_[static_cast<std::size_t>(a)]; }
  std::vector<Index> parent_;
};

// Cells of bodies that are thinner than `thickness` where the cell is, across the face to another.
// @param same  whether two cells are of one body
template <int Dim, class Same>
std::vector<char> thin_cells(const Cells<Dim>& cells, const Same& same, Index thickness) {
  std::vector<char> thin(static_cast<std::size_t>(cells.size()), 0);
  for (Index a = 0; a < cells.size(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      Index along = 1;
      bool ends = false;  // at another body
      for (const bool upper : {false, true}) {
        Index b = cells.beside(a, i, upper);
        while (along < thickness && b >= 0 && same(a, b)) {
          ++along;
          b = cells.beside(b, i, upper);
        }
        ends = ends || b >= 0;
      }
      if (ends && along < thickness) thin[static_cast<std::size_t>(a)] = 1;
    }
  }
  return thin;
}

// Of each cell, whether any cell of its body is not thin.
std::vector<char> of_any_thick(Union& bodies, const std::vector<char>& thin) {
  std::vector<char> body(thin.size(), 0), result;
  const auto root = [&](std::size_t a) {
    return static_cast<std::size_t>(bodies.find(static_cast<Index>(a)));
  };
  for (std::size_t a = 0; a < thin.size(); ++a) {
    if (thin[a] == 0) body[root(a)] = 1;
  }
  for (std::size_t a = 0; a < thin.size(); ++a) result.push_back(body[root(a)]);
  return result;
}

// Numbers of the sets, by first appearance.
std::vector<Index> numbers(Union& bodies, Index size) {
  std::vector<Index> number(static_cast<std::size_t>(size), -1), body;
  Index next = 0;
  for (Index a = 0; a < size; ++a) {
    Index& own = number[static_cast<std::size_t>(bodies.find(a))];
    if (own < 0) own = next++;
    body.push_back(own);
  }
  return body;
}

}  // namespace

std::vector<Index> bodies_of(const std::vector<Index>& label,
                             const std::vector<std::pair<Index, Index>>& meeting,
                             const std::function<bool(Index, Index)>& joined) {
  const auto size = static_cast<Index>(label.size());
  Union bodies(size);
  for (const auto& [a, b] : meeting) {
    if (std::min(a, b) < 0 || std::max(a, b) >= size) {
      throw ShapeError("a particle that meets another is none of the set");
    }
    const auto [low, high] =
        std::minmax(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
    if (low == high || joined(low, high)) bodies.unite(a, b);
  }
  return numbers(bodies, size);
}

template <int Dim>
std::vector<Index> bodies_of(const Cells<Dim>& cells, const std::vector<Index>& label,
                             const std::function<bool(Index, Index)>& joined, Index thickness,
                             const std::vector<std::pair<Index, Index>>& meeting) {
  require_size("labels", static_cast<Eigen::Index>(label.size()), cells.size());
  Union bodies(cells.size());
  const auto unite = [&](Index a, Index b) {
    const auto [low, high] =
        std::minmax(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
    if (low == high || joined(low, high)) bodies.unite(a, b);
  };
  cells.for_each_pair([&](Index a, Index b, int /*axis*/) { unite(a, b); });
  for (const auto& [a, b] : meeting) unite(a, b);
  const auto same = [&](Index a, Index b) { return bodies.find(a) == bodies.find(b); };
  const std::vector<char> thick = of_any_thick(bodies, thin_cells(cells, same, thickness));
  cells.for_each_pair([&](Index a, Index b, int /*axis*/) {
    if (thick[static_cast<std::size_t>(a)] == 0 || thick[static_cast<std::size_t>(b)] == 0) {
      bodies.unite(a, b);
    }
  });
  return numbers(bodies, cells.size());
}

template <int Dim>
std::vector<bool> thin_bodies(const Cells<Dim>& cells, const std::vector<Index>& body,
                              Index thickness) {
  require_size("bodies", static_cast<Eigen::Index>(body.size()), cells.size());
  const auto of = [&](Index a) {
    return static_cast<std::size_t>(body[static_cast<std::size_t>(a)]);
  };
  const auto same = [&](Index a, Index b) { return of(a) == of(b); };
  const std::vector<char> thin = thin_cells(cells, same, thickness);
  std::vector<bool> bodies;
  for (Index a = 0; a < cells.size(); ++a) {
    if (of(a) >= bodies.size()) bodies.resize(of(a) + 1, true);
    if (thin[static_cast<std::size_t>(a)] == 0) bodies[of(a)] = false;
  }
  return bodies;
}

template <int Dim>
CommonFaces<Dim> common_faces(const Cells<Dim>& cells, const std::vector<Index>& body) {
  require_size("bodies", static_cast<Eigen::Index>(body.size()), cells.size());
  CommonFaces<Dim> faces;
  cells.for_each_pair([&](Index a, Index b, int axis) {
    if (body[static_cast<std::size_t>(a)] == body[static_cast<std::size_t>(b)]) return;
    const bool below = cells.width(a) <= cells.width(b);
    append_face(cells, below ? a : b, {axis, below}, faces);
    faces.points.normal(faces.points.weight.size() - 1, axis) = 1.0;
    faces.first.push_back(a);
    faces.second.push_back(b);
  });
  return faces;
}

template <int Dim>
CommonFaces<Dim> outer_faces(const Cells<Dim>& cells, const Face& face) {
  CommonFaces<Dim> faces;
  for (Index a = 0; a < cells.size(); ++a) {
    if (cells.beside(a, face.axis, face.upper) >= 0) continue;
    append_face(cells, a, face, faces);
    faces.first.push_back(a);
  }
  return faces;
}

#define FPM_INSTANTIATE(Dim)                                                                  \
  template std::vector<Index> bodies_of<Dim>(const Cells<Dim>&, const std::vector<Index>&,    \
                                             const std::function<bool(Index, Index)>&, Index, \
                                             const std::vector<std::pair<Index, Index>>&);    \
  template std::vector<bool> thin_bodies<Dim>(const Cells<Dim>&, const std::vector<Index>&,   \
                                              Index);                                         \
  template CommonFaces<Dim> common_faces<Dim>(const Cells<Dim>&, const std::vector<Index>&);  \
  template CommonFaces<Dim> outer_faces<Dim>(const Cells<Dim>&, const Face&);
FPM_INSTANTIATE(2)
FPM_INSTANTIATE(3)
#undef FPM_INSTANTIATE

}  // namespace fpm
