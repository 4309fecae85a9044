#include "bounds/limit_bracket.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "files/durable_file.hpp"

namespace bounds {

namespace {

using nlohmann::json;

std::optional<double> number_or_none(const json& object, const char* key) {
  const json& value = object.at(key);
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

std::string bound_text(const std::optional<double>& bound) {
  return bound ? fmt::format("{:.6g}", *bound) : "none";
}

}  // namespace

LimitBracket read_limit_bracket(const std::filesystem::path& file) {
  const std::string text = files::read_text(file);
  try {
    const json found = json::parse(text);
    LimitBracket bracket;
    bracket.lower = number_or_none(found, "lower_bound");
    bracket.upper = number_or_none(found, "upper_bound");
    bracket.gap_wanted = found.at("gap_wanted").get<double>();
    bracket.status = found.at("status").get<std::string>();
    if (found.contains("davis_reduced")) {
      bracket.davis_lower = number_or_none(found.at("davis_reduced"), "lower_bound");
      bracket.davis_upper = number_or_none(found.at("davis_reduced"), "upper_bound");
    }
    return bracket;
  } catch (const json::exception& failure) {
    throw files::FileError(file, fmt::format("is no bracket of fpm-limit: {}", failure.what()));
  }
}

std::string bracket_line(const LimitBracket& bracket) {
  std::string text =
      fmt::format("{} .. {} Pa", bound_text(bracket.lower), bound_text(bracket.upper));
  if (bracket.lower && bracket.upper) {
    const double gap = (*bracket.upper - *bracket.lower) / (*bracket.upper + *bracket.lower) * 2.0;
    text += fmt::format(" (certified, gap {:.2f} %)", 100.0 * gap);
  }
  if (bracket.davis_lower || bracket.davis_upper) {
    text += fmt::format("; with Davis' strength, no bounds: {} .. {} Pa",
                        bound_text(bracket.davis_lower), bound_text(bracket.davis_upper));
  }
  return text;
}

}  // namespace bounds
