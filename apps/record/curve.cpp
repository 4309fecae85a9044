#include "record/curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <type_traits>

namespace record {

namespace {

template <class Number>
Number parse_number(std::string_view text, std::string_view column) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc{} || stop != end) {
    throw std::invalid_argument(fmt::format("{} is no number in column {}", text, column));
  }
  return value;
}

constexpr std::string_view last_column = "wall_s";

/// Names of the columns that every curve has.
std::vector<std::string> common_names(int dimension) {
  std::vector<std::string> names;
  const CurveRow any;
  CurveRow::for_each_column(
      any, [&](std::string_view name, const auto& /*value*/, std::string_view name_3d = "") {
        names.emplace_back(dimension == 3 && !name_3d.empty() ? name_3d : name);
      });
  return names;
}

/// Splits off the text before the next comma.
std::string_view next_text(std::string_view& line) {
  const std::string_view text = line.substr(0, line.find(','));
  line.remove_prefix(std::min(text.size() + 1, line.size()));
  return text;
}

}  // namespace

std::vector<std::string> column_names(const CurveColumns& columns) {
  std::vector<std::string> names = common_names(columns.dimension);
  names.insert(names.end() - 1, columns.measures.begin(), columns.measures.end());
  return names;
}

std::string curve_header(const CurveColumns& columns) {
  return fmt::format("{}", fmt::join(column_names(columns), ","));
}

std::optional<CurveColumns> parse_curve_header(std::string_view line) {
  std::vector<std::string> names;
  while (!line.empty()) names.emplace_back(next_text(line));
  const auto common = static_cast<std::ptrdiff_t>(common_names(2).size());
  if (std::ssize(names) < common) return std::nullopt;
  const std::vector<std::string> measures(names.begin() + common - 1, names.end() - 1);
  for (const int dimension : {2, 3}) {
    const CurveColumns columns(dimension, measures);
    if (column_names(columns) == names) return columns;
  }
  return std::nullopt;
}

std::string curve_line(const CurveRow& row) {
  std::string line;
  // fmt writes a double in the shortest form that reads back to it.
  const auto add = [&](const auto& value) { line += fmt::format("{},", value); };
  CurveRow::for_each_column(row, [&](std::string_view name, const auto& value, auto&&...) {
    if (name == last_column) {
      for (const double measure : row.measures) add(measure);
    }
    add(value);
  });
  line.pop_back();
  return line;
}

CurveRow parse_curve_line(std::string_view line, std::size_t measures) {
  const std::size_t columns = common_names(2).size() + measures;
  if (static_cast<std::size_t>(std::ranges::count(line, ',')) + 1 != columns) {
    throw std::invalid_argument(fmt::format("there are not {} columns", columns));
  }
  CurveRow row;
  CurveRow::for_each_column(row, [&](std::string_view name, auto& value, auto&&...) {
    if (name == last_column) {
      for (std::size_t i = 0; i < measures; ++i) {
        row.measures.push_back(parse_number<double>(next_text(line), "of a measure"));
      }
    }
    value = parse_number<std::remove_reference_t<decltype(value)>>(next_text(line), name);
  });
  return row;
}

std::string curve_text(const CurveColumns& columns, const std::vector<CurveRow>& rows) {
  std::string text = curve_header(columns) + "\n";
  for (const CurveRow& row : rows) text += curve_line(row) + "\n";
  return text;
}

void change_measures(std::vector<CurveRow>& rows, const std::vector<std::string>& before,
                     const std::vector<std::string>& after) {
  if (before == after) return;
  for (CurveRow& row : rows) {
    std::vector<double> measures(after.size(), std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < after.size(); ++i) {
      const auto found = std::ranges::find(before, after[i]);
      if (found != before.end()) {
        measures[i] = row.measures[static_cast<std::size_t>(found - before.begin())];
      }
    }
    row.measures = std::move(measures);
  }
}

}  // namespace record
