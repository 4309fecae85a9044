#include "files/vtkhdf.hpp"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

namespace files {

namespace {

constexpr std::uint8_t vertex_cell = 1;  // VTK_VERTEX

}  // namespace

void write_vtkhdf(Hdf5File& file, std::span<const double> points,
                  std::span<const PointField> fields) {
  const std::size_t n = points.size() / 3;
  if (points.size() % 3 != 0) {
    throw std::invalid_argument(
        fmt::format("VTKHDF points: {} coordinates are not 3 per particle", points.size()));
  }
  file.make_group("/VTKHDF");
  // ParaView wants Type as a fixed-length text.
  file.write_attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
  file.write_attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});

  const std::vector<std::int64_t> count{static_cast<std::int64_t>(n)};
  for (const char* name : {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"}) {
    file.write<std::int64_t>(std::string("/VTKHDF/") + name, count, {1});
  }
  std::vector<std::int64_t> numbers(n + 1);
  std::iota(numbers.begin(), numbers.end(), std::int64_t{0});
  file.write<std::int64_t>("/VTKHDF/Offsets", numbers, {n + 1});
  file.write<std::int64_t>("/VTKHDF/Connectivity", std::span(numbers).first(n), {n});
  file.write<std::uint8_t>("/VTKHDF/Types", std::vector<std::uint8_t>(n, vertex_cell), {n});
  file.write<double>("/VTKHDF/Points", points, {n, 3}, "m");

  file.make_group("/VTKHDF/PointData");
  for (const PointField& field : fields) {
    const auto components = static_cast<std::size_t>(field.components);
    if (field.values.size() != n * components) {
      throw std::invalid_argument(fmt::format("VTKHDF field {}: {} values for {} particles of {}",
                                              field.name, field.values.size(), n, components));
    }
    const Shape shape = components == 1 ? Shape{n} : Shape{n, components};
    file.write<double>("/VTKHDF/PointData/" + field.name, field.values, shape, field.unit);
  }
}

}  // namespace files
