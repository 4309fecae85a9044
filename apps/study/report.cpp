#include "study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "picture/picture.hpp"

namespace study {

using nlohmann::json;

namespace {

/// Errors are shown as parts of the reference, unless it is 0.
double relative_to(const Reference& reference) {
  return reference.value == 0.0 ? 1.0 : std::abs(reference.value);
}

std::string error_text(double error, const Reference& reference) {
  return reference.value == 0.0
             ? fmt::format("{:+.3g}", error)
             : fmt::format("{:+.3f} %", 100.0 * error / std::abs(reference.value));
}

std::string memory_text(std::int64_t bytes) {
  constexpr double mebi = 1024.0 * 1024.0;
  return fmt::format("{:.0f} MiB", static_cast<double>(bytes) / mebi);
}

/// In a CSV line a text with a comma or quotes is quoted.
std::string cell(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string order_line(const Order& order, const Reference& reference) {
  const convergence::Extrapolation& found = order.extrapolation;
  std::string line =
      fmt::format("  {}{}: {}", order.key, order.others.empty() ? "" : " at " + order.others,
                  convergence::name_of(found.course));
  if (found.order) line += fmt::format(", order {:.2f}", *found.order);
  if (found.order_error) line += fmt::format(" +- {:.2f}", *found.order_error);
  line +=
      fmt::format(", limit {:.6g}, the finest value within {:.2g}", found.limit, found.uncertainty);
  if (reference.value != 0.0) {
    line += fmt::format(" ({:.2f} %)", 100.0 * found.uncertainty / std::abs(reference.value));
  }
  if (order.slope) {
    line += fmt::format("; errors fall with order {:.2f}", order.slope->order);
    if (order.slope->standard_error)
      line += fmt::format(" +- {:.2f}", *order.slope->standard_error);
  }
  return line + "\n";
}

template <class Value>
json or_null(const std::optional<Value>& value) {
  return value ? json(*value) : json(nullptr);
}

json json_of(const Result& result, const std::vector<Vary>& varied) {
  json settings = json::object();
  for (std::size_t k = 0; k < varied.size(); ++k) {
    settings[varied[k].key] = varied[k].values[result.combination[k]];
  }
  json one = {{"settings", settings},
              {"digest", result.digest},
              {"exit_code", or_null(result.exit_code)},
              {"value", or_null(result.value)},
              {"error", or_null(result.error)},
              {"obstacle", result.obstacle},
              {"steps", result.steps},
              {"evaluations", result.evaluations},
              {"peak_bytes", result.cost.peak_bytes},
              {"on_front", result.on_front}};
  one["wall_s"] = result.cost.complete ? json(result.cost.wall) : json(nullptr);
  one["cpu_s"] = result.cost.complete ? json(result.cost.cpu) : json(nullptr);
  return one;
}

}  // namespace

std::string table_text(const Findings& findings) {
  std::size_t width = 3;
  for (const Result& result : findings.results) width = std::max(width, result.words.size());
  std::string out = fmt::format("{}, reference {:.8g} +- {:.2g} ({})\n", findings.quantity.text,
                                findings.reference.value, findings.reference.uncertainty,
                                findings.reference.words);
  fmt::format_to(std::back_inserter(out), "{:<{}}  {:>12}  {:>10}  {:>9}  {:>9}  {:>11}  {:>8}\n",
                 "run", width, "value", "error", "cpu [s]", "wall [s]", "evaluations", "memory");
  for (const Result& result : findings.results) {
    const bool known = result.cost.complete;
    std::string line = fmt::format(
        "{:<{}}  {:>12}  {:>10}  {:>9}  {:>9}  {:>11}  {:>8}  {}", result.words, width,
        result.value ? fmt::format("{:.7g}", *result.value) : "-",
        result.error ? error_text(*result.error, findings.reference) : "-",
        known ? fmt::format("{:.2f}", result.cost.cpu) : "-",
        known ? fmt::format("{:.2f}", result.cost.wall) : "-", result.evaluations,
        memory_text(result.cost.peak_bytes), result.on_front ? "front" : result.obstacle);
    line.resize(line.find_last_not_of(' ') + 1);
    out += line + "\n";
  }
  if (!findings.orders.empty()) out += "orders\n";
  for (const Order& order : findings.orders) out += order_line(order, findings.reference);
  return out;
}

std::string csv_text(const Findings& findings) {
  std::string out;
  for (const Vary& vary : findings.varied) out += cell(vary.key) + ",";
  out += cell(findings.quantity.text) +
         ",error,relative_error,cpu_s,wall_s,steps,evaluations,peak_bytes,on_front,exit_code,"
         "digest\n";
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string();
  };
  for (const Result& result : findings.results) {
    for (std::size_t k = 0; k < findings.varied.size(); ++k) {
      out += cell(findings.varied[k].values[result.combination[k]]) + ",";
    }
    std::optional<double> relative, cpu, wall;
    if (result.error && findings.reference.value != 0.0) {
      relative = *result.error / relative_to(findings.reference);
    }
    if (result.cost.complete) cpu = result.cost.cpu, wall = result.cost.wall;
    out +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", number(result.value),
                    number(result.error), number(relative), number(cpu), number(wall), result.steps,
                    result.evaluations, result.cost.peak_bytes, result.on_front ? 1 : 0,
                    result.exit_code ? fmt::format("{}", *result.exit_code) : "", result.digest);
  }
  return out;
}

std::string json_text(const Findings& findings) {
  json all = {{"scene", findings.scene},
              {"quantity", findings.quantity.text},
              {"reference",
               {{"value", findings.reference.value},
                {"uncertainty", findings.reference.uncertainty},
                {"words", findings.reference.words}}},
              {"runs", json::array()},
              {"orders", json::array()}};
  for (const Result& result : findings.results) {
    all["runs"].push_back(json_of(result, findings.varied));
  }
  for (const Order& order : findings.orders) {
    json one = {{"key", order.key},
                {"at", order.others},
                {"course", convergence::name_of(order.extrapolation.course)},
                {"order", or_null(order.extrapolation.order)},
                {"order_standard_error", or_null(order.extrapolation.order_error)},
                {"limit", order.extrapolation.limit},
                {"uncertainty_of_finest", order.extrapolation.uncertainty},
                {"slope_of_errors", nullptr},
                {"slope_standard_error", nullptr}};
    if (order.slope) {
      one["slope_of_errors"] = order.slope->order;
      one["slope_standard_error"] = or_null(order.slope->standard_error);
    }
    all["orders"].push_back(one);
  }
  return all.dump(1) + "\n";
}

std::string picture_text(const Findings& findings) {
  picture::Picture picture;
  picture.title = findings.scene + ": " + findings.quantity.text;
  picture.x = {"processor time [s]", true};
  const bool relative = findings.reference.value != 0.0;
  picture.y = {relative ? "error [%]" : "error", true};
  const double unit = relative ? 100.0 / relative_to(findings.reference) : 1.0;
  picture::Series all{"runs", {}, {}, false, true, {}}, front{"front", {}, {}, true, true, {}};
  for (const Result& result : findings.results) {
    if (!result.error || !result.cost.complete) continue;
    picture::Series& series = result.on_front ? front : all;
    series.x.push_back(result.cost.cpu);
    series.y.push_back(unit * std::abs(*result.error));
    series.labels.push_back(result.on_front ? result.words : "");
  }
  // A line joins its points in the order of their cost.
  std::vector<std::size_t> order(front.x.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return front.x[i]; });
  picture::Series sorted{front.name, {}, {}, true, true, {}};
  for (const std::size_t i : order) {
    sorted.x.push_back(front.x[i]);
    sorted.y.push_back(front.y[i]);
    sorted.labels.push_back(front.labels[i]);
  }
  picture.series = {all, sorted};
  if (relative && findings.reference.uncertainty > 0.0 && !(all.x.empty() && sorted.x.empty())) {
    double low = 1e300, high = 0.0;
    for (const picture::Series& series : picture.series) {
      for (const double x : series.x) low = std::min(low, x), high = std::max(high, x);
    }
    const double level = unit * findings.reference.uncertainty;
    picture.series.push_back(
        {"of the reference itself", {low, high}, {level, level}, true, false, {}});
  }
  return picture::svg_text(picture);
}

}  // namespace study
