#include "compare/difference.hpp"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace comparison {

namespace {

double gap(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  const double distance = std::abs(a - b);
  return std::isnan(distance) ? std::numeric_limits<double>::infinity() : distance;
}

double gap(std::int64_t a, std::int64_t b) {
  return a == b ? 0.0 : std::abs(static_cast<double>(a) - static_cast<double>(b));
}

template <class T>
void measure(const std::vector<T>& a, const std::vector<T>& b, Difference& difference) {
  difference.identical = a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
  double magnitude = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto first = static_cast<double>(a[i]), second = static_cast<double>(b[i]);
    if (std::isfinite(first)) magnitude = std::max(magnitude, std::abs(first));
    if (std::isfinite(second)) magnitude = std::max(magnitude, std::abs(second));
    const double distance = gap(a[i], b[i]);
    difference.count += distance > 0.0 ? 1U : 0U;
    if (distance > difference.largest) {
      difference.largest = distance;
      difference.at = i;
      difference.first = first;
      difference.second = second;
    }
  }
  difference.relative = magnitude > 0.0 ? difference.largest / magnitude : difference.largest;
}

/// The last tolerance whose pattern matches, or nothing.
const Tolerance* tolerance_for(const std::string& name, const std::vector<Tolerance>& all) {
  const auto found = std::find_if(all.rbegin(), all.rend(), [&](const Tolerance& tolerance) {
    return matches(name, tolerance.pattern);
  });
  return found == all.rend() ? nullptr : &*found;
}

bool passes(const Difference& difference, const Request& request) {
  if (!difference.obstacle.empty()) return false;
  if (difference.identical) return true;
  const Tolerance* absolute = tolerance_for(difference.name, request.absolute);
  const Tolerance* relative = tolerance_for(difference.name, request.relative);
  if (absolute == nullptr && relative == nullptr) return false;
  const double magnitude =
      difference.relative > 0.0 ? difference.largest / difference.relative : 0.0;
  const double allowed = (absolute != nullptr ? absolute->value : 0.0) +
                         (relative != nullptr ? relative->value * magnitude : 0.0);
  return difference.largest <= allowed;
}

bool is_asked_for(const std::string& name, const Request& request) {
  const auto match = [&](const std::string& pattern) { return matches(name, pattern); };
  // What a solve has learnt is no result: it differs as soon as two runs do in their last digits.
  const bool within = !request.absolute.empty() || !request.relative.empty();
  if (within && request.only.empty() && name.starts_with("secants/")) return false;
  return (request.only.empty() || std::ranges::any_of(request.only, match)) &&
         std::ranges::none_of(request.ignored, match);
}

/// The rows of `own` whose step `other` has too.
std::vector<std::size_t> common_rows(const std::vector<std::int64_t>& own,
                                     const std::vector<std::int64_t>& other) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (std::ranges::find(other, own[i]) != other.end()) rows.push_back(i);
  }
  return rows;
}

Quantity with_rows(const Quantity& column, const std::vector<std::size_t>& rows) {
  const auto take = [&](const auto& values) {
    std::remove_cvref_t<decltype(values)> taken;
    for (const std::size_t row : rows) taken.push_back(values.at(row));
    return decltype(Quantity::values)(std::move(taken));
  };
  return {column.unit, {rows.size()}, std::visit(take, column.values)};
}

/// Of a column of two curves that have not the same steps.
Difference difference_at_common_steps(const Source& a, const Source& b, const std::string& name) {
  const auto in_a = common_rows(a.steps, b.steps), in_b = common_rows(b.steps, a.steps);
  Difference difference =
      difference_of(with_rows(a.load(name), in_a), with_rows(b.load(name), in_b));
  if (!in_a.empty()) difference.row = in_a[difference.row];
  if (in_a.empty() || name == "curve/step") {
    difference.obstacle = fmt::format("{} steps only in A, {} only in B",
                                      a.steps.size() - in_a.size(), b.steps.size() - in_b.size());
  }
  return difference;
}

Difference compared(const Source& a, const Source& b, const std::string& name) {
  const bool in_a = std::ranges::binary_search(a.names, name);
  const bool in_b = std::ranges::binary_search(b.names, name);
  Difference difference;
  if (in_a && in_b && name.starts_with("curve/") && a.steps != b.steps) {
    difference = difference_at_common_steps(a, b, name);
  } else if (in_a && in_b) {
    difference = difference_of(a.load(name), b.load(name));
  } else {
    difference.obstacle = in_a ? "only in A" : "only in B";
  }
  difference.name = name;
  return difference;
}

}  // namespace

bool matches(const std::string& name, const std::string& pattern) {
  if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) return true;
  const bool whole = pattern.find('/') != std::string::npos;
  return !whole && ::fnmatch(pattern.c_str(), name.substr(name.rfind('/') + 1).c_str(), 0) == 0;
}

Difference difference_of(const Quantity& a, const Quantity& b) {
  Difference difference;
  difference.unit = a.unit;
  if (a.unit != b.unit) {
    difference.obstacle = fmt::format("unit {} and {}", a.unit, b.unit);
  } else if (a.shape != b.shape) {
    difference.obstacle =
        fmt::format("shape {} and {}", fmt::join(a.shape, " x "), fmt::join(b.shape, " x "));
  } else if (a.values.index() != b.values.index()) {
    difference.obstacle = "numbers of another type";
  }
  if (!difference.obstacle.empty()) return difference;
  std::visit(
      [&](const auto& values) {
        measure(values, std::get<std::remove_cvref_t<decltype(values)>>(b.values), difference);
      },
      a.values);
  for (std::size_t i = 1; i < a.shape.size(); ++i) difference.components *= a.shape[i];
  const std::size_t components = std::max<std::size_t>(difference.components, 1);
  difference.row = difference.at / components;
  difference.component = difference.at % components;
  return difference;
}

std::vector<Difference> differences(const Source& a, const Source& b, const Request& request) {
  std::vector<std::string> names;
  std::ranges::set_union(a.names, b.names, std::back_inserter(names));
  std::vector<Difference> all;
  for (const std::string& name : names) {
    if (!is_asked_for(name, request)) continue;
    all.push_back(compared(a, b, name));
    all.back().passes = passes(all.back(), request);
  }
  return all;
}

}  // namespace comparison
