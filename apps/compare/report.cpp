#include "compare/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace comparison {

namespace {

std::string where(const Source& a, const Difference& difference) {
  if (difference.name.starts_with("curve/")) {
    return fmt::format("step {}", a.steps.at(difference.row));
  }
  if (difference.name.starts_with("secants/")) {
    return fmt::format("pair {} unknown {}", difference.row, difference.component);
  }
  std::string place = difference.name.starts_with("rows/")
                          ? fmt::format("entry {}", difference.row)
                          : fmt::format("particle {}", difference.row);
  if (difference.name.starts_with("programme/")) return "";
  if (difference.components > 1) place += fmt::format(" component {}", difference.component);
  const std::size_t point = 3 * difference.row;
  if (difference.name.starts_with("rows/") || point + 2 >= a.points.size()) return place;
  return place + fmt::format(" now at ({:.4g}, {:.4g}, {:.4g}) m", a.points[point],
                             a.points[point + 1], a.points[point + 2]);
}

std::string detail(const Source& a, const Difference& difference) {
  if (!difference.obstacle.empty()) return difference.obstacle;
  if (difference.identical) return "";
  if (difference.count == 0) return "only in the sign of zeros or the bits of NaN";
  return fmt::format("{} and {}; {} differ; {}", difference.first, difference.second,
                     difference.count, where(a, difference));
}

std::string summary(const std::vector<Difference>& differences) {
  const auto count = [&](auto&& is) {
    return std::count_if(differences.begin(), differences.end(), is);
  };
  const auto identical = count([](const Difference& d) { return d.identical; });
  const auto failing = count([](const Difference& d) { return !d.passes; });
  const auto size = static_cast<std::ptrdiff_t>(differences.size());
  if (identical == size) return fmt::format("all {} fields are identical bit by bit\n", size);
  const std::string passing =
      fmt::format("{} identical, {} within tolerance", identical, size - identical - failing);
  return failing == 0 ? passing + "\n"
                      : fmt::format("DIFFERENT: {} of {} fields; {}\n", failing, size, passing);
}

}  // namespace

std::string comparison_report(const Source& a, const std::vector<Difference>& differences) {
  std::size_t width = 5;
  for (const Difference& difference : differences) width = std::max(width, difference.name.size());
  std::string out = fmt::format("{:<{}}  {:>11}  {:<4}  {:>9}  {}\n", "field", width, "largest",
                                "unit", "relative", "detail");
  for (const Difference& difference : differences) {
    const bool measured = difference.obstacle.empty();
    std::string line = fmt::format(
        "{:<{}}  {:>11}  {:<4}  {:>9}  {}", difference.name, width,
        measured ? fmt::format("{:.4g}", difference.largest) : "-", difference.unit,
        measured ? fmt::format("{:.2g}", difference.relative) : "-", detail(a, difference));
    line.resize(line.find_last_not_of(' ') + 1);
    fmt::format_to(std::back_inserter(out), "{}{}\n", line, difference.passes ? "" : "  <--");
  }
  return out + summary(differences);
}

}  // namespace comparison
