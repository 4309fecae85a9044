#include "record/lineage.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>
#include <stdexcept>

namespace record {

namespace {

constexpr std::string_view table_name = "ancestor";

template <class T>
T value_at(const toml::table& table, std::string_view key) {
  const std::optional<T> value = table[key].value<T>();
  if (!value) throw std::invalid_argument(fmt::format("an ancestor has no {}", key));
  return *value;
}

Ancestor parsed(const toml::table& table) {
  Ancestor ancestor;
  ancestor.checkpoint = value_at<std::string>(table, "checkpoint");
  ancestor.step = value_at<std::int64_t>(table, "step");
  ancestor.created = value_at<std::string>(table, "created");
  ancestor.identity = value_at<std::string>(table, "identity");
  if (const toml::array* changes = table["changed"].as_array()) {
    for (const toml::node& change : *changes) {
      ancestor.changed.push_back(change.value_or<std::string>(""));
    }
  }
  return ancestor;
}

}  // namespace

std::string lineage_text(const std::vector<Ancestor>& ancestors) {
  toml::array list;
  for (const Ancestor& ancestor : ancestors) {
    toml::array changed;
    for (const std::string& change : ancestor.changed) changed.push_back(change);
    list.push_back(toml::table{{"checkpoint", ancestor.checkpoint},
                               {"step", ancestor.step},
                               {"created", ancestor.created},
                               {"identity", ancestor.identity},
                               {"changed", std::move(changed)}});
  }
  if (list.empty()) return "";
  std::ostringstream text;
  text << toml::table{{table_name, std::move(list)}};
  return text.str();
}

std::vector<Ancestor> parse_lineage(std::string_view text) {
  std::vector<Ancestor> ancestors;
  try {
    const toml::table tree = toml::parse(text);
    const toml::node* list = tree.get(table_name);
    if (list == nullptr) return ancestors;
    if (!list->is_array_of_tables()) {
      throw std::invalid_argument(fmt::format("{} is no list of tables", table_name));
    }
    for (const toml::node& node : *list->as_array()) ancestors.push_back(parsed(*node.as_table()));
  } catch (const toml::parse_error& failure) {
    throw std::invalid_argument(std::string(failure.description()));
  }
  return ancestors;
}

std::string identity_of(std::int64_t digest) {
  return fmt::format("{:016x}", static_cast<std::uint64_t>(digest));
}

}  // namespace record
