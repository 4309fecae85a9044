#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tables/diagnosis.hpp"
#include "tables/field.hpp"
#include "tables/table.hpp"

namespace tables {

/// Takes what is read along a list of tables; tables and fields go by their numbers in it.
struct TableSink {
  /// A repeated table has so many entries.
  std::function<void(std::size_t table, std::size_t count)> resize;
  /// The value of a key that was given, of the kind and in the range its field allows.
  std::function<void(std::size_t table, std::size_t entry, std::size_t field, const Value& value)>
      write;
};

/// Reads TOML text along a list of tables, settings (`--set`) applied first. Unknown and missing
/// names and values that are not allowed become errors of the diagnosis, which also learns where
/// each key was written.
/// @return the complaint if the text is no TOML; nothing else was read then.
[[nodiscard]] std::optional<Complaint> read_tables(std::string_view text,
                                                   std::span<const std::string> settings,
                                                   const std::vector<TableInfo>& tables,
                                                   const TableSink& sink, Diagnosis& diagnosis);

/// The same into `root`, whose members keep their values where the text has no key.
template <class Root>
[[nodiscard]] std::optional<Complaint> read_tables(std::string_view text,
                                                   std::span<const std::string> settings,
                                                   const std::vector<Table<Root>>& tables,
                                                   Root& root, Diagnosis& diagnosis) {
  const TableSink sink{
      [&](std::size_t table, std::size_t count) { tables[table].resize(root, count); },
      [&](std::size_t table, std::size_t entry, std::size_t field, const Value& value) {
        tables[table].fields[field].write(root, entry, value);
      }};
  const std::vector<TableInfo> described = descriptions_of(tables);
  return read_tables(text, settings, described, sink, diagnosis);
}

/// Whether TOML text has something of this name at its top level; false if it is no TOML.
[[nodiscard]] bool has_table(std::string_view text, std::string_view name);

}  // namespace tables
