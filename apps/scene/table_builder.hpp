#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "scene/names.hpp"
#include "tables/table.hpp"

namespace scene {

namespace detail {

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
constexpr tables::ValueKind kind_of() {
  if constexpr (is_optional<T>)
    return kind_of<typename T::value_type>();
  else if constexpr (std::is_same_v<T, bool>)
    return tables::ValueKind::boolean;
  else if constexpr (std::is_integral_v<T>)
    return tables::ValueKind::integer;
  else if constexpr (std::is_floating_point_v<T>)
    return tables::ValueKind::number;
  else if constexpr (std::is_same_v<T, std::string>)
    return tables::ValueKind::text;
  else if constexpr (std::is_enum_v<T>)
    return tables::ValueKind::choice;
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return tables::ValueKind::numbers;
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return tables::ValueKind::texts;
  else
    return tables::ValueKind::choices;
}

template <class T>
std::vector<std::string_view> choices_of() {
  if constexpr (is_optional<T>) {
    return choices_of<typename T::value_type>();
  } else if constexpr (std::is_enum_v<T>) {
    const auto all = names_of(T{});
    return {all.begin(), all.end()};
  } else if constexpr (kind_of<T>() == tables::ValueKind::choices) {
    return choices_of<typename T::value_type>();
  } else {
    return {};
  }
}

template <class Enum>
Enum enum_of(std::string_view name) {
  const auto all = names_of(Enum{});
  std::size_t i = 0;
  while (i + 1 < all.size() && all[i] != name) ++i;
  return static_cast<Enum>(i);
}

template <class T>
std::optional<tables::Value> to_value(const T& member) {
  if constexpr (is_optional<T>) {
    return member ? to_value(*member) : std::nullopt;
  } else if constexpr (std::is_enum_v<T>) {
    return tables::Value(std::string(name_of(member)));
  } else if constexpr (std::is_same_v<T, bool>) {
    return tables::Value(member);
  } else if constexpr (std::is_integral_v<T>) {
    return tables::Value(static_cast<std::int64_t>(member));
  } else if constexpr (kind_of<T>() == tables::ValueKind::choices) {
    if (member.empty()) return std::nullopt;
    std::vector<std::string> all;
    for (const auto item : member) all.emplace_back(name_of(item));
    return tables::Value(all);
  } else if constexpr (kind_of<T>() == tables::ValueKind::numbers ||
                       kind_of<T>() == tables::ValueKind::texts) {
    return member.empty() ? std::nullopt : std::optional<tables::Value>(member);
  } else {
    return tables::Value(member);
  }
}

template <class T>
void from_value(T& member, const tables::Value& value) {
  if constexpr (is_optional<T>) {
    from_value(member.emplace(), value);
  } else if constexpr (std::is_enum_v<T>) {
    member = enum_of<T>(std::get<std::string>(value));
  } else if constexpr (std::is_same_v<T, bool>) {
    member = std::get<bool>(value);
  } else if constexpr (std::is_integral_v<T>) {
    member = static_cast<T>(std::get<std::int64_t>(value));
  } else if constexpr (kind_of<T>() == tables::ValueKind::choices) {
    member.clear();
    for (const auto& name : std::get<std::vector<std::string>>(value)) {
      member.push_back(enum_of<typename T::value_type>(name));
    }
  } else {
    member = std::get<T>(value);
  }
}

}  // namespace detail

/// Lists the keys of one table struct; `Holder` is how the scene holds it: a member, a vector of
/// them, or the scene itself.
template <class Table>
class TableBuilder {
 public:
  TableBuilder(std::string_view name, Table Scene::*member, std::string_view doc) {
    start(name, doc, false);
    reach_ = [member](Scene& scene, std::size_t) -> Table& { return scene.*member; };
    reach_const_ = [member](const Scene& scene, std::size_t) -> const Table& {
      return scene.*member;
    };
  }

  TableBuilder(std::string_view name, std::vector<Table> Scene::*member, std::string_view doc) {
    start(name, doc, true);
    table_.size = [member](const Scene& scene) { return (scene.*member).size(); };
    table_.resize = [member](Scene& scene, std::size_t n) { (scene.*member).resize(n); };
    reach_ = [member](Scene& scene, std::size_t i) -> Table& { return (scene.*member)[i]; };
    reach_const_ = [member](const Scene& scene, std::size_t i) -> const Table& {
      return (scene.*member)[i];
    };
  }

  /// The top level.
  explicit TableBuilder(std::string_view doc) requires std::same_as<Table, Scene> {
    start("", doc, false);
    reach_ = [](Scene& scene, std::size_t) -> Scene& { return scene; };
    reach_const_ = [](const Scene& scene, std::size_t) -> const Scene& { return scene; };
  }

  template <class Member>
  TableBuilder& key(std::string_view key, Member Table::*member, tables::FieldNotes notes) {
    tables::Field field{key, detail::kind_of<Member>(), detail::choices_of<Member>(), notes, {},
                        {}};
    field.read = [reach = reach_const_, member](const Scene& scene, std::size_t i) {
      return detail::to_value(reach(scene, i).*member);
    };
    field.write = [reach = reach_, member](Scene& scene, std::size_t i,
                                           const tables::Value& value) {
      detail::from_value(reach(scene, i).*member, value);
    };
    table_.fields.push_back(std::move(field));
    return *this;
  }

  /// Restricts the last key, a list of texts, to these names.
  TableBuilder& among(std::span<const std::string_view> allowed) {
    table_.fields.back().choices.assign(allowed.begin(), allowed.end());
    table_.fields.back().kind = tables::ValueKind::choices;
    return *this;
  }

  TableBuilder& required() {
    table_.required = true;
    return *this;
  }

  [[nodiscard]] tables::TableInfo build() { return std::move(table_); }

 private:
  void start(std::string_view name, std::string_view doc, bool repeated) {
    table_.name = name;
    table_.doc = doc;
    table_.repeated = repeated;
    table_.size = [](const Scene&) { return std::size_t{1}; };
    table_.resize = [](Scene&, std::size_t) {};
  }

  tables::TableInfo table_;
  std::function<Table&(Scene&, std::size_t)> reach_;
  std::function<const Table&(const Scene&, std::size_t)> reach_const_;
};

}  // namespace scene
