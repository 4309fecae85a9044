#include "record/curve.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
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

}  // namespace

std::vector<std::string> curve_columns(int dimension) {
  std::vector<std::string> names;
  const CurveRow any;
  CurveRow::for_each_column(
      any, [&](std::string_view name, const auto& /*value*/, std::string_view name_3d = "") {
        names.emplace_back(dimension == 3 && !name_3d.empty() ? name_3d : name);
      });
  return names;
}

std::string curve_header(int dimension) {
  return fmt::format("{}", fmt::join(curve_columns(dimension), ","));
}

std::string curve_line(const CurveRow& row) {
  std::string line;
  CurveRow::for_each_column(row, [&](std::string_view /*name*/, const auto& value, auto&&...) {
    if (!line.empty()) line += ',';
    // fmt writes a double in the shortest form that reads back to it.
    line += fmt::format("{}", value);
  });
  return line;
}

CurveRow parse_curve_line(std::string_view line) {
  const auto columns = static_cast<std::ptrdiff_t>(curve_columns(2).size());
  if (std::ranges::count(line, ',') + 1 != columns) {
    throw std::invalid_argument(fmt::format("there are not {} columns", columns));
  }
  CurveRow row;
  CurveRow::for_each_column(row, [&](std::string_view name, auto& value, auto&&...) {
    const std::string_view text = line.substr(0, line.find(','));
    value = parse_number<std::remove_reference_t<decltype(value)>>(text, name);
    line.remove_prefix(std::min(text.size() + 1, line.size()));
  });
  return row;
}

std::string curve_text(int dimension, const std::vector<CurveRow>& rows) {
  std::string text = curve_header(dimension) + "\n";
  for (const CurveRow& row : rows) text += curve_line(row) + "\n";
  return text;
}

}  // namespace record
