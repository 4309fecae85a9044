#pragma once

// Private to this folder: the only header of the project that sees toml++.

#include <toml++/toml.h>

#include <span>
#include <string>
#include <string_view>

#include "tables/diagnosis.hpp"
#include "tables/table.hpp"

namespace tables {

/// Reads a TOML value of any kind as `field` wants it; reports under `key` if it is not allowed.
[[nodiscard]] std::optional<Value> convert(const toml::node& node, const FieldInfo& field,
                                           const std::string& key, Diagnosis& diagnosis);

/// Likewise a number that may change from place to place.
[[nodiscard]] std::optional<Value> convert_varying(const toml::node& node, const FieldInfo& field,
                                                   const std::string& key, Diagnosis& diagnosis);

/// The node of a key that may be dotted, one of a table within the table; none if it is not there.
[[nodiscard]] const toml::node* node_at(const toml::table& table, std::string_view key);

/// A short description of a value for messages: `the text "abc"`, `-0.01`, `a table`.
[[nodiscard]] std::string describe(const toml::node& node);

/// The line of TOML text where a dotted key has more parts than any table here, and than a parser
/// that nests a table for each can stand; 0 if there is none.
[[nodiscard]] std::size_t line_of_endless_key(std::string_view text);

/// Puts `key=value` settings into the tree; places and complaints name `--set key=value`.
void apply_settings(toml::table& tree, std::span<const std::string> settings,
                    const std::vector<TableInfo>& tables, Diagnosis& diagnosis);

}  // namespace tables
