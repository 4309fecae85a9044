#include "fpm/bodies.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fpm {
namespace {

template <int Dim>
using Counts = Eigen::Matrix<Index, Dim, 1>;

// The cells around the particles of a lattice, in the particles' order.
template <int Dim>
class Cells {
 public:
  explicit Cells(const LatticeOptions<Dim>& lattice) : lattice_(lattice) {
    count_ = lattice_cells(lattice);
    if (vertex()) count_.array() += 1;
    for (int i = 0, stride = 1; i < Dim; ++i) {
      stride_[i] = stride;
      stride *= count_[i];
    }
  }

  Index size() const { return count_.prod(); }
  Index count(int axis) const { return count_[axis]; }
  Index stride(int axis) const { return stride_[axis]; }
  Index at(Index cell, int axis) const { return cell / stride_[axis] % count_[axis]; }

  double lower(Index cell, int axis) const {
    const double steps = at(cell, axis) - (vertex() ? 0.5 : 0.0);
    return std::max(lattice_.min[axis], lattice_.min[axis] + steps * lattice_.spacing);
  }
  double upper(Index cell, int axis) const {
    const double steps = at(cell, axis) + (vertex() ? 0.5 : 1.0);
    return std::min(lattice_.max[axis], lattice_.min[axis] + steps * lattice_.spacing);
  }

  Index containing(const Vector<Dim>& point) const {
    Index cell = 0;
    for (int i = 0; i < Dim; ++i) {
      const double steps = (point[i] - lattice_.min[i]) / lattice_.spacing + (vertex() ? 0.5 : 0.0);
      cell += stride_[i] * std::clamp(static_cast<Index>(std::floor(steps)), 0, count_[i] - 1);
    }
    return cell;
  }

  // Adds the lower or upper face of a cell.
  void append_face(Index cell, const Face& face, CommonFaces<Dim>& faces) const {
    const Eigen::Index c = faces.points.weight.size();
    faces.points.position.conservativeResize(c + 1, Dim);
    faces.points.normal.conservativeResize(c + 1, Dim);
    faces.points.weight.conservativeResize(c + 1);
    double area = 1.0;
    for (int i = 0; i < Dim; ++i) {
      const double from = lower(cell, i), to = upper(cell, i);
      faces.points.position(c, i) = i != face.axis ? 0.5 * (from + to) : face.upper ? to : from;
      if (i != face.axis) area *= to - from;
    }
    faces.points.normal.row(c).setZero();
    faces.points.normal(c, face.axis) = face.upper ? 1.0 : -1.0;
    faces.points.weight[c] = area;
    faces.first.push_back(cell);
  }

 private:
  bool vertex() const { return lattice_.layout == LatticeLayout::vertex; }

  LatticeOptions<Dim> lattice_;
  Counts<Dim> count_;
  Counts<Dim> stride_;
};

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

// Calls visit(a, b, axis) for cells that share a face, a being the lower one.
template <int Dim, class Visitor>
void for_each_pair(const Cells<Dim>& cells, Visitor&& visit) {
  for (Index a = 0; a < cells.size(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      if (cells.at(a, i) + 1 < cells.count(i)) visit(a, a + cells.stride(i), i);
    }
  }
}

// Cells of bodies that are thinner than `thickness` where the cell is, across the face to another.
template <int Dim>
std::vector<char> thin_cells(const Cells<Dim>& cells, Union& bodies, Index thickness) {
  std::vector<char> thin(static_cast<std::size_t>(cells.size()), 0);
  for (Index a = 0; a < cells.size(); ++a) {
    for (int i = 0; i < Dim; ++i) {
      Index along = 1;
      for (const int step : {-1, 1}) {
        Index at = cells.at(a, i) + step, b = a + step * cells.stride(i);
        while (at >= 0 && at < cells.count(i) && bodies.find(b) == bodies.find(a)) {
          ++along;
          at += step;
          b += step * cells.stride(i);
        }
      }
      if (along < std::min(thickness, cells.count(i))) thin[static_cast<std::size_t>(a)] = 1;
    }
  }
  return thin;
}

}  // namespace

template <int Dim>
std::vector<Index> lattice_bodies(const LatticeOptions<Dim>& lattice,
                                  const std::vector<Index>& label,
                                  const std::function<bool(Index, Index)>& joined,
                                  Index thickness) {
  const Cells<Dim> cells(lattice);
  require_size("labels", static_cast<Eigen::Index>(label.size()), cells.size());
  Union bodies(cells.size());
  for_each_pair(cells, [&](Index a, Index b, int /*axis*/) {
    const auto [low, high] =
        std::minmax(label[static_cast<std::size_t>(a)], label[static_cast<std::size_t>(b)]);
    if (low == high || joined(low, high)) bodies.unite(a, b);
  });
  const std::vector<char> thin = thin_cells(cells, bodies, thickness);
  for_each_pair(cells, [&](Index a, Index b, int /*axis*/) {
    if (thin[static_cast<std::size_t>(a)] != 0 || thin[static_cast<std::size_t>(b)] != 0) {
      bodies.unite(a, b);
    }
  });
  std::vector<Index> number(static_cast<std::size_t>(cells.size()), -1), body;
  Index next = 0;
  for (Index a = 0; a < cells.size(); ++a) {
    Index& own = number[static_cast<std::size_t>(bodies.find(a))];
    if (own < 0) own = next++;
    body.push_back(own);
  }
  return body;
}

template <int Dim>
CommonFaces<Dim> common_faces(const LatticeOptions<Dim>& lattice, const std::vector<Index>& body) {
  const Cells<Dim> cells(lattice);
  require_size("bodies", static_cast<Eigen::Index>(body.size()), cells.size());
  CommonFaces<Dim> faces;
  for_each_pair(cells, [&](Index a, Index b, int axis) {
    if (body[static_cast<std::size_t>(a)] == body[static_cast<std::size_t>(b)]) return;
    cells.append_face(a, {axis, true}, faces);
    faces.second.push_back(b);
  });
  return faces;
}

template <int Dim>
CommonFaces<Dim> outer_faces(const LatticeOptions<Dim>& lattice, const Face& face) {
  const Cells<Dim> cells(lattice);
  CommonFaces<Dim> faces;
  const Index outermost = face.upper ? cells.count(face.axis) - 1 : 0;
  for (Index a = 0; a < cells.size(); ++a) {
    if (cells.at(a, face.axis) == outermost) cells.append_face(a, face, faces);
  }
  return faces;
}

template <int Dim>
Index cell_at(const LatticeOptions<Dim>& lattice, const Vector<Dim>& point) {
  return Cells<Dim>(lattice).containing(point);
}

#define FPM_INSTANTIATE(Dim)                                                           \
  template std::vector<Index> lattice_bodies<Dim>(                                     \
      const LatticeOptions<Dim>&, const std::vector<Index>&,                           \
      const std::function<bool(Index, Index)>&, Index);                                \
  template CommonFaces<Dim> common_faces<Dim>(const LatticeOptions<Dim>&,              \
                                              const std::vector<Index>&);              \
  template CommonFaces<Dim> outer_faces<Dim>(const LatticeOptions<Dim>&, const Face&); \
  template Index cell_at<Dim>(const LatticeOptions<Dim>&, const Vector<Dim>&);
FPM_INSTANTIATE(2)
FPM_INSTANTIATE(3)
#undef FPM_INSTANTIATE

}  // namespace fpm
