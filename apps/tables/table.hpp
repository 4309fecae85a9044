#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tables/toml_text.hpp"
#include "tables/varying_number.hpp"

namespace tables {

/// A value as it stands in TOML: numbers are double, choices their names, points x0 y0 x1 y1 ...,
/// with arcs as chords (arc.hpp), polygons lists of points.
using Value =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>,
                 std::vector<std::string>, std::vector<std::vector<double>>, VaryingNumber>;

enum class ValueKind {
  boolean,
  integer,
  number,
  text,
  choice,
  numbers,
  texts,
  choices,
  points,
  polygons,
  varying
};

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

/// One key of one table, as it is described.
struct FieldInfo {
  std::string key;  // dotted in a table within the table: drive.kind
  ValueKind kind = ValueKind::text;
  std::vector<std::string_view> choices;  // allowed names, for choice and choices
  FieldNotes notes;

  /// `a number > 0 [m]`, `one of cell, vertex`: what a message offers as allowed.
  [[nodiscard]] std::string allowed_text() const;
};

/// One table, `[name]` or, if repeated, `[[name]]`; "" is the top level.
struct TableHead {
  std::string_view name;
  bool repeated = false;
  bool required = false;
  std::string_view doc;
  std::string_view former = "";  // a name it had, which is still read, with a line of advice

  /// Whether a table of that name is this one, by its name or its former one.
  [[nodiscard]] bool is_called(std::string_view other) const {
    return other == name || (!former.empty() && other == former);
  }
  /// `[geometry]`, `[[material]]`, `the top level`.
  [[nodiscard]] std::string title() const;
  /// Dotted path of an entry's key, as --set takes it: geometry.spacing, material.0.cohesion.
  [[nodiscard]] std::string path(std::size_t index, std::string_view key) const;
};

/// A table and its keys: as they are described (FieldInfo), or with the way to and from a struct
/// besides (Field).
template <class Key>
struct TableOf : TableHead {
  std::vector<Key> fields;

  /// Whether some keys are those of a table of this name within the table.
  [[nodiscard]] bool has_within(std::string_view name) const {
    return std::any_of(fields.begin(), fields.end(), [&](const Key& field) {
      return field.key.size() > name.size() && field.key.starts_with(name) &&
             field.key[name.size()] == '.';
    });
  }

  /// The field of that key, or nullptr.
  [[nodiscard]] const Key* find(std::string_view key) const {
    const auto found = std::find_if(fields.begin(), fields.end(),
                                    [&](const Key& field) { return field.key == key; });
    return found == fields.end() ? nullptr : &*found;
  }
};

/// A table as it is described: all that a reader of text needs to know of it.
using TableInfo = TableOf<FieldInfo>;

/// The table of that name, or nullptr.
template <class Table>
[[nodiscard]] const Table* find_table(const std::vector<Table>& tables, std::string_view name) {
  const auto found = std::find_if(tables.begin(), tables.end(),
                                  [&](const Table& table) { return table.name == name; });
  return found == tables.end() ? nullptr : &*found;
}

/// A value as TOML text.
[[nodiscard]] std::string value_text(const Value& value);
/// The same of a value of a kind: coordinates of points are put in pairs.
[[nodiscard]] std::string value_text(const Value& value, ValueKind kind);
/// `a, b, c`.
[[nodiscard]] std::string joined(std::span<const std::string_view> items);

}  // namespace tables
