#pragma once

#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "tables/field.hpp"
#include "tables/member_value.hpp"

namespace tables {

namespace detail {

/// How a Root holds the struct of a table: as a member, as a vector of them, or it is the struct.
template <class Root, class Struct>
struct Holder {
  Struct Root::*single = nullptr;
  std::vector<Struct> Root::*list = nullptr;

  template <class SomeRoot>  // const or not
  auto& at(SomeRoot& root, std::size_t entry) const {
    if constexpr (std::same_as<Root, Struct>) {
      return root;
    } else {
      return list != nullptr ? (root.*list)[entry] : root.*single;
    }
  }
};

template <class Root, class Struct, class Place>
class MemberAccess final : public Access<Root> {
 public:
  MemberAccess(Holder<Root, Struct> holder, Place place) : holder_(holder), place_(place) {}
  [[nodiscard]] std::optional<Value> read(const Root& root, std::size_t entry) const override {
    return to_value(std::invoke(place_, holder_.at(root, entry)));
  }
  void write(Root& root, std::size_t entry, const Value& value) const override {
    from_value(std::invoke(place_, holder_.at(root, entry)), value);
  }

 private:
  Holder<Root, Struct> holder_;
  Place place_;
};

/// A number written in another unit than the member's.
template <class Root>
class ScaledAccess final : public Access<Root> {
 public:
  ScaledAccess(std::shared_ptr<const Access<Root>> access, double unit)
      : access_(std::move(access)), unit_(unit) {}
  [[nodiscard]] std::optional<Value> read(const Root& root, std::size_t entry) const override {
    const auto value = access_->read(root, entry);
    return value ? std::optional<Value>(std::get<double>(*value) / unit_) : std::nullopt;
  }
  void write(Root& root, std::size_t entry, const Value& value) const override {
    access_->write(root, entry, std::get<double>(value) * unit_);
  }

 private:
  std::shared_ptr<const Access<Root>> access_;
  double unit_;
};

/// A key of a table that an entry may hold or not.
template <class Root, class Struct, class Part>
class WithinAccess final : public Access<Root> {
 public:
  WithinAccess(Holder<Root, Struct> holder, std::optional<Part> Struct::*part,
               std::shared_ptr<const Access<Part>> access)
      : holder_(holder), part_(part), access_(std::move(access)) {}
  [[nodiscard]] std::optional<Value> read(const Root& root, std::size_t entry) const override {
    const std::optional<Part>& part = holder_.at(root, entry).*part_;
    return part ? access_->read(*part, 0) : std::nullopt;
  }
  void write(Root& root, std::size_t entry, const Value& value) const override {
    std::optional<Part>& part = holder_.at(root, entry).*part_;
    if (!part) part.emplace();
    access_->write(*part, 0, value);
  }

 private:
  Holder<Root, Struct> holder_;
  std::optional<Part> Struct::*part_;
  std::shared_ptr<const Access<Part>> access_;
};

template <class Root, class Struct>
class ListEntries final : public Entries<Root> {
 public:
  explicit ListEntries(std::vector<Struct> Root::*list) : list_(list) {}
  [[nodiscard]] std::size_t count(const Root& root) const override { return (root.*list_).size(); }
  void resize(Root& root, std::size_t count) const override { (root.*list_).resize(count); }

 private:
  std::vector<Struct> Root::*list_;
};

}  // namespace detail

/// Lists the keys of one table of a Root, which holds the table's Struct as a member or as a vector
/// of them, or is the Struct itself (the top level).
template <class Root, class Struct>
class TableBuilder {
 public:
  TableBuilder(std::string_view name, Struct Root::*member, std::string_view doc)
      : TableBuilder(name, false, doc) {
    holder_.single = member;
  }

  TableBuilder(std::string_view name, std::vector<Struct> Root::*member, std::string_view doc)
      : TableBuilder(name, true, doc) {
    holder_.list = member;
    table_.entries = std::make_shared<detail::ListEntries<Root, Struct>>(member);
  }

  /// The top level.
  explicit TableBuilder(std::string_view doc) requires std::same_as<Struct, Root>
      : TableBuilder("", false, doc) {}

  /// @param place  a pointer to a member, or what returns a reference to one:
  ///   `[](auto& material) -> auto& { return material.soil.cohesion; }`
  template <class Place>
  TableBuilder& key(std::string_view key, Place place, FieldNotes notes) {
    using Member = std::remove_cvref_t<std::invoke_result_t<Place, Struct&>>;
    Field<Root>& field = table_.fields.emplace_back();
    field.key = key;
    field.kind = kind_of<Member>();
    field.choices = choices_of<Member>();
    field.notes = notes;
    field.access = std::make_shared<detail::MemberAccess<Root, Struct, Place>>(holder_, place);
    return *this;
  }

  /// Adds the keys of a table that an entry may hold: `name.key` each.
  /// @param keys  of that table, by itself
  /// @param doc  in place of theirs
  template <class Part>
  TableBuilder& within(std::string_view name, std::optional<Part> Struct::*part,
                       const Table<Part>& keys, std::string_view doc, std::string_view absent) {
    for (const Field<Part>& key : keys.fields) {
      Field<Root>& field = table_.fields.emplace_back();
      static_cast<FieldInfo&>(field) = key;
      field.key = std::string(name) + "." + key.key;
      field.notes.need = Need::optional;
      field.notes.source = "";
      field.notes.doc = doc;
      field.notes.absent = absent;
      field.access =
          std::make_shared<detail::WithinAccess<Root, Struct, Part>>(holder_, part, key.access);
    }
    return *this;
  }

  /// Restricts the last key, a text or a list of texts, to these names.
  TableBuilder& among(std::span<const std::string_view> allowed) {
    Field<Root>& field = table_.fields.back();
    field.choices.assign(allowed.begin(), allowed.end());
    field.kind = field.kind == ValueKind::text ? ValueKind::choice : ValueKind::choices;
    return *this;
  }

  /// Takes a name from those that the last key, a choice, may be.
  TableBuilder& without(std::string_view refused) {
    std::erase(table_.fields.back().choices, refused);
    return *this;
  }

  /// Says that the last key, a number, is written in this unit of the member's.
  TableBuilder& in(double unit) {
    auto& access = table_.fields.back().access;
    access = std::make_shared<detail::ScaledAccess<Root>>(std::move(access), unit);
    return *this;
  }

  /// The name that the table had before.
  TableBuilder& formerly(std::string_view name) {
    table_.former = name;
    return *this;
  }

  TableBuilder& required() {
    table_.required = true;
    return *this;
  }

  [[nodiscard]] Table<Root> build() { return std::move(table_); }

 private:
  TableBuilder(std::string_view name, bool repeated, std::string_view doc) {
    table_.name = name;
    table_.repeated = repeated;
    table_.doc = doc;
  }

  Table<Root> table_;
  detail::Holder<Root, Struct> holder_;
};

}  // namespace tables
