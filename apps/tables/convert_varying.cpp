#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tables/sample_text.hpp"
#include "tables/tree.hpp"

namespace tables {
namespace {

// Names of the keys of a form; the first one tells which it is.
struct Form {
  std::string_view name;
  std::vector<std::string_view> keys;
  std::string_view shown;
};

const std::vector<Form>& forms() {
  static const std::vector<Form> all{
      {"table",
       {"table", "along", "below", "factor"},
       "{ along = \"x\" or \"y\", table = [[coordinate, value], ...] or a file } or "
       "{ below = level, table = [[depth, value], ...] or a file }"},
      {"raster",
       {"raster", "lower", "step", "nearest", "factor"},
       "{ raster = a file } or { raster = [[values from left to right], ... from top to bottom], "
       "lower = [x, y] of the lowest, leftmost value, step = [dx, dy] }, and nearest = true if "
       "there is one value in each cell"},
      {"points", {"points", "factor"}, "{ points = [[x, y, value], ...] or a file }"}};
  return all;
}

class Reader {
 public:
  Reader(const FieldInfo& field, const std::string& key, Diagnosis& diagnosis)
      : field_(field), key_(key), diagnosis_(diagnosis) {}

  std::optional<Value> read(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) {
      const auto value = number(node);
      return value && in_range(*value, node) ? std::optional<Value>(VaryingNumber(*value))
                                             : std::nullopt;
    }
    for (const Form& form : forms()) {
      if (table->contains(form.name)) return read_samples(*table, form);
    }
    return read_linear(*table);
  }

 private:
  std::nullopt_t refuse(const std::string& found, const std::string& allowed) {
    diagnosis_.error(key_, found, "allowed is " + allowed);
    return std::nullopt;
  }
  std::nullopt_t refuse(const toml::node& node) {
    return refuse("found " + describe(node), field_.allowed_text());
  }

  std::optional<double> number(const toml::node& node) {
    const auto value = node.value<double>();
    if (!value || !(node.is_integer() || node.is_floating_point()) || !std::isfinite(*value)) {
      return refuse(node);
    }
    return value;
  }

  bool in_range(double value, const toml::node& node) {
    if (!field_.notes.range.holds(value)) refuse(node);
    return field_.notes.range.holds(value);
  }

  // So many numbers.
  template <std::size_t Count>
  std::optional<std::array<double, Count>> numbers(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (list == nullptr || list->size() != Count) return refuse(node);
    std::array<double, Count> all{};
    for (std::size_t i = 0; i < Count; ++i) {
      const auto one = number((*list)[i]);
      if (!one) return std::nullopt;
      all[i] = *one;
    }
    return all;
  }

  std::optional<Value> read_linear(const toml::table& table) {
    for (const auto& entry : table) {
      const std::string_view name = entry.first.str();
      if (name == "value" || name == "at" || name == "gradient") continue;
      return refuse(fmt::format("no such key in it: {}", name), field_.allowed_text());
    }
    const toml::node* value = table.get("value");
    const toml::node *at = table.get("at"), *gradient = table.get("gradient");
    if (value == nullptr || at == nullptr || gradient == nullptr) {
      return refuse("value, at and gradient are wanted together", field_.allowed_text());
    }
    const auto start = number(*value);
    if (!start || !in_range(*start, *value)) return std::nullopt;
    const auto place = numbers<2>(*at), growth = numbers<2>(*gradient);
    if (!place || !growth) return std::nullopt;
    return Value(VaryingNumber(*start, *place, *growth));
  }

  std::optional<Value> read_samples(const toml::table& table, const Form& form) {
    form_ = &form;
    for (const auto& entry : table) {
      const std::string_view name = entry.first.str();
      if (std::ranges::count(form.keys, name) > 0) continue;
      return refuse(fmt::format("no such key in it: {}", name), std::string(form.shown));
    }
    SampleFile file;
    if (!read_frame(table, file)) return std::nullopt;
    const toml::node& told = *table.get(form.name);
    if (const auto name = told.value_exact<std::string>()) {
      if (table.contains("lower") || table.contains("step")) {
        return refuse("found lower or step beside a file", std::string(form.shown));
      }
      file.name = *name;
      VaryingNumber number;
      number.file = std::move(file);
      return Value(std::move(number));
    }
    const toml::array* list = told.as_array();
    if (list == nullptr || list->empty()) {
      return refuse("found " + describe(told), std::string(form.shown));
    }
    auto samples = file.kind == Samples::Kind::table    ? read_table(*list, file)
                   : file.kind == Samples::Kind::raster ? read_raster(*list, table)
                                                        : read_points(*list);
    if (!samples) return std::nullopt;
    samples->nearest = file.nearest;
    for (double& value : samples->values) value *= file.factor;
    if (const std::string found = objection(*samples, field_.notes.range); !found.empty()) {
      return refuse(found, field_.allowed_text());
    }
    return Value(VaryingNumber(std::move(*samples)));
  }

  // What is beside the samples.
  bool read_frame(const toml::table& table, SampleFile& file) {
    file.kind = static_cast<Samples::Kind>(form_ - forms().data());
    if (const toml::node* factor = table.get("factor")) {
      const auto value = number(*factor);
      if (!value) return false;
      file.factor = *value;
    }
    if (const toml::node* nearest = table.get("nearest")) {
      const auto value = nearest->value_exact<bool>();
      if (!value) {
        refuse("found nearest = " + describe(*nearest), std::string(form_->shown));
        return false;
      }
      file.nearest = *value;
    }
    if (file.kind != Samples::Kind::table) return true;
    const toml::node *along = table.get("along"), *below = table.get("below");
    if ((along == nullptr) == (below == nullptr)) {
      refuse(along == nullptr ? "found neither along nor below" : "found along and below",
             std::string(form_->shown));
      return false;
    }
    if (below != nullptr) {
      file.below = number(*below);
      return file.below.has_value();
    }
    const auto name = along->value_exact<std::string>();
    if (!name || (*name != "x" && *name != "y")) {
      refuse("found along = " + describe(*along), std::string(form_->shown));
      return false;
    }
    file.axis = *name == "x" ? 0 : 1;
    return true;
  }

  std::optional<Samples> read_table(const toml::array& list, const SampleFile& file) {
    std::vector<std::array<double, 2>> pairs;
    for (const toml::node& entry : list) {
      const auto pair = numbers<2>(entry);
      if (!pair) return std::nullopt;
      pairs.push_back(*pair);
    }
    return table_samples(std::move(pairs), file.axis, file.below);
  }

  std::optional<Samples> read_points(const toml::array& list) {
    std::vector<std::array<double, 3>> points;
    for (const toml::node& entry : list) {
      const auto point = numbers<3>(entry);
      if (!point) return std::nullopt;
      points.push_back(*point);
    }
    return point_samples(std::move(points));
  }

  std::optional<Samples> read_raster(const toml::array& list, const toml::table& table) {
    const toml::node *lower = table.get("lower"), *step = table.get("step");
    if (lower == nullptr || step == nullptr) {
      return refuse("found a raster without lower or step", std::string(form_->shown));
    }
    const auto place = numbers<2>(*lower), widths = numbers<2>(*step);
    if (!place || !widths) return std::nullopt;
    if ((*widths)[0] <= 0.0 || (*widths)[1] <= 0.0) {
      return refuse("found step = " + describe(*step), "a step of more than zero along x and y");
    }
    Samples raster;
    raster.kind = Samples::Kind::raster;
    raster.lower = *place;
    raster.step = *widths;
    for (std::size_t row = list.size(); row > 0; --row) {  // from below
      const toml::array* values = list[row - 1].as_array();
      if (values == nullptr || values->empty()) return refuse(list[row - 1]);
      if (raster.columns > 0 && values->size() != raster.columns) {
        return refuse(fmt::format("found {} values in row {}, and {} in others", values->size(),
                                  row, raster.columns),
                      "as many in every row");
      }
      raster.columns = values->size();
      for (const toml::node& value : *values) {
        const auto one = number(value);
        if (!one) return std::nullopt;
        raster.values.push_back(*one);
      }
    }
    return raster;
  }

  const FieldInfo& field_;
  const std::string& key_;
  Diagnosis& diagnosis_;
  const Form* form_ = nullptr;
};

}  // namespace

std::optional<Value> convert_varying(const toml::node& node, const FieldInfo& field,
                                     const std::string& key, Diagnosis& diagnosis) {
  return Reader(field, key, diagnosis).read(node);
}

}  // namespace tables
