#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "tables/nearest_name.hpp"
#include "tables/tree.hpp"

namespace tables {

namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments(1);
  for (const char c : path) {
    if (c == '.') {
      segments.emplace_back();
    } else {
      segments.back() += c;
    }
  }
  return segments;
}

/// One setting on its way into the tree.
struct Setting {
  std::string text;  // as given
  std::string path;  // before the equals sign
  std::string value;
};

class Setter {
 public:
  Setter(toml::table& tree, const Setting& setting, const std::vector<TableInfo>& tables,
         Diagnosis& diagnosis)
      : tree_(tree), setting_(setting), tables_(tables), diagnosis_(diagnosis) {
    diagnosis_.place(setting_.path, "--set " + setting_.text);
  }

  void run() {
    const auto segments = segments_of(setting_.path);
    const TableInfo* info = table_of(segments.size() == 1 ? "" : segments.front());
    if (info == nullptr) return unknown_table(segments.front());
    if (segments.size() > 1 && segments.front() == info->former) {
      diagnosis_.warning(setting_.path, "found by its former name",
                         fmt::format("write {}.{}", info->name, segments.back()));
    }
    const std::size_t wanted = info->name.empty() ? 1 : info->repeated ? 3 : 2;
    if (segments.size() < wanted) return wrong_depth(*info);
    std::string key = segments[wanted - 1];  // dotted, of a table within the table
    for (std::size_t k = wanted; k < segments.size(); ++k) key += "." + segments[k];
    const FieldInfo* field = info->find(key);
    if (field == nullptr && segments.size() > wanted && !info->has_within(segments[wanted - 1])) {
      return wrong_depth(*info);
    }
    if (field == nullptr) return unknown_key(*info, key);

    std::size_t index = 0;
    toml::table* table = &tree_;
    if (info->repeated) {
      table = entry_of(*info, segments[1], index);
    } else if (!info->name.empty()) {
      if (!tree_.contains(info->name)) tree_.insert(info->name, toml::table{});
      table = tree_[info->name].as_table();
    }
    // A table of the wrong type is reported when the tree is read.
    if (table != nullptr) store(*table, *info, index, *field);
  }

 private:
  [[nodiscard]] const TableInfo* table_of(std::string_view name) const {
    const auto found = std::find_if(tables_.begin(), tables_.end(),
                                    [&](const TableInfo& table) { return table.is_called(name); });
    return found == tables_.end() ? nullptr : &*found;
  }

  void unknown_table(const std::string& name) {
    std::vector<std::string_view> all;
    for (const TableInfo& table : tables_) {
      if (!table.name.empty()) all.push_back(table.name);
    }
    diagnosis_.error(setting_.path, "no such table", "tables are " + joined(all),
                     nearest_name(name, all));
  }

  void wrong_depth(const TableInfo& info) {
    const std::string form = info.name.empty() ? "table.key=value, or title=\"...\""
                             : info.repeated
                                 ? fmt::format("{0}.0.key=value or {0}.NAME.key=value", info.name)
                                 : fmt::format("{}.key=value", info.name);
    diagnosis_.error(setting_.path, "names no key", "the form is " + form);
  }

  void unknown_key(const TableInfo& info, const std::string& key) {
    if (info.name.empty() && table_of(key) != nullptr) {
      return wrong_depth(*table_of(key));
    }
    std::vector<std::string_view> all;
    for (const FieldInfo& field : info.fields) all.push_back(field.key);
    diagnosis_.error(setting_.path, "no such key",
                     fmt::format("keys of {} are {}", info.title(), joined(all)),
                     nearest_name(key, all));
  }

  toml::table* entry_of(const TableInfo& info, const std::string& selector, std::size_t& index) {
    toml::array* entries = tree_[info.name].as_array();
    const std::size_t count = entries == nullptr ? 0 : entries->size();
    const char* end = selector.data() + selector.size();
    const auto [stop, failure] = std::from_chars(selector.data(), end, index);
    const bool is_number = failure == std::errc{} && stop == end;
    if (is_number && index < count) return (*entries)[index].as_table();
    std::string known;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count; ++i) {
      const toml::table* entry = (*entries)[i].as_table();
      const auto name = entry == nullptr ? std::nullopt : (*entry)["name"].value<std::string>();
      if (name && *name == selector) {
        index = i;
        return (*entries)[i].as_table();
      }
      known += fmt::format("{}{}", known.empty() ? "" : ", ", i);
      if (!name) continue;
      known += fmt::format(" ({})", *name);
      names.push_back(*name);
    }
    diagnosis_.error(setting_.path, fmt::format("no entry {} in {}", selector, info.title()),
                     known.empty() ? "there is none" : "entries are " + known,
                     nearest_name(selector, {names.begin(), names.end()}));
    return nullptr;
  }

  void store(toml::table& table, const TableInfo& info, std::size_t index, const FieldInfo& field) {
    // Later messages speak of the entry by its index.
    diagnosis_.place(info.path(index, field.key), "--set " + setting_.text);
    toml::table parsed = parse_value(field);
    const bool one = parsed.size() == 1 && parsed.contains("value");
    const auto [within, key] = place_within(table, field.key);
    if (within == nullptr) return;  // reported when the tree is read
    if (!one) {
      diagnosis_.error(info.path(index, field.key),
                       fmt::format("found `{}`, which is no TOML value", setting_.value),
                       "allowed is " + field.allowed_text());
      within->erase(key);
      return;
    }
    toml::table* const target = within;
    const std::string name(key);
    std::move(*parsed.get("value")).visit([&](auto&& node) {
      target->insert_or_assign(name, std::forward<decltype(node)>(node));
    });
  }

  // The table in which a dotted key stands, made if it is not there, and what is left of the key;
  // no table where something else has its name.
  static std::pair<toml::table*, std::string_view> place_within(toml::table& table,
                                                                std::string_view key) {
    const std::size_t dot = key.find('.');
    if (dot == std::string_view::npos) return {&table, key};
    const std::string_view name = key.substr(0, dot);
    if (!table.contains(name)) table.insert(name, toml::table{});
    toml::table* within = table.get(name)->as_table();
    if (within == nullptr) return {nullptr, key};
    return place_within(*within, key.substr(dot + 1));
  }

  /// `value = ...` as a TOML document, empty if it is none; a bare word counts as a text where the
  /// key takes texts, because shells eat quotes.
  [[nodiscard]] toml::table parse_value(const FieldInfo& field) const {
    if (line_of_endless_key(setting_.value) != 0) return {};
    try {
      return toml::parse("value = " + setting_.value);
    } catch (const toml::parse_error&) {
      const bool takes_text = field.kind == ValueKind::text || field.kind == ValueKind::choice ||
                              field.kind == ValueKind::texts || field.kind == ValueKind::choices;
      const bool bare = setting_.value.find_first_of("\"'[]{}\n\r=#") == std::string::npos &&
                        !setting_.value.empty();
      if (takes_text && bare) return toml::table{{"value", setting_.value}};
      return {};
    }
  }

  toml::table& tree_;
  const Setting& setting_;
  const std::vector<TableInfo>& tables_;
  Diagnosis& diagnosis_;
};

}  // namespace

void apply_settings(toml::table& tree, std::span<const std::string> settings,
                    const std::vector<TableInfo>& tables, Diagnosis& diagnosis) {
  for (const std::string& text : settings) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || trimmed(text.substr(0, equals)).empty()) {
      diagnosis.place(text, "--set " + text);
      diagnosis.error(text, "names no key and value", "the form is table.key=value");
      continue;
    }
    const Setting setting{text, std::string(trimmed(std::string_view(text).substr(0, equals))),
                          std::string(trimmed(std::string_view(text).substr(equals + 1)))};
    Setter(tree, setting, tables, diagnosis).run();
  }
}

}  // namespace tables
