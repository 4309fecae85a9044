#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tables/table.hpp"

namespace tables {

// How a member of a struct stands in a table, by its type. Members that may be absent are optionals
// or lists, whose emptiness is absence. The names of an enumeration's values, in the enumerators'
// order, are what `names_of(Enum)` beside it returns.

namespace detail {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

/// A point of the plane.
template <class T>
concept Point = requires(const T& point) {
  point.x();
  point.y();
  T(0.0, 0.0);
};

template <class Points>
std::vector<double> coordinates_of(const Points& points) {
  std::vector<double> coordinates;
  for (const auto& point : points) coordinates.insert(coordinates.end(), {point.x(), point.y()});
  return coordinates;
}

template <class Points>
void set_points(Points& points, const std::vector<double>& coordinates) {
  points.clear();
  for (std::size_t i = 0; i + 1 < coordinates.size(); i += 2) {
    points.emplace_back(coordinates[i], coordinates[i + 1]);
  }
}

template <class Enum>
Enum enum_of(std::string_view name) {
  const auto all = names_of(Enum{});
  std::size_t i = 0;
  while (i + 1 < all.size() && all[i] != name) ++i;
  return static_cast<Enum>(i);
}

template <class Enum>
std::string_view text_of(Enum value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

}  // namespace detail

template <class T>
constexpr ValueKind kind_of() {
  if constexpr (detail::is_optional<T>) {
    return kind_of<typename T::value_type>();
  } else if constexpr (std::is_same_v<T, std::string>) {
    return ValueKind::text;
  } else if constexpr (detail::is_list<T>) {
    using Item = typename T::value_type;
    if constexpr (detail::Point<Item>) {
      return ValueKind::points;
    } else if constexpr (detail::is_list<Item>) {
      return ValueKind::polygons;
    } else if constexpr (std::is_same_v<Item, double>) {
      return ValueKind::numbers;
    } else {
      return std::is_enum_v<Item> ? ValueKind::choices : ValueKind::texts;
    }
  } else if constexpr (std::is_same_v<T, VaryingNumber>) {
    return ValueKind::varying;
  } else if constexpr (std::is_same_v<T, bool>) {
    return ValueKind::boolean;
  } else if constexpr (std::is_integral_v<T>) {
    return ValueKind::integer;
  } else {
    return std::is_enum_v<T> ? ValueKind::choice : ValueKind::number;
  }
}

/// The names a member may take; none if it is no choice.
template <class T>
std::vector<std::string_view> choices_of() {
  if constexpr (std::is_enum_v<T>) {
    const auto all = names_of(T{});
    return {all.begin(), all.end()};
  } else if constexpr (detail::is_optional<T> || detail::is_list<T>) {
    return choices_of<typename T::value_type>();
  } else {
    return {};
  }
}

/// A member's value, or nothing if it is absent.
template <class T>
std::optional<Value> to_value(const T& member) {
  if constexpr (detail::is_optional<T>) {
    return member ? to_value(*member) : std::nullopt;
  } else if constexpr (std::is_enum_v<T>) {
    return Value(std::string(detail::text_of(member)));
  } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    return Value(static_cast<std::int64_t>(member));
  } else if constexpr (!detail::is_list<T>) {
    return Value(member);
  } else {
    if (member.empty()) return std::nullopt;
    if constexpr (kind_of<T>() == ValueKind::points) {
      return Value(detail::coordinates_of(member));
    } else if constexpr (kind_of<T>() == ValueKind::polygons) {
      std::vector<std::vector<double>> polygons;
      for (const auto& points : member) polygons.push_back(detail::coordinates_of(points));
      return Value(std::move(polygons));
    } else if constexpr (kind_of<T>() == ValueKind::choices) {
      std::vector<std::string> names;
      for (const auto item : member) names.emplace_back(detail::text_of(item));
      return Value(std::move(names));
    } else {
      return Value(member);
    }
  }
}

/// Stores a value of the member's kind.
template <class T>
void from_value(T& member, const Value& value) {
  if constexpr (detail::is_optional<T>) {
    from_value(member.emplace(), value);
  } else if constexpr (std::is_enum_v<T>) {
    member = detail::enum_of<T>(std::get<std::string>(value));
  } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    member = static_cast<T>(std::get<std::int64_t>(value));
  } else if constexpr (kind_of<T>() == ValueKind::points) {
    detail::set_points(member, std::get<std::vector<double>>(value));
  } else if constexpr (kind_of<T>() == ValueKind::polygons) {
    member.clear();
    for (const auto& coordinates : std::get<std::vector<std::vector<double>>>(value)) {
      detail::set_points(member.emplace_back(), coordinates);
    }
  } else if constexpr (kind_of<T>() == ValueKind::choices) {
    member.clear();
    for (const std::string& name : std::get<std::vector<std::string>>(value)) {
      member.push_back(detail::enum_of<typename T::value_type>(name));
    }
  } else {
    member = std::get<T>(value);
  }
}

}  // namespace tables
