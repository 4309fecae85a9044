#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tables/table.hpp"

namespace tables {

/// The way to and from a member, somewhere in a Root.
template <class Root>
class Access {
 public:
  virtual ~Access() = default;
  [[nodiscard]] virtual std::optional<Value> read(const Root& root, std::size_t entry) const = 0;
  virtual void write(Root& root, std::size_t entry, const Value& value) const = 0;
};

/// One key of one table: its description and the way to and from a Root.
template <class Root>
struct Field : FieldInfo {
  std::shared_ptr<const Access<Root>> access;

  /// The value of an entry (0 for a single table), or nothing if absent.
  [[nodiscard]] std::optional<Value> read(const Root& root, std::size_t entry) const {
    return access->read(root, entry);
  }
  /// Stores a value whose alternative is the kind's and which `kind`, range and choices allow.
  void write(Root& root, std::size_t entry, const Value& value) const {
    access->write(root, entry, value);
  }
};

/// The entries of a repeated table.
template <class Root>
class Entries {
 public:
  virtual ~Entries() = default;
  [[nodiscard]] virtual std::size_t count(const Root& root) const = 0;
  virtual void resize(Root& root, std::size_t count) const = 0;
};

/// One table of a Root.
template <class Root>
struct Table : TableOf<Field<Root>> {
  std::shared_ptr<const Entries<Root>> entries;  // none for a single table

  /// How many entries there are; 1 for a single table.
  [[nodiscard]] std::size_t size(const Root& root) const {
    return entries ? entries->count(root) : 1;
  }
  /// Nothing for a single table.
  void resize(Root& root, std::size_t count) const {
    if (entries) entries->resize(root, count);
  }
};

/// What the tables of a Root say, without it.
template <class Root>
std::vector<TableInfo> descriptions_of(const std::vector<Table<Root>>& tables) {
  std::vector<TableInfo> all;
  for (const Table<Root>& table : tables) {
    all.push_back(
        {static_cast<const TableHead&>(table), {table.fields.begin(), table.fields.end()}});
  }
  return all;
}

}  // namespace tables
