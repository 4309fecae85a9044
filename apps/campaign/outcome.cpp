#include "campaign/outcome.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <span>

#include "files/content_digest.hpp"
#include "files/durable_file.hpp"
#include "program/exit_code.hpp"

namespace campaign {

using nlohmann::json;

bool Outcome::finished() const {
  using program::ExitCode;
  return exit_code &&
         (*exit_code == to_int(ExitCode::done) || *exit_code == to_int(ExitCode::input_refused) ||
          *exit_code == to_int(ExitCode::not_converged));
}

std::string digest_of(const std::string& scene, const std::filesystem::path& program) {
  std::uint64_t hash = 0;
  for (std::string text : {scene, files::read_text(program)}) {
    const auto length = static_cast<std::uint64_t>(text.size());
    text.resize((text.size() + 7) / 8 * 8);  // the hash is one of whole words
    hash = files::hash_of(std::as_bytes(std::span(text)), hash ^ length);
  }
  return fmt::format("{:016x}", hash);
}

void write_outcome(const std::filesystem::path& file, const Outcome& outcome) {
  json all = {{"digest", outcome.digest},
              {"exit_code", nullptr},
              {"at_work", outcome.at_work},
              {"wall_s", outcome.cost.wall},
              {"cpu_s", outcome.cost.cpu},
              {"peak_bytes", outcome.cost.peak_bytes},
              {"cost_is_complete", outcome.cost.complete}};
  if (outcome.exit_code) all["exit_code"] = *outcome.exit_code;
  files::write_text_durably(file, all.dump(1) + "\n");
}

std::optional<Outcome> read_outcome(const std::filesystem::path& file, const std::string& digest) {
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return std::nullopt;
  try {
    const json found = json::parse(files::read_text(file));
    Outcome outcome;
    outcome.digest = found.at("digest").get<std::string>();
    if (outcome.digest != digest) return std::nullopt;
    if (!found.at("exit_code").is_null()) outcome.exit_code = found.at("exit_code").get<int>();
    outcome.at_work = found.at("at_work").get<bool>();
    outcome.cost = {found.at("wall_s").get<double>(), found.at("cpu_s").get<double>(),
                    found.at("peak_bytes").get<std::int64_t>(),
                    found.at("cost_is_complete").get<bool>()};
    return outcome;
  } catch (const json::exception&) {
    return std::nullopt;  // damaged: the run is made again
  }
}

}  // namespace campaign
