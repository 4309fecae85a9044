#include "study/quantity.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "files/durable_file.hpp"
#include "program/command_line.hpp"
#include "scene/box.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "tables/nearest_name.hpp"

namespace study {

namespace {

constexpr std::string_view measured =
    "fpm_study";  // name of the measure that a field at a point needs

constexpr std::array<std::pair<std::string_view, double>, 12> units{{{"_N_per_m", 1.0},
                                                                     {"_kN_per_m", 1e3},
                                                                     {"_MPa", 1e6},
                                                                     {"_kPa", 1e3},
                                                                     {"_Pa", 1.0},
                                                                     {"_kN", 1e3},
                                                                     {"_N", 1.0},
                                                                     {"_mm", 1e-3},
                                                                     {"_cm", 1e-2},
                                                                     {"_m", 1.0},
                                                                     {"_s", 1.0},
                                                                     {"", 1.0}}};

std::string_view stem_of(std::string_view name) {
  const auto* unit =
      std::ranges::find_if(units, [&](const auto& one) { return name.ends_with(one.first); });
  return name.substr(0, name.size() - unit->first.size());
}

double unit_of(std::string_view name) {
  return std::ranges::find_if(units, [&](const auto& one) { return name.ends_with(one.first); })
      ->second;
}

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (failure != std::errc{} || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw program::UsageError(
      fmt::format("--quantity {}: {}; the forms are COLUMN, max(COLUMN), COLUMN@COLUMN=VALUE and "
                  "FIELD@X,Y, as pressure, max(mean_pressure_Pa), pressure@d/B=0.05, "
                  "displacement_y@0.5,1.0",
                  text, why));
}

/// The column of the measure that a field at a point is read from.
std::string column_of_field(std::string_view field, std::string_view component) {
  if (field == "displacement") return fmt::format("{}_u{}_m", measured, component);
  if (field == "stress") return fmt::format("{}_s{}_Pa", measured, component);
  return fmt::format("{}_plastic_strain", measured);
}

Quantity field_at(Quantity quantity, std::string_view left, std::string_view right) {
  static const std::map<std::string, std::vector<std::string>, std::less<>> fields{
      {"displacement", {"x", "y", "z"}},
      {"stress", {"xx", "yy", "zz", "xy", "yz", "zx"}},
      {"plastic_strain", {""}}};
  for (const auto& [field, components] : fields) {
    for (const std::string& component : components) {
      if (left != (component.empty() ? field : field + "_" + component)) continue;
      quantity.field = field;
      quantity.column = column_of_field(field, component);
      for (const std::string& part : split(right, ',')) {
        const auto coordinate = number_of(part);
        if (!coordinate) refuse(quantity.text, fmt::format("\"{}\" is no coordinate", part));
        quantity.point.push_back(*coordinate);
      }
      return quantity;
    }
  }
  refuse(quantity.text, fmt::format("\"{}\" is no component of displacement, stress or "
                                    "plastic_strain",
                                    left));
}

Quantity at_value(Quantity quantity, std::string_view right) {
  const std::size_t equals = right.rfind('=');
  const auto value = number_of(right.substr(equals + 1));
  if (!value) refuse(quantity.text, fmt::format("\"{}\" is no number", right.substr(equals + 1)));
  quantity.kind = Quantity::Kind::at;
  quantity.at_column = right.substr(0, equals);
  quantity.at = *value;
  if (quantity.at_column.empty()) refuse(quantity.text, "names no column before the =");
  return quantity;
}

}  // namespace

Columns read_columns(const std::filesystem::path& file) {
  Columns table;
  std::size_t number = 0;
  for (std::string line : split(files::read_text(file), '\n')) {
    ++number;
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty() || line.starts_with('#')) continue;
    const std::vector<std::string> parts = split(line, ',');
    if (table.names.empty()) {
      table.names = parts;
      table.values.resize(parts.size());
      continue;
    }
    if (parts.size() != table.names.size()) {
      throw files::FileError(file, fmt::format("line {}: {} values under {} names", number,
                                               parts.size(), table.names.size()));
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      double value = 0.0;
      const char* end = parts[i].data() + parts[i].size();
      const auto [stop, failure] = std::from_chars(parts[i].data(), end, value);
      if (failure != std::errc{} || stop != end) {
        throw files::FileError(file, fmt::format("line {}: \"{}\" is no number", number, parts[i]));
      }
      table.values[i].push_back(value);
    }
  }
  if (table.values.empty() || table.values[0].empty()) {
    throw files::FileError(file, "has no line of numbers under a line of names");
  }
  return table;
}

Quantity parse_quantity(const std::string& text) {
  Quantity quantity;
  quantity.text = text;
  const std::size_t at = text.find('@');
  const std::string left = text.substr(0, at);
  if (left.empty()) refuse(text, "names no column");
  if (at != std::string::npos) {
    const std::string right = text.substr(at + 1);
    quantity.column = left;
    return right.find('=') == std::string::npos ? field_at(quantity, left, right)
                                                : at_value(quantity, right);
  }
  if (left.starts_with("max(") && left.ends_with(")")) {
    quantity.kind = Quantity::Kind::largest;
    quantity.column = left.substr(4, left.size() - 5);
    return quantity;
  }
  quantity.column = left;
  return quantity;
}

void check_quantity(const scene::Scene& scene, const Quantity& quantity) {
  if (quantity.field.empty()) return;
  const scene::Geometry& body = scene.geometry;
  const auto refuse_it = [&](const std::string& why) {
    throw program::UsageError(fmt::format("--quantity {}: {}", quantity.text, why));
  };
  const std::string_view what = std::string_view(quantity.text).substr(0, quantity.text.find('@'));
  constexpr std::array<std::string_view, 3> of_space{"displacement_z", "stress_yz", "stress_zx"};
  if (body.dimension == 2 && std::ranges::find(of_space, what) != of_space.end()) {
    refuse_it("the body is a plane one, and has no such component");
  }
  if (quantity.point.size() != body.min.size()) {
    refuse_it(
        fmt::format("found {} coordinates; needed are {}", quantity.point.size(), body.min.size()));
  }
  const double slack = scene::same_place(body);
  for (std::size_t axis = 0; axis < body.min.size(); ++axis) {
    const double at = quantity.point[axis];
    if (at >= body.min[axis] - slack && at <= body.max[axis] + slack) continue;
    refuse_it(fmt::format("found {} along {}; the body is from {} to {}", at,
                          std::string_view("xyz").substr(axis, 1), body.min[axis], body.max[axis]));
  }
}

scene::Scene with_measure(const scene::Scene& scene, const Quantity& quantity) {
  scene::Scene measuring = scene;
  if (quantity.field.empty()) return measuring;
  // What the curve shows of itself while the scene measures nothing is kept.
  measuring.measure = scene::resolve_measures(scene);
  scene::Measure measure;
  measure.name = measured;
  measure.kind = quantity.field == "displacement" ? scene::MeasureKind::displacement
                 : quantity.field == "stress"     ? scene::MeasureKind::stress
                                                  : scene::MeasureKind::plastic_strain;
  measure.at = quantity.point;
  measuring.measure.push_back(measure);
  return measuring;
}

std::string column_meant(const std::vector<std::string>& names, std::string_view wanted) {
  const auto has = [&](std::string_view name) { return std::ranges::find(names, name); };
  if (const auto found = has(wanted); found != names.end()) return *found;
  if (wanted == "d/B") wanted = "settlement_over_B";
  const std::string_view stem = stem_of(wanted);
  const std::string_view mean = "mean_";
  for (const std::string& name : names) {
    if (stem_of(name) == stem) return name;
  }
  for (const std::string& name : names) {  // pressure and mean_pressure_Pa, in either direction
    const std::string_view other = stem_of(name);
    if (other.starts_with(mean) && other.substr(mean.size()) == stem) return name;
    if (stem.starts_with(mean) && stem.substr(mean.size()) == other) return name;
  }
  return "";
}

double units_between(std::string_view from, std::string_view to) {
  return unit_of(from) / unit_of(to);
}

Reading value_in(const Columns& table, const Quantity& quantity) {
  const auto values_of = [&](const std::string& wanted) -> const std::vector<double>* {
    const auto found = std::ranges::find(table.names, column_meant(table.names, wanted));
    return found == table.names.end()
               ? nullptr
               : &table.values[static_cast<std::size_t>(found - table.names.begin())];
  };
  const auto none = [&](const std::string& wanted) {
    const std::vector<std::string_view> names(table.names.begin(), table.names.end());
    const std::string nearest = tables::nearest_name(wanted, names);
    return Reading{{},
                   fmt::format("there is no column {}{}; columns are {}", wanted,
                               nearest.empty() ? "" : " (did you mean \"" + nearest + "\"?)",
                               fmt::join(table.names, ", ")),
                   true};
  };
  const std::vector<double>* values = values_of(quantity.column);
  if (values == nullptr) return none(quantity.column);
  if (quantity.kind == Quantity::Kind::last) return {values->back(), ""};
  if (quantity.kind == Quantity::Kind::largest) return {*std::ranges::max_element(*values), ""};
  const std::vector<double>* at = values_of(quantity.at_column);
  if (at == nullptr) return none(quantity.at_column);
  for (std::size_t i = 0; i < at->size(); ++i) {
    if ((*at)[i] == quantity.at) return {(*values)[i], ""};
    if (i == 0) continue;
    const double before = (*at)[i - 1] - quantity.at, after = (*at)[i] - quantity.at;
    if (before * after >= 0.0) continue;
    const double share = before / (before - after);
    return {(*values)[i - 1] + share * ((*values)[i] - (*values)[i - 1]), ""};
  }
  return {{}, fmt::format("{} does not come to {}", quantity.at_column, quantity.at)};
}

}  // namespace study
