#include "tables/varying_number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "tables/toml_text.hpp"

namespace tables {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double in_table(const Samples& table, double coordinate) {
  const auto& at = table.coordinates;
  const auto above = std::upper_bound(at.begin(), at.end(), coordinate);
  if (above == at.begin()) return table.values.front();
  if (above == at.end()) return table.values.back();
  const auto i = static_cast<std::size_t>(above - at.begin());
  const double share = (coordinate - at[i - 1]) / (at[i] - at[i - 1]);
  return (1.0 - share) * table.values[i - 1] + share * table.values[i];
}

// The cell's middle before a place along one axis, and the share of the way to the next.
std::pair<std::size_t, double> between(double place, double lower, double step, std::size_t count) {
  const double way = std::clamp((place - lower) / step, 0.0, static_cast<double>(count - 1));
  const auto before = std::min(static_cast<std::size_t>(way), count > 1 ? count - 2 : 0);
  return {before, count > 1 ? way - static_cast<double>(before) : 0.0};
}

double in_raster(const Samples& raster, double x, double y) {
  const auto across = between(x, raster.lower[0], raster.step[0], raster.columns);
  const auto [row, up] = between(y, raster.lower[1], raster.step[1], raster.rows());
  const std::size_t column = across.first;
  const std::size_t next = raster.columns > 1 ? 1 : 0;
  const auto along = [&](std::size_t at, double share) {
    const double* first = raster.values.data() + at * raster.columns;
    return (1.0 - share) * first[column] + share * first[column + next];
  };
  const double below = along(row, across.second);
  return raster.rows() > 1 ? (1.0 - up) * below + up * along(row + 1, across.second) : below;
}

// Points are sorted by x: those farther along it than the nearest so far are not looked at.
double at_nearest(const Samples& points, double x, double y) {
  const auto& at = points.coordinates;
  const std::size_t count = points.values.size();
  std::size_t low = 0, high = count;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    (at[2 * middle] < x ? low : high) = at[2 * middle] < x ? middle + 1 : middle;
  }
  std::size_t nearest = std::min(low, count - 1);
  double least = infinity;
  const auto look = [&](std::size_t i) {
    const double dx = at[2 * i] - x, dy = at[2 * i + 1] - y;
    if (dx * dx > least) return false;
    const double square = dx * dx + dy * dy;
    if (square < least || (square == least && i < nearest)) {
      nearest = i;
      least = square;
    }
    return true;
  };
  for (std::size_t i = low; i < count && look(i); ++i) continue;
  for (std::size_t i = low; i > 0 && look(i - 1); --i) continue;
  return points.values[nearest];
}

std::string list_of(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + number_text(number);
  return "[" + text + "]";
}

std::string samples_text(const Samples& samples) {
  std::string text;
  const auto add = [&](const std::vector<double>& numbers) {
    text += (text.empty() ? "" : ", ") + list_of(numbers);
  };
  switch (samples.kind) {
    case Samples::Kind::table:
      for (std::size_t i = 0; i < samples.values.size(); ++i) {
        add({samples.coordinates[i], samples.values[i]});
      }
      return fmt::format("{{ along = \"{}\", table = [{}] }}", samples.axis == 0 ? "x" : "y", text);
    case Samples::Kind::points:
      for (std::size_t i = 0; i < samples.values.size(); ++i) {
        add({samples.coordinates[2 * i], samples.coordinates[2 * i + 1], samples.values[i]});
      }
      return fmt::format("{{ points = [{}] }}", text);
    case Samples::Kind::raster:
      break;
  }
  for (std::size_t row = samples.rows(); row > 0; --row) {
    const auto first =
        samples.values.begin() + static_cast<std::ptrdiff_t>((row - 1) * samples.columns);
    add({first, first + static_cast<std::ptrdiff_t>(samples.columns)});
  }
  return fmt::format("{{ raster = [{}], lower = {}, step = {}{} }}", text,
                     list_of({samples.lower[0], samples.lower[1]}),
                     list_of({samples.step[0], samples.step[1]}),
                     samples.nearest ? ", nearest = true" : "");
}

std::string file_text(const SampleFile& file) {
  std::string text;
  if (file.kind == Samples::Kind::table) {
    text = file.below ? "below = " + number_text(*file.below) + ", "
                      : fmt::format("along = \"{}\", ", file.axis == 0 ? "x" : "y");
  }
  constexpr std::array<const char*, 3> names{"table", "raster", "points"};
  text +=
      fmt::format("{} = {}", names[static_cast<std::size_t>(file.kind)], quoted_text(file.name));
  if (file.nearest) text += ", nearest = true";
  if (file.factor != 1.0) text += ", factor = " + number_text(file.factor);
  return "{ " + text + " }";
}

}  // namespace

std::size_t Samples::cell(std::size_t along, double coordinate) const {
  const std::size_t count = along == 0 ? columns : rows();
  const double way = std::floor((coordinate - lower[along]) / step[along] + 0.5);
  return static_cast<std::size_t>(std::clamp(way, 0.0, static_cast<double>(count - 1)));
}

std::array<double, 2> Samples::ends_of_cell(std::size_t along, std::size_t index) const {
  const std::size_t count = along == 0 ? columns : rows();
  const double middle = lower[along] + step[along] * static_cast<double>(index);
  return {index == 0 ? -infinity : middle - 0.5 * step[along],
          index + 1 == count ? infinity : middle + 0.5 * step[along]};
}

std::array<double, 2> Samples::place(std::size_t i) const {
  switch (kind) {
    case Kind::table:
      return axis == 0 ? std::array{coordinates[i], 0.0} : std::array{0.0, coordinates[i]};
    case Kind::points:
      return {coordinates[2 * i], coordinates[2 * i + 1]};
    case Kind::raster:
      break;
  }
  const std::size_t row = i / columns, column = i % columns;
  return {lower[0] + step[0] * static_cast<double>(column),
          lower[1] + step[1] * static_cast<double>(row)};
}

double Samples::at_place(std::span<const double> place) const {
  switch (kind) {
    case Kind::table:
      return in_table(*this, place[axis]);
    case Kind::raster:
      return nearest ? values[cell(1, place[1]) * columns + cell(0, place[0])]
                     : in_raster(*this, place[0], place[1]);
    case Kind::points:
      break;
  }
  return at_nearest(*this, place[0], place[1]);
}

std::array<std::array<double, 2>, 2> Samples::coverage() const {
  std::array<std::array<double, 2>, 2> ends{{{-infinity, -infinity}, {infinity, infinity}}};
  if (kind == Kind::table) {
    ends[0][axis] = coordinates.front();
    ends[1][axis] = coordinates.back();
  } else if (kind == Kind::raster) {
    const std::array<std::size_t, 2> counts{columns, rows()};
    for (std::size_t i = 0; i < 2; ++i) {
      ends[0][i] = lower[i] - 0.5 * step[i];
      ends[1][i] = lower[i] + (static_cast<double>(counts[i]) - 0.5) * step[i];
    }
  }
  return ends;
}

VaryingNumber::VaryingNumber(Samples told)
    : value(std::accumulate(told.values.begin(), told.values.end(), 0.0) /
            static_cast<double>(told.values.size())),
      samples(std::make_shared<const Samples>(std::move(told))) {}

VaryingNumber VaryingNumber::scaled(double factor, double divisor) const {
  VaryingNumber product = *this;
  product.value = value * factor / divisor;
  for (double& component : product.gradient) component = component * factor / divisor;
  if (samples) {
    Samples told = *samples;
    for (double& one : told.values) one = one * factor / divisor;
    product.samples = std::make_shared<const Samples>(std::move(told));
  }
  return product;
}

std::pair<double, double> VaryingNumber::extremes(
    std::span<const std::array<double, 2>> places) const {
  if (samples) {
    const auto [least, most] = std::ranges::minmax(samples->values);
    return {least, most};
  }
  if (!varies() || places.empty()) return {value, value};
  std::pair<double, double> ends(infinity, -infinity);
  for (const auto& place : places) {
    const double here = at_place(place);
    ends = {std::min(ends.first, here), std::max(ends.second, here)};
  }
  return ends;
}

bool VaryingNumber::operator==(const VaryingNumber& other) const {
  if (value != other.value || at != other.at || gradient != other.gradient || file != other.file) {
    return false;
  }
  if (samples == other.samples) return true;
  return samples && other.samples && *samples == *other.samples;
}

Samples table_samples(std::vector<std::array<double, 2>> pairs, std::size_t axis,
                      const std::optional<double>& below) {
  Samples table;
  table.axis = below ? 1 : axis;
  if (below) {
    for (auto& pair : pairs) pair[0] = *below - pair[0];
    std::ranges::reverse(pairs);
  }
  for (const auto& [coordinate, value] : pairs) {
    table.coordinates.push_back(coordinate);
    table.values.push_back(value);
  }
  return table;
}

Samples point_samples(std::vector<std::array<double, 3>> points) {
  std::ranges::stable_sort(points, {}, [](const auto& point) { return point[0]; });
  Samples samples;
  samples.kind = Samples::Kind::points;
  for (const auto& [x, y, value] : points) {
    samples.coordinates.insert(samples.coordinates.end(), {x, y});
    samples.values.push_back(value);
  }
  return samples;
}

std::string varying_text(const VaryingNumber& number) {
  if (number.file) return file_text(*number.file);
  if (number.samples) return samples_text(*number.samples);
  if (!number.varies()) return number_text(number.value);
  return fmt::format("{{ at = {}, value = {}, gradient = {} }}",
                     list_of({number.at[0], number.at[1]}), number_text(number.value),
                     list_of({number.gradient[0], number.gradient[1]}));
}

}  // namespace tables
