#include "study/reference.hpp"

#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cmath>
#include <thread>

#include "bounds/limit_bracket.hpp"
#include "campaign/outcome.hpp"
#include "files/durable_file.hpp"
#include "program/child_process.hpp"
#include "program/command_line.hpp"
#include "scene/print.hpp"
#include "scene/scene.hpp"

namespace study {

namespace {

constexpr std::string_view richardson = "richardson";

Reference file_reference(const std::string& text, const Quantity& quantity) {
  const Columns table = read_columns(text);
  const Reading reading = value_in(table, quantity);
  if (!reading.value) {
    throw program::UsageError(fmt::format("--reference {}: {}", text, reading.obstacle));
  }
  const std::string column = column_meant(table.names, quantity.column);
  return {*reading.value * units_between(column, quantity.column), 0.0, "from " + text};
}

}  // namespace

ReferenceWish parse_reference(const std::string& text, const Quantity& quantity) {
  using Kind = ReferenceWish::Kind;
  if (text == richardson) return {};
  if (text.starts_with("richardson:")) return {Kind::richardson, {}, text.substr(11)};
  if (text == "limit") return {Kind::limit, {}, ""};
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, number);
  if (failure == std::errc{} && stop == end && std::isfinite(number)) {
    return {Kind::number, {number, 0.0, "given"}, ""};
  }
  std::error_code absent;
  if (!std::filesystem::is_regular_file(text, absent)) {
    throw program::UsageError(
        fmt::format("--reference: found {}, which is no file; allowed is a number, a CSV file, "
                    "richardson, richardson:KEY or limit",
                    text));
  }
  return {Kind::file, file_reference(text, quantity), ""};
}

Reference limit_reference(const scene::Scene& scene, const std::filesystem::path& folder,
                          const std::filesystem::path& program) {
  scene::Scene bare = scene;
  bare.output = {};
  const std::string text = scene::effective_toml(bare);
  const auto home = folder / ("limit-" + campaign::digest_of(text, program));
  const auto record = home / "bracket.json", output = home / "output.txt";
  std::error_code failure;
  if (!std::filesystem::exists(record, failure)) {
    files::create_folder(home);
    files::write_text_durably(home / "scene.toml", text);
    program::ChildProcess child(
        program, {(home / "scene.toml").string(), "--json", record.string()}, output);
    constexpr std::chrono::milliseconds pause{20};
    while (!child.exit_code()) std::this_thread::sleep_for(pause);
  }
  if (!std::filesystem::exists(record, failure)) {
    throw program::UsageError("--reference limit: " + program::last_word(output));
  }
  const bounds::LimitBracket bracket = bounds::read_limit_bracket(record);
  if (!bracket.lower || !bracket.upper) {
    throw program::UsageError("--reference limit: fpm-limit found " +
                              bounds::bracket_line(bracket));
  }
  return {(*bracket.lower + *bracket.upper) / 2.0, (*bracket.upper - *bracket.lower) / 2.0,
          "fpm-limit " + bounds::bracket_line(bracket)};
}

}  // namespace study
