#include "tables/reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tables/nearest_name.hpp"
#include "tables/tree.hpp"

namespace tables {

namespace {

std::string place_of(const toml::source_region& region, const std::string& source) {
  return fmt::format("{}:{}:{}", source, region.begin.line, region.begin.column);
}

/// Gives tables that are written under their former name the one they have now.
void rename_tables(toml::table& tree, const std::vector<TableInfo>& tables, Diagnosis& diagnosis) {
  for (const TableInfo& info : tables) {
    const toml::node* node = info.former.empty() ? nullptr : tree.get(info.former);
    if (node == nullptr) continue;
    const std::string former(info.former);
    diagnosis.place(former, place_of(node->source(), diagnosis.source()));
    if (tree.contains(info.name)) {
      diagnosis.error(former, fmt::format("found beside {}", info.title()),
                      fmt::format("it is the former name of {}: keep one", info.name));
    } else {
      diagnosis.warning(former, "found by its former name", "write " + info.title());
      node->visit([&](const auto& value) { tree.insert(info.name, value); });
    }
    tree.erase(former);
  }
}

}  // namespace

const toml::node* node_at(const toml::table& table, std::string_view key) {
  const std::size_t dot = key.find('.');
  const toml::node* node = table.get(key.substr(0, dot));
  if (dot == std::string_view::npos || node == nullptr) return node;
  const toml::table* within = node->as_table();
  return within == nullptr ? nullptr : node_at(*within, key.substr(dot + 1));
}

namespace {

/// Walks the tree along the list of tables.
class Walker {
 public:
  Walker(const toml::table& tree, const std::vector<TableInfo>& tables, const TableSink& sink,
         Diagnosis& diagnosis)
      : tree_(tree), tables_(tables), sink_(sink), diagnosis_(diagnosis) {}

  void walk() {
    refuse_unknown_names();
    for (const TableInfo& info : tables_) {
      if (info.name.empty()) {
        read_entry(info, 0, tree_);
      } else if (const toml::node* node = tree_.get(info.name)) {
        place(std::string(info.name), *node);
        info.repeated ? read_repeated(info, *node) : read_single(info, *node);
      } else if (info.required) {
        diagnosis_.error(std::string(info.name), "table is missing",
                         "a scene needs " + info.title());
      }
    }
  }

 private:
  /// A node, or the key of an unknown name, was written here.
  template <class NodeOrKey>
  void place(const std::string& key, const NodeOrKey& written) {
    if (diagnosis_.given(key)) return;  // by a setting
    diagnosis_.place(key, place_of(written.source(), diagnosis_.source()));
  }

  void refuse_unknown_names() {
    std::vector<std::string_view> all;
    for (const TableInfo& info : tables_) {
      if (!info.name.empty()) all.push_back(info.name);
      if (!info.name.empty()) continue;
      for (const FieldInfo& field : info.fields) all.push_back(field.key);
    }
    for (const auto& [key, node] : tree_) {
      const std::string name(key.str());
      if (std::find(all.begin(), all.end(), name) != all.end()) continue;
      place(name, key);
      diagnosis_.error(
          name, node.is_table() || node.is_array_of_tables() ? "no such table" : "no such key",
          "allowed at the top level are " + joined(all), nearest_name(name, all));
    }
  }

  void read_single(const TableInfo& info, const toml::node& node) {
    if (const toml::table* table = node.as_table()) {
      read_entry(info, 0, *table);
      return;
    }
    diagnosis_.error(std::string(info.name), "found " + describe(node),
                     fmt::format("this is one table, written {}", info.title()));
  }

  void read_repeated(const TableInfo& info, const toml::node& node) {
    const toml::array* entries = node.as_array();
    const bool empty = entries != nullptr && entries->empty();
    if (entries == nullptr || !(empty || entries->is_array_of_tables())) {
      diagnosis_.error(std::string(info.name), "found " + describe(node),
                       fmt::format("each entry is written {}", info.title()));
      return;
    }
    if (empty && info.required) {
      diagnosis_.error(std::string(info.name), "list is empty", "a scene needs " + info.title());
    }
    sink_.resize(number_of(info), entries->size());
    for (std::size_t i = 0; i < entries->size(); ++i) {
      place(info.path(i, ""), (*entries)[i]);
      read_entry(info, i, *(*entries)[i].as_table());
    }
  }

  [[nodiscard]] std::size_t number_of(const TableInfo& info) const {
    return static_cast<std::size_t>(&info - tables_.data());
  }

  void read_entry(const TableInfo& info, std::size_t index, const toml::table& table) {
    for (std::size_t number = 0; number < info.fields.size(); ++number) {
      const FieldInfo& field = info.fields[number];
      const std::string path = info.path(index, field.key);
      const toml::node* node = node_at(table, field.key);
      if (node != nullptr) {
        place(path, *node);
        if (const auto value = convert(*node, field, path, diagnosis_)) {
          sink_.write(number_of(info), index, number, *value);
        }
      } else if (field.notes.need == Need::required && diagnosis_.good({path})) {
        diagnosis_.error(path, "is missing", "needed is " + field.allowed_text());
      }
    }
    if (!info.name.empty()) refuse_unknown_keys(info, index, "", table);
  }

  // @param within  the dotted name of a table within the entry, with a dot at its end; else ""
  void refuse_unknown_keys(const TableInfo& info, std::size_t index, const std::string& within,
                           const toml::table& table) {
    std::vector<std::string_view> all;
    for (const FieldInfo& field : info.fields) all.push_back(field.key);
    for (const auto& entry : table) {
      const toml::key& key = entry.first;
      const std::string name = within + std::string(key.str());
      if (info.find(name) != nullptr) continue;
      const std::string path = info.path(index, name);
      place(path, key);
      if (info.has_within(name)) {
        if (const toml::table* inner = entry.second.as_table()) {
          refuse_unknown_keys(info, index, name + ".", *inner);
        } else {
          diagnosis_.error(path, "found " + describe(entry.second),
                           fmt::format("this is a table within {}", info.title()));
        }
        continue;
      }
      std::string nearest = nearest_name(name, all);
      if (nearest.empty()) nearest = in_another_table(name);
      diagnosis_.error(path, "no such key",
                       fmt::format("keys of {} are {}", info.title(), joined(all)), nearest);
    }
  }

  /// `geometry.spacing` if the key exists in some other table.
  [[nodiscard]] std::string in_another_table(const std::string& key) const {
    for (const TableInfo& info : tables_) {
      if (!info.name.empty() && info.find(key) != nullptr) {
        return fmt::format("{}.{}", info.name, key);
      }
    }
    return "";
  }

  const toml::table& tree_;
  const std::vector<TableInfo>& tables_;
  const TableSink& sink_;
  Diagnosis& diagnosis_;
};

}  // namespace

std::optional<Complaint> read_tables(std::string_view text, std::span<const std::string> settings,
                                     const std::vector<TableInfo>& tables, const TableSink& sink,
                                     Diagnosis& diagnosis) {
  if (const std::size_t line = line_of_endless_key(text); line != 0) {
    return Complaint{fmt::format("{}:{}", diagnosis.source(), line), "", "a key of too many parts",
                     "the deepest key has four, as in stage.0.drive.kind", ""};
  }
  toml::table tree;
  try {
    tree = toml::parse(text, diagnosis.source());
  } catch (const toml::parse_error& failure) {
    return Complaint{place_of(failure.source(), diagnosis.source()), "",
                     "not TOML: " + std::string(failure.description()), "", ""};
  }
  rename_tables(tree, tables, diagnosis);
  apply_settings(tree, settings, tables, diagnosis);
  Walker(tree, tables, sink, diagnosis).walk();
  return std::nullopt;
}

bool has_table(std::string_view text, std::string_view name) {
  if (line_of_endless_key(text) != 0) return false;
  try {
    return toml::parse(text).contains(name);
  } catch (const toml::parse_error&) {
    return false;
  }
}

}  // namespace tables
