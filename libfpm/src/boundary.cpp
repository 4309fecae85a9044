#include "fpm/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "places.hpp"

namespace fpm {
namespace {

// Pieces of one axis of a face: their centres and widths.
struct Pieces {
  std::vector<double> centre;
  std::vector<double> width;
};

// Differences of coordinates are those of the lattice but for the round-off of the coordinates:
// what lies a sliver from one of its lines is on it.
constexpr double sliver = 1e-9;

// A distance from the box's corner, on the line of `step` that it is meant to be on, if it is.
double on_line(double distance, double step, double round_off) {
  const double line = std::round(distance / step) * step;
  return std::abs(distance - line) <= sliver * step + round_off ? line : distance;
}

// The part of an axis, measured from the box's corner: [0, extent] clipped to the range.
struct Span {
  double low, high;
};

Span clipped(double min, double max, double range_min, double range_max, double step) {
  const double round_off =
      4.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(min), std::abs(max));
  return {on_line(std::max(0.0, range_min - min), step, round_off),
          on_line(std::min(max, range_max) - min, step, round_off)};
}

// [low, high] cut at the lines i step; a sliver of round-off width is no piece.
Pieces cut(const Span& span, double step) {
  Pieces pieces;
  double from = span.low;
  auto line = static_cast<long>(std::floor(span.low / step));
  while (from < span.high) {
    double to = static_cast<double>(++line) * step;
    if (to <= from + sliver * step) continue;
    if (to >= span.high - sliver * step) to = span.high;
    pieces.centre.push_back(0.5 * (from + to));
    pieces.width.push_back(to - from);
    from = to;
  }
  return pieces;
}

void refuse(const std::vector<std::string>& messages) {
  if (messages.empty()) return;
  std::string all;
  for (const std::string& message : messages) all += (all.empty() ? "" : "; ") + message;
  throw std::invalid_argument(all);
}

void check_axis(int axis, int dimension) {
  if (axis < 0 || axis >= dimension) {
    throw std::invalid_argument("face: axis " + std::to_string(axis) + " in a space of dimension " +
                                std::to_string(dimension));
  }
}

template <int Dim>
void check_vertex_lattice(const LatticeOptions<Dim>& lattice) {
  if (lattice.layout != LatticeLayout::vertex || lattice.jitter != 0.0) {
    throw std::invalid_argument(
        "tributary areas belong to vertex lattices without jitter; other sets use boundary points");
  }
}

}  // namespace

template <int Dim>
std::vector<Face> all_faces() {
  std::vector<Face> faces;
  for (int axis = 0; axis < Dim; ++axis) {
    faces.push_back({axis, false});
    faces.push_back({axis, true});
  }
  return faces;
}

template <int Dim>
void BoundaryPoints<Dim>::append(const BoundaryPoints& other) {
  const Eigen::Index old = weight.size();
  const Eigen::Index total = old + other.weight.size();
  position.conservativeResize(total, Dim);
  normal.conservativeResize(total, Dim);
  weight.conservativeResize(total);
  position.bottomRows(total - old) = other.position;
  normal.bottomRows(total - old) = other.normal;
  weight.tail(total - old) = other.weight;
}

template <int Dim>
std::vector<std::string> validate(const BoundaryQuadratureOptions<Dim>& options) {
  std::vector<std::string> messages;
  const auto& face = options.face;
  if (face.axis < 0 || face.axis >= Dim) {
    messages.push_back("face: axis " + std::to_string(face.axis) + " in a space of dimension " +
                       std::to_string(Dim));
  }
  if (!(options.spacing > 0.0)) messages.push_back("boundary spacing must be positive");
  if (options.points_per_spacing < 1) {
    messages.push_back("points per spacing must be at least 1, not " +
                       std::to_string(options.points_per_spacing));
  }
  for (int i = 0; i < Dim; ++i) {
    const std::string axis = " along axis " + std::to_string(i);
    if (!(options.max[i] > options.min[i])) {
      messages.push_back("the box is empty" + axis);
    } else if (i != face.axis && !(std::min(options.max[i], options.range_max[i]) >
                                   std::max(options.min[i], options.range_min[i]))) {
      messages.push_back("the range misses the face" + axis);
    }
  }
  return messages;
}

template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(const BoundaryQuadratureOptions<Dim>& options) {
  refuse(validate(options));
  const auto [axis, upper] = options.face;
  const double step = options.spacing / options.points_per_spacing;
  Pieces pieces[Dim];
  Eigen::Matrix<Index, Dim, 1> count;
  for (int i = 0; i < Dim; ++i) {
    if (i == axis) {
      pieces[i] = {{0.0}, {1.0}};
    } else {
      pieces[i] = cut(
          clipped(options.min[i], options.max[i], options.range_min[i], options.range_max[i], step),
          step);
    }
    count[i] = static_cast<Index>(pieces[i].centre.size());
  }

  BoundaryPoints<Dim> points;
  points.position.resize(count.prod(), Dim);
  points.normal.setZero(count.prod(), Dim);
  points.normal.col(axis).setConstant(upper ? 1.0 : -1.0);
  points.weight.setOnes(count.prod());
  Vector<Dim> corner = options.min;
  if (upper) corner[axis] = options.max[axis];
  Eigen::Index c = 0;
  detail::for_each_place<Dim>(count, [&](const auto& at) {
    for (int i = 0; i < Dim; ++i) {
      const auto k = static_cast<std::size_t>(at[i]);
      points.position(c, i) = corner[i] + pieces[i].centre[k];
      points.weight[c] *= pieces[i].width[k];
    }
    ++c;
  });
  return points;
}

template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(BoundaryQuadratureOptions<Dim> options,
                                        const std::vector<Face>& faces) {
  BoundaryPoints<Dim> points;
  for (const Face& face : faces) {
    options.face = face;
    points.append(boundary_quadrature(options));
  }
  return points;
}

template <int Dim>
BoundaryPoints<Dim> boundary_quadrature(const Cells<Dim>& cells, const Face& face,
                                        const Vector<Dim>& range_min,
                                        const Vector<Dim>& range_max) {
  BoundaryQuadratureOptions<Dim> options;
  options.min = cells.lattice().min;
  options.max = cells.lattice().max;
  options.spacing = cells.lattice().spacing;
  options.face = face;
  options.range_min = range_min;
  options.range_max = range_max;
  if (!cells.graded()) return boundary_quadrature(options);
  refuse(validate(options));
  std::vector<BoundaryPoints<Dim>> pieces;
  Eigen::Index count = 0;
  for (Index a = 0; a < cells.size(); ++a) {
    if (cells.beside(a, face.axis, face.upper) >= 0) continue;
    options.min = cells.lower(a);
    options.max = cells.upper(a);
    options.spacing = cells.width(a);
    if (!validate(options).empty()) continue;  // beside the range
    pieces.push_back(boundary_quadrature(options));
    count += pieces.back().size();
  }
  BoundaryPoints<Dim> points;
  points.position.resize(count, Dim);
  points.normal.resize(count, Dim);
  points.weight.resize(count);
  Eigen::Index at = 0;
  for (const BoundaryPoints<Dim>& piece : pieces) {
    points.position.middleRows(at, piece.size()) = piece.position;
    points.normal.middleRows(at, piece.size()) = piece.normal;
    points.weight.segment(at, piece.size()) = piece.weight;
    at += piece.size();
  }
  return points;
}

template <int Dim>
TributaryPoints<Dim> tributary_points(const LatticeOptions<Dim>& lattice, Face face,
                                      const Vector<Dim>& range_min, const Vector<Dim>& range_max) {
  check_axis(face.axis, Dim);
  check_vertex_lattice(lattice);
  const Eigen::Matrix<Index, Dim, 1> count = lattice_cells(lattice).array() + 1;
  const double half = 0.5 * lattice.spacing;
  Span span[Dim];
  for (int i = 0; i < Dim; ++i) {
    span[i] = clipped(lattice.min[i], lattice.max[i], range_min[i], range_max[i], half);
  }
  const auto length = [&](int axis, Index at) {
    if (axis == face.axis) return at == (face.upper ? count[axis] - 1 : 0) ? 1.0 : 0.0;
    const double x = at * lattice.spacing;
    return std::max(0.0, std::min(x + half, span[axis].high) - std::max(x - half, span[axis].low));
  };

  std::vector<double> area;
  TributaryPoints<Dim> result;
  Index particle = 0;
  detail::for_each_place<Dim>(count, [&](const auto& at) {
    double product = 1.0;
    for (int i = 0; i < Dim; ++i) product *= length(i, at[i]);
    if (product > 0.0) {
      result.particle.push_back(particle);
      area.push_back(product);
    }
    ++particle;
  });
  if (area.empty()) throw std::invalid_argument("the range misses the face");

  const ParticleSet<Dim> set = make_lattice(lattice);
  const auto m = static_cast<Eigen::Index>(area.size());
  result.points.weight = Eigen::Map<const Eigen::VectorXd>(area.data(), m);
  result.points.normal.setZero(m, Dim);
  result.points.normal.col(face.axis).setConstant(face.upper ? 1.0 : -1.0);
  result.points.position.resize(m, Dim);
  for (Eigen::Index c = 0; c < m; ++c) {
    result.points.position.row(c) = set.position.row(result.particle[static_cast<std::size_t>(c)]);
  }
  return result;
}

template <int Dim>
Field<Dim> tributary_area_vectors(const LatticeOptions<Dim>& lattice,
                                  const std::vector<Face>& faces) {
  check_vertex_lattice(lattice);
  const Eigen::Matrix<Index, Dim, 1> count = lattice_cells(lattice).array() + 1;
  Field<Dim> area = Field<Dim>::Zero(count.prod(), Dim);
  for (const Face& face : faces) {
    const TributaryPoints<Dim> on_face = tributary_points(lattice, face);
    for (Index c = 0; c < on_face.points.size(); ++c) {
      area.row(on_face.particle[static_cast<std::size_t>(c)]) +=
          on_face.points.weight[c] * on_face.points.normal.row(c);
    }
  }
  return area;
}

template <int Dim>
Field<Dim> area_vectors(const PointOperator<Dim>& points, const BoundaryPoints<Dim>& boundary) {
  Field<Dim> area = Field<Dim>::Zero(points.particle_count(), Dim);
  const Field<Dim> piece = boundary.weight.asDiagonal() * boundary.normal;
  points.add_transposed_values(piece, area);
  return area;
}

#define FPM_INSTANTIATE(Dim)                                                                     \
  template std::vector<Face> all_faces<Dim>();                                                   \
  template struct BoundaryPoints<Dim>;                                                           \
  template std::vector<std::string> validate<Dim>(const BoundaryQuadratureOptions<Dim>&);        \
  template BoundaryPoints<Dim> boundary_quadrature<Dim>(const BoundaryQuadratureOptions<Dim>&);  \
  template BoundaryPoints<Dim> boundary_quadrature<Dim>(BoundaryQuadratureOptions<Dim>,          \
                                                        const std::vector<Face>&);               \
  template BoundaryPoints<Dim> boundary_quadrature<Dim>(const Cells<Dim>&, const Face&,          \
                                                        const Vector<Dim>&, const Vector<Dim>&); \
  template TributaryPoints<Dim> tributary_points<Dim>(const LatticeOptions<Dim>&, Face,          \
                                                      const Vector<Dim>&, const Vector<Dim>&);   \
  template Field<Dim> tributary_area_vectors<Dim>(const LatticeOptions<Dim>&,                    \
                                                  const std::vector<Face>&);                     \
  template Field<Dim> area_vectors<Dim>(const PointOperator<Dim>&, const BoundaryPoints<Dim>&);
FPM_INSTANTIATE(2)
FPM_INSTANTIATE(3)
#undef FPM_INSTANTIATE

}  // namespace fpm
