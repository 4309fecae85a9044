#include "files/vtkhdf.hpp"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

namespace files {

namespace {

/// Writes fields of `n` points or cells into a group.
void write_fields(Hdf5File& file, const std::string& group, std::size_t n,
                  std::span<const PointField> fields) {
  file.make_group(group);
  for (const PointField& field : fields) {
    const auto components = static_cast<std::size_t>(field.components);
    if (field.values.size() != n * components) {
      throw std::invalid_argument(
          fmt::format("VTKHDF field {}: {} values for {} points or cells of {}", field.name,
                      field.values.size(), n, components));
    }
    const Shape shape = components == 1 ? Shape{n} : Shape{n, components};
    file.write<double>(group + '/' + field.name, field.values, shape, field.unit);
  }
}

}  // namespace

void write_vtkhdf(Hdf5File& file, std::span<const double> points,
                  std::span<const PointField> fields, const VtkCells& cells,
                  std::span<const PointField> of_cells) {
  const std::size_t n = points.size() / 3;
  if (points.size() % (3 * cells.points) != 0) {
    throw std::invalid_argument(
        fmt::format("VTKHDF points: {} coordinates are not 3 for each of {} points per cell",
                    points.size(), cells.points));
  }
  const std::size_t count = n / cells.points;
  file.make_group("/VTKHDF");
  // ParaView wants Type as a fixed-length text.
  file.write_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  file.write_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});

  const auto number = [&](const char* name, std::size_t value) {
    const std::vector<std::int64_t> one{static_cast<std::int64_t>(value)};
    file.write<std::int64_t>(std::string("/VTKHDF/") + name, one, {1});
  };
  number("NumberOfPoints", n);
  number("NumberOfCells", count);
  number("NumberOfConnectivityIds", n);
  std::vector<std::int64_t> offsets(count + 1);
  for (std::size_t i = 0; i <= count; ++i) offsets[i] = static_cast<std::int64_t>(i * cells.points);
  file.write<std::int64_t>("/VTKHDF/Offsets", offsets, {count + 1});
  std::vector<std::int64_t> numbers(n);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  file.write<std::int64_t>("/VTKHDF/Connectivity", numbers, {n});
  file.write<std::uint8_t>("/VTKHDF/Types", std::vector<std::uint8_t>(count, cells.type), {count});
  file.write<double>("/VTKHDF/Points", points, {n, 3}, "m");

  write_fields(file, "/VTKHDF/PointData", n, fields);
  if (!of_cells.empty()) write_fields(file, "/VTKHDF/CellData", count, of_cells);
}

}  // namespace files
