#include "bounds/accuracy_note.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "files/durable_file.hpp"
#include "scene/print.hpp"
#include "scene/scene.hpp"

namespace bounds {

std::string accuracy_note(const std::filesystem::path& folder, const scene::Scene& scene) {
  const std::filesystem::path file = folder / "accuracy.json";
  std::error_code failure;
  if (!std::filesystem::exists(file, failure)) return "";
  try {
    const auto all = nlohmann::json::parse(files::read_text(file));
    if (all.at("effective").get<std::string>() != scene::effective_toml(scene)) return "";
    const double value = all.at("value"), bar = all.at("bar");
    const auto percent = [&](double error) { return 100.0 * error / std::abs(value); };
    std::string note =
        fmt::format("{} = {:.6g} +- {:.2g}", all.at("quantity").get<std::string>(), value, bar);
    if (value == 0.0) return note;
    fmt::format_to(std::back_inserter(note), " ({:.2f} %)", percent(bar));
    const char* before = ": ";
    for (const auto& part : all.at("parts")) {
      fmt::format_to(std::back_inserter(note), "{}{} {:.2f} %", before,
                     part.at("source").get<std::string>(), percent(part.at("error")));
      before = ", ";
    }
    return note;
  } catch (const nlohmann::json::exception&) {
    return "";  // of an earlier release, or damaged: it says nothing of this run
  } catch (const files::FileError&) {
    return "";
  }
}

}  // namespace bounds
