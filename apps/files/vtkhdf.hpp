#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/hdf5_file.hpp"

namespace files {

/// One field at the particles as ParaView wants it: 1, 3 (vector) or 6 (symmetric tensor xx yy zz
/// xy yz zx) components, particle by particle.
struct PointField {
  std::string name;
  std::string unit;
  int components = 1;
  std::vector<double> values;  // components x particles
};

/// A scalar field from `at(particle)`.
template <class At>
PointField scalar_field(std::string name, std::string unit, std::size_t particles, At&& at) {
  PointField field{std::move(name), std::move(unit), 1, {}};
  field.values.reserve(particles);
  for (std::size_t i = 0; i < particles; ++i) field.values.push_back(static_cast<double>(at(i)));
  return field;
}

/// A vector field from `at(particle, component)` with `dimension` components; the rest is 0.
template <class At>
PointField vector_field(std::string name, std::string unit, std::size_t particles, int dimension,
                        At&& at) {
  PointField field{std::move(name), std::move(unit), 3, std::vector<double>(3 * particles, 0.0)};
  for (std::size_t i = 0; i < particles; ++i) {
    for (int c = 0; c < dimension; ++c) {
      field.values[3 * i + static_cast<std::size_t>(c)] = at(i, c);
    }
  }
  return field;
}

/// A symmetric tensor field from `at(particle, row)` with 4 rows (xx yy zz xy) or 6 (then yz zx,
/// which is ParaView's order, too).
template <class At>
PointField tensor_field(std::string name, std::string unit, std::size_t particles, int rows,
                        At&& at) {
  PointField field{std::move(name), std::move(unit), 6, std::vector<double>(6 * particles, 0.0)};
  for (std::size_t i = 0; i < particles; ++i) {
    for (int r = 0; r < rows; ++r) field.values[6 * i + static_cast<std::size_t>(r)] = at(i, r);
  }
  return field;
}

/// The cells of a grid: all of one kind, and each with its points to itself, one after the other.
struct VtkCells {
  std::uint8_t type = 1;   // as VTK numbers them: 1 vertex, 5 triangle, 22 quadratic triangle
  std::size_t points = 1;  // of a cell
};

/// Writes the group /VTKHDF (UnstructuredGrid 1.0) beside whatever else the file holds; VTK 9.1 and
/// ParaView 5.11 open a file named *.hdf by it. A particle is a vertex.
/// @param points  [m] x0 y0 z0 x1 ..., 3 per point
/// @param fields  of the points, `of_cells` of the cells
/// @throws std::invalid_argument if a size does not fit; FileError.
void write_vtkhdf(Hdf5File& file, std::span<const double> points,
                  std::span<const PointField> fields, const VtkCells& cells = {},
                  std::span<const PointField> of_cells = {});

}  // namespace files
