#include "bounds/limit_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <system_error>
#include <utility>

#include "bounds/limit_bracket.hpp"
#include "bounds/plateau_check.hpp"
#include "files/durable_file.hpp"
#include "scene/print.hpp"
#include "scene/scene.hpp"

namespace bounds {

namespace {

/// The bracket of an earlier part of this run, if it is what is asked for now.
std::optional<LimitBracket> kept_bracket(const std::filesystem::path& record,
                                         const scene::Limit& limit) {
  std::error_code failure;
  if (!std::filesystem::exists(record, failure)) return std::nullopt;
  try {
    const LimitBracket bracket = read_limit_bracket(record);
    if (bracket.gap_wanted == limit.gap) return bracket;
  } catch (const files::FileError&) {
    // damaged: computed anew
  }
  return std::nullopt;
}

}  // namespace

LimitCheck::LimitCheck(const scene::Scene& scene, const record::RunFolder& folder,
                       const std::filesystem::path& program)
    : scene_(scene), folder_(folder.limit()) {
  if (!scene.limit.check) return;
  if (const auto kept = kept_bracket(record(), scene.limit)) {
    news_.push_back("collapse load: " + bracket_line(*kept) + ", as computed before");
    return;
  }
  try {
    files::create_folder(folder_, folder.system());
    std::error_code none;
    std::filesystem::remove(record(), none);  // not what is asked for now
    const auto copy = folder_ / "scene.toml";
    files::write_text_durably(copy, scene::effective_toml(scene), folder.system());
    const std::vector<std::string> arguments{copy.string(),
                                             "--gap",
                                             fmt::format("{}", scene.limit.gap),
                                             "--max-seconds",
                                             fmt::format("{}", scene.limit.max_seconds),
                                             "--json",
                                             record().string(),
                                             "--fields",
                                             (folder_ / "field").string()};
    process_ = std::make_unique<program::ChildProcess>(program, arguments, output());
    news_.push_back("fpm-limit computes bounds of the collapse load meanwhile: " +
                    output().string());
  } catch (const files::FileError& failure) {
    news_.push_back(fmt::format("limit.check: no bounds of the collapse load: {}", failure.what()));
  }
}

std::vector<std::string> LimitCheck::news() {
  if (process_) {
    if (const auto code = process_->exit_code()) collect(*code);
  }
  return std::exchange(news_, {});
}

bool LimitCheck::pending() {
  return process_ && !process_->exit_code();
}

void LimitCheck::collect(int exit_code) {
  process_.reset();
  try {
    news_.push_back("collapse load: " + bracket_line(read_limit_bracket(record())));
  } catch (const files::FileError&) {
    news_.push_back(fmt::format("limit.check: fpm-limit ended with code {}: {}", exit_code,
                                program::last_word(output())));
  }
}

std::string LimitCheck::verdict(const std::vector<record::CurveRow>& curve) const {
  if (!scene_.limit.check || curve.empty() || !(curve.back().settlement > 0.0)) return "";
  const auto bracket = kept_bracket(record(), scene_.limit);
  if (!bracket || !bracket->lower || !bracket->upper) return "";
  std::string text = text_of(check_plateau(curve, scene_, *bracket->lower, *bracket->upper));
  text.pop_back();  // whoever says it ends the line
  return text;
}

}  // namespace bounds
