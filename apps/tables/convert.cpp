#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "tables/arc.hpp"
#include "tables/nearest_name.hpp"
#include "tables/tree.hpp"

namespace tables {

namespace {

// Counts are held in 32 bits.
constexpr std::int64_t largest_integer = 2147483647;

struct Reader {
  const FieldInfo& field;
  const std::string& key;
  Diagnosis& diagnosis;

  std::nullopt_t refuse(const toml::node& node) const {
    diagnosis.error(key, "found " + describe(node), "allowed is " + field.allowed_text());
    return std::nullopt;
  }

  std::optional<double> number(const toml::node& node) const {
    const auto value = node.value<double>();
    if (!value || !(node.is_integer() || node.is_floating_point())) return refuse(node);
    if (!std::isfinite(*value) || !field.notes.range.holds(*value)) return refuse(node);
    return value;
  }

  std::optional<Value> integer(const toml::node& node) const {
    const auto value = node.value_exact<std::int64_t>();
    if (!value || !field.notes.range.holds(static_cast<double>(*value))) return refuse(node);
    if (*value > largest_integer || *value < -largest_integer) {
      diagnosis.error(key, "found " + describe(node),
                      fmt::format("allowed is a whole number up to {}", largest_integer));
      return std::nullopt;
    }
    return Value(*value);
  }

  std::optional<std::string> name(const toml::node& node) const {
    const auto value = node.value_exact<std::string>();
    if (!value) return refuse(node);
    const auto& choices = field.choices;
    if (choices.empty() || std::find(choices.begin(), choices.end(), *value) != choices.end()) {
      return value;
    }
    diagnosis.error(key, "found " + describe(node), "allowed is " + field.allowed_text(),
                    nearest_name(*value, choices));
    return std::nullopt;
  }

  /// Two numbers.
  std::optional<std::array<double, 2>> pair(const toml::node& node) const {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != 2) return refuse(node);
    const auto x = number((*list)[0]), y = number((*list)[1]);
    if (!x || !y) return std::nullopt;
    return std::array<double, 2>{*x, *y};
  }

  /// A table of centre, radius, from, to and chords.
  std::optional<Arc> arc(const toml::table& table) const {
    const auto wrong = [&](const std::string& found, const std::string& allowed) {
      diagnosis.error(key, found, "allowed is " + allowed);
      return std::nullopt;
    };
    constexpr std::string_view form =
        "an arc { centre = [x, y], radius = r, from = degrees, to = degrees, chords = n }";
    for (const auto& entry : table) {
      constexpr std::array<std::string_view, 5> names{"centre", "radius", "from", "to", "chords"};
      if (std::ranges::count(names, entry.first.str()) > 0) continue;
      return wrong(fmt::format("no such key in it: {}", entry.first.str()), std::string(form));
    }
    const toml::node *centre = table.get("centre"), *radius = table.get("radius");
    if (centre == nullptr || radius == nullptr || table.contains("from") != table.contains("to")) {
      return wrong("found an arc with something missing", std::string(form));
    }
    Arc arc;
    const auto middle = pair(*centre);
    const auto size = number(*radius);
    if (!middle || !size) return std::nullopt;
    arc.centre = *middle;
    arc.radius = *size;
    for (const auto& [name, angle] : {std::pair("from", &arc.from), std::pair("to", &arc.to)}) {
      const toml::node* node = table.get(name);
      const auto value = node == nullptr ? std::optional(*angle) : number(*node);
      if (!value) return std::nullopt;
      *angle = *value;
    }
    if (const toml::node* chords = table.get("chords")) {
      const auto count = chords->value_exact<std::int64_t>();
      if (!count || *count < Arc::fewest_chords || *count > Arc::most_chords) {
        return wrong("found chords = " + describe(*chords),
                     fmt::format("a whole number {} .. {}", Arc::fewest_chords, Arc::most_chords));
      }
      arc.chords = static_cast<int>(*count);
    }
    if (const std::string why = objection(arc); !why.empty()) return wrong(why, std::string(form));
    return arc;
  }

  /// A list of pairs of numbers, and of arcs.
  std::optional<std::vector<double>> coordinates(const toml::node& node) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty()) return refuse(node);
    std::vector<double> coordinates;
    bool follows_arc = false;
    for (const toml::node& entry : *array) {
      if (const toml::table* table = entry.as_table()) {
        const auto found = arc(*table);
        if (!found) return std::nullopt;
        append(*found, coordinates);
        follows_arc = true;
        continue;
      }
      const auto place = pair(entry);
      if (!place) return std::nullopt;
      // The end of an arc may be said again.
      const bool is_said = follows_arc && is_end(*place, coordinates);
      if (!is_said) coordinates.insert(coordinates.end(), place->begin(), place->end());
      follows_arc = false;
    }
    return coordinates;
  }

  std::optional<Value> points(const toml::node& node) const {
    auto found = coordinates(node);
    return found ? std::optional<Value>(std::move(*found)) : std::nullopt;
  }

  std::optional<Value> polygons(const toml::node& node) const {
    const toml::array* array = node.as_array();
    if (array == nullptr || array->empty()) return refuse(node);
    std::vector<std::vector<double>> all;
    for (const toml::node& entry : *array) {
      auto found = coordinates(entry);
      if (!found) return std::nullopt;
      all.push_back(std::move(*found));
    }
    return Value(std::move(all));
  }

  /// A list, or one item in its stead.
  template <class Item, class Read>
  std::optional<Value> list(const toml::node& node, Read read) const {
    std::vector<Item> items;
    const toml::array* array = node.as_array();
    if (array == nullptr) {
      const auto item = read(node);
      return item ? std::optional<Value>(std::vector<Item>{*item}) : std::nullopt;
    }
    if (array->empty()) return refuse(node);
    for (const toml::node& entry : *array) {
      const auto item = read(entry);
      if (!item) return std::nullopt;
      items.push_back(*item);
    }
    return Value(std::move(items));
  }
};

template <class T>
std::optional<Value> widen(std::optional<T> value) {
  return value ? std::optional<Value>(std::move(*value)) : std::nullopt;
}

}  // namespace

std::string describe(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "a list of tables";
  std::ostringstream text;
  if (const auto* v = node.as_string()) {
    text << "the text " << value_text(Value(v->get()));
  } else if (const auto* f = node.as_floating_point()) {
    text << number_text(f->get());
  } else if (const auto* i = node.as_integer()) {
    text << i->get();
  } else if (const auto* b = node.as_boolean()) {
    text << (b->get() ? "true" : "false");
  } else if (const auto* a = node.as_array()) {
    if (a->empty()) return "an empty list";
    text << "[";
    for (std::size_t n = 0; n < a->size(); ++n) text << (n ? ", " : "") << describe((*a)[n]);
    text << "]";
  } else {
    text << "a date or time";
  }
  return text.str();
}

std::size_t line_of_endless_key(std::string_view text) {
  constexpr int most_dots = 32;
  std::size_t line = 1;
  int dots = 0;
  char quote = '\0';
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
      quote = '\0';
      comment = false;
    } else if (comment) {
      continue;
    } else if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else if (c == '.') {
      if (++dots > most_dots) return line;
    } else if (c == ',' || c == '=' || c == '[' || c == ']' || c == '{' || c == '}') {
      dots = 0;  // no part of a key
    }
  }
  return 0;
}

std::optional<Value> convert(const toml::node& node, const FieldInfo& field, const std::string& key,
                             Diagnosis& diagnosis) {
  const Reader reader{field, key, diagnosis};
  switch (field.kind) {
    case ValueKind::boolean:
      if (const auto value = node.value_exact<bool>()) return Value(*value);
      return reader.refuse(node);
    case ValueKind::integer:
      return reader.integer(node);
    case ValueKind::number:
      return widen(reader.number(node));
    case ValueKind::text:
    case ValueKind::choice:
      return widen(reader.name(node));
    case ValueKind::numbers:
      return reader.list<double>(node, [&](const toml::node& n) { return reader.number(n); });
    case ValueKind::texts:
    case ValueKind::choices:
      return reader.list<std::string>(node, [&](const toml::node& n) { return reader.name(n); });
    case ValueKind::points:
      return reader.points(node);
    case ValueKind::polygons:
      return reader.polygons(node);
    case ValueKind::varying:
      return convert_varying(node, field, key, diagnosis);
  }
  return std::nullopt;
}

}  // namespace tables
