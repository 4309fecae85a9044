#include "tables/table.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tables {

bool Range::holds(double value) const {
  const bool above = lower_open ? value > lower : value >= lower;
  const bool below = upper_open ? value < upper : value <= upper;
  return above && below;
}

std::string Range::text() const {
  const bool has_lower = std::isfinite(lower), has_upper = std::isfinite(upper);
  if (has_lower && has_upper) {
    if (!lower_open && !upper_open) return fmt::format("{} .. {}", lower, upper);
    return fmt::format("{} {} value {} {}", lower,
                       lower_open ? "<" : "<=", upper_open ? "<" : "<=", upper);
  }
  if (has_lower) return fmt::format("{} {}", lower_open ? ">" : ">=", lower);
  if (has_upper) return fmt::format("{} {}", upper_open ? "<" : "<=", upper);
  return "";
}

std::string FieldInfo::allowed_text() const {
  std::string text;
  switch (kind) {
    case ValueKind::boolean:
      return "true or false";
    case ValueKind::integer:
      text = "a whole number";
      break;
    case ValueKind::number:
      text = "a number";
      break;
    case ValueKind::text:
      return "a text in quotes";
    case ValueKind::choice:
      return "one of " + joined(choices);
    case ValueKind::numbers:
      text = "a list of numbers";
      break;
    case ValueKind::texts:
      return "a list of texts in quotes";
    case ValueKind::choices:
      return "a list of " + joined(choices);
    case ValueKind::points:
      text = "a list of points [x, y] and arcs";
      break;
    case ValueKind::polygons:
      text = "a list of lists of points [x, y] and arcs";
      break;
    case ValueKind::varying:
      text = "a number";
      break;
  }
  if (const std::string range = notes.range.text(); !range.empty()) text += " " + range;
  if (!notes.unit.empty()) text += fmt::format(" [{}]", notes.unit);
  if (kind == ValueKind::varying) {
    text += ", or { at = [x, y], value = v, gradient = [gx, gy] }, a table, a raster or points";
  }
  return text;
}

std::string TableHead::title() const {
  if (name.empty()) return "the top level";
  return repeated ? fmt::format("[[{}]]", name) : fmt::format("[{}]", name);
}

std::string TableHead::path(std::size_t index, std::string_view key) const {
  std::string path(name);
  if (repeated) path += fmt::format(".{}", index);
  if (key.empty()) return path;
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

namespace {

template <class Item, class Show>
std::string list_text(const std::vector<Item>& items, Show show) {
  std::string out = "[";
  for (std::size_t i = 0; i < items.size(); ++i) out += (i == 0 ? "" : ", ") + show(items[i]);
  return out + "]";
}

std::string points_text(const std::vector<double>& coordinates) {
  std::string out;
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
    out += fmt::format("{}[{}, {}]", i == 0 ? "" : ", ", number_text(coordinates[i]),
                       number_text(coordinates[i + 1]));
  }
  return "[" + out + "]";
}

}  // namespace

std::string value_text(const Value& value) {
  struct Show {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return number_text(v); }
    std::string operator()(const std::string& v) const { return quoted_text(v); }
    std::string operator()(const std::vector<double>& v) const { return list_text(v, number_text); }
    std::string operator()(const std::vector<std::string>& v) const {
      return list_text(v, quoted_text);
    }
    std::string operator()(const std::vector<std::vector<double>>& v) const {
      return list_text(v, points_text);
    }
    std::string operator()(const VaryingNumber& v) const { return varying_text(v); }
  };
  return std::visit(Show{}, value);
}

std::string value_text(const Value& value, ValueKind kind) {
  const auto* coordinates = std::get_if<std::vector<double>>(&value);
  if (kind != ValueKind::points || coordinates == nullptr) return value_text(value);
  return points_text(*coordinates);
}

std::string joined(std::span<const std::string_view> items) {
  std::string out;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i != 0) out += ", ";
    out += items[i];
  }
  return out;
}

}  // namespace tables
