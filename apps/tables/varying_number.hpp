#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tables {

/// Places in the plane and the values of a number there.
struct Samples {
  /// table: linear between values along one coordinate. raster: bilinear between the middles of the
  /// cells of a regular grid, and as in the nearest of them up to the edges of its outer cells;
  /// or, if it is `nearest`, of one value in each cell. points: that of the nearest one.
  enum class Kind { table, raster, points };
  Kind kind = Kind::table;
  std::size_t axis = 1;             // table: which coordinate, 0 or 1
  std::vector<double> coordinates;  // table: rising, one a value; points: x0 y0 x1 y1 ..., x rising
  std::array<double, 2> lower{};    // raster: middle of its lowest, leftmost cell
  std::array<double, 2> step{1.0, 1.0};  // raster: from middle to middle, > 0
  std::size_t columns = 0;               // raster
  bool nearest = false;                  // raster: one value in each cell
  std::vector<double> values;            // raster: row by row from below, from left to right

  [[nodiscard]] std::size_t rows() const { return columns > 0 ? values.size() / columns : 0; }
  /// Whether they are of one value around each place, and jump half way to the next.
  [[nodiscard]] bool jumps() const {
    return kind == Kind::points || (kind == Kind::raster && nearest);
  }
  /// raster: which cell a coordinate along one axis is in or, beyond them, next to.
  [[nodiscard]] std::size_t cell(std::size_t along, double coordinate) const;
  /// raster: from where to where that cell counts, an outer one without end.
  [[nodiscard]] std::array<double, 2> ends_of_cell(std::size_t along, std::size_t index) const;
  /// The coordinates of value i, of which a table has one.
  [[nodiscard]] std::array<double, 2> place(std::size_t i) const;
  [[nodiscard]] double at_place(std::span<const double> place) const;
  /// Least and largest x and y that samples speak of; infinite where they do not end.
  [[nodiscard]] std::array<std::array<double, 2>, 2> coverage() const;
  bool operator==(const Samples&) const = default;
};

/// Samples that are in a file beside the text.
struct SampleFile {
  std::string name;
  Samples::Kind kind = Samples::Kind::table;
  std::size_t axis = 1;
  std::optional<double> below;  // table: its coordinates are depths below this level
  bool nearest = false;         // raster: one value in each cell
  double factor = 1.0;          // of its values
  bool operator==(const SampleFile&) const = default;
};

/// A number that changes from place to place: linearly, `value` at `at` and `gradient` times the
/// way from there elsewhere, or as samples tell. In TOML a number, { at = [x, y], value = v,
/// gradient = [gx, gy] }, { along = "y", table = [[y, v], ...] }, { below = y, table = [[depth, v],
/// ...] }, { raster = FILE }, { raster = FILE, nearest = true } or { points = FILE }.
struct VaryingNumber {
  double value = 0.0;  // of samples, their mean
  std::array<double, 2> at{};
  std::array<double, 2> gradient{};
  std::shared_ptr<const Samples> samples;  // none: linear
  std::optional<SampleFile> file;          // that is still to be read

  // NOLINTNEXTLINE(google-explicit-constructor): a number is one
  VaryingNumber(double everywhere = 0.0) : value(everywhere) {}
  VaryingNumber(double v, const std::array<double, 2>& place, const std::array<double, 2>& growth)
      : value(v), at(place), gradient(growth) {}
  explicit VaryingNumber(Samples told);

  [[nodiscard]] bool is_linear() const { return samples == nullptr; }
  [[nodiscard]] bool varies() const {
    return samples != nullptr || gradient != std::array<double, 2>{};
  }
  /// At a place, of which the first two coordinates count.
  [[nodiscard]] double at_place(std::span<const double> place) const {
    if (samples) return samples->at_place(place);
    return value + gradient[0] * (place[0] - at[0]) + gradient[1] * (place[1] - at[1]);
  }
  /// This number times a factor, over a divisor.
  [[nodiscard]] VaryingNumber scaled(double factor, double divisor = 1.0) const;
  /// Its least and largest value: at places between which it is linear, or of all its samples.
  [[nodiscard]] std::pair<double, double> extremes(
      std::span<const std::array<double, 2>> places) const;
  bool operator==(const VaryingNumber& other) const;
};

/// A table's pairs of coordinate and value as samples, depths below a level if there is one.
[[nodiscard]] Samples table_samples(std::vector<std::array<double, 2>> pairs, std::size_t axis,
                                    const std::optional<double>& below);
/// Points x, y, value as samples.
[[nodiscard]] Samples point_samples(std::vector<std::array<double, 3>> points);

/// `{ along = "y", table = [...] }`: a number that changes, as TOML text.
[[nodiscard]] std::string varying_text(const VaryingNumber& number);

}  // namespace tables
