#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "scene/scene.hpp"

namespace tables {

/// A value as it stands in TOML: numbers are double, choices their names, points x0 y0 x1 y1 ...
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
                           std::vector<std::string>>;

enum class ValueKind { boolean, integer, number, text, choice, numbers, texts, choices, points };

/// Allowed interval of a number; an open end excludes its bound.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;

  [[nodiscard]] bool holds(double value) const;
  /// `> 0`, `0 .. 0.4`, `0 <= value < 90`, or "" for all numbers.
  [[nodiscard]] std::string text() const;
};

[[nodiscard]] constexpr Range positive() {
  return {.lower = 0.0, .lower_open = true};
}
[[nodiscard]] constexpr Range at_least(double lower) {
  return {.lower = lower};
}
[[nodiscard]] constexpr Range between(double lower, double upper) {
  return {lower, upper};
}

/// required: the key must be there; defaulted: the member's default stands in; optional: its
/// absence means something of its own, said in `FieldNotes::absent`.
enum class Need { required, defaulted, optional };

/// What is said about a key, everywhere it is said.
struct FieldNotes {
  Need need = Need::defaulted;
  std::string_view unit = "";
  Range range = {};
  std::string_view doc = "";
  std::string_view source = "";
  std::string_view absent = "";  // what an absent optional key means
};

/// One key of one table: its description and the way to and from the scene.
struct Field {
  std::string_view key;
  ValueKind kind;
  std::vector<std::string_view> choices;  // allowed names, for choice and choices
  FieldNotes notes;
  /// The value of entry `index` (0 for a single table), or nothing if absent.
  std::function<std::optional<Value>(const scene::Scene&, std::size_t index)> read;
  /// Stores a value whose alternative is the kind's and which `kind`, range and choices allow.
  std::function<void(scene::Scene&, std::size_t index, const Value&)> write;

  /// `a number > 0 [m]`, `one of cell, vertex`: what a message offers as allowed.
  [[nodiscard]] std::string allowed_text() const;
};

/// One table of the scene, `[name]` or, if repeated, `[[name]]`; "" is the top level.
struct TableInfo {
  std::string_view name;
  bool repeated = false;
  bool required = false;
  std::string_view doc;
  std::vector<Field> fields;
  std::function<std::size_t(const scene::Scene&)> size;          // entries; 1 for a single table
  std::function<void(scene::Scene&, std::size_t count)> resize;  // nothing for a single table

  /// The field of that key, or nullptr.
  [[nodiscard]] const Field* find(std::string_view key) const;
  /// `[geometry]`, `[[material]]`, `the top level`.
  [[nodiscard]] std::string title() const;
  /// Dotted path of an entry's key, as --set takes it: geometry.spacing, material.0.cohesion.
  [[nodiscard]] std::string path(std::size_t index, std::string_view key) const;
};

/// The table of that name, or nullptr.
[[nodiscard]] const TableInfo* find_table(const std::vector<TableInfo>& tables,
                                          std::string_view name);

/// A number in its shortest form that reads back to the same double; always a TOML float.
[[nodiscard]] std::string number_text(double value);
/// A value as TOML text.
[[nodiscard]] std::string value_text(const Value& value);
/// `a, b, c`.
[[nodiscard]] std::string joined(std::span<const std::string_view> items);

}  // namespace tables
