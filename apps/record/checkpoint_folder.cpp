#include "record/checkpoint_folder.hpp"

#include <algorithm>

#include "files/durable_file.hpp"
#include "record/checkpoint_file.hpp"
#include "record/checkpoint_name.hpp"

namespace record {

std::vector<std::filesystem::path> list_checkpoints(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (step_of(entry.path())) found.push_back(entry.path());
  }
  std::ranges::sort(found, std::greater<>(), [](const auto& path) { return *step_of(path); });
  return found;
}

std::optional<std::filesystem::path> newest_usable(const std::filesystem::path& folder,
                                                   std::vector<std::string>& objections,
                                                   std::optional<std::int64_t> before) {
  for (const std::filesystem::path& path : list_checkpoints(folder)) {
    if (before && *step_of(path) >= *before) continue;
    try {
      CheckpointNotes notes;
      (void)open_checkpoint(path, notes);
      return path;
    } catch (const files::FileError& failure) {
      objections.emplace_back(failure.what());
    }
  }
  return std::nullopt;
}

void remove_older(const std::filesystem::path& folder, std::int64_t step,
                  const Retention& retention, const files::SystemCalls& system) {
  auto oldest_first = list_checkpoints(folder);
  std::erase_if(oldest_first, [&](const auto& path) { return *step_of(path) > step; });
  std::ranges::reverse(oldest_first);
  const auto newest = static_cast<std::size_t>(std::max(retention.newest, 1));
  std::int64_t last_stretch = -1;
  for (std::size_t i = 0; i + newest < oldest_first.size(); ++i) {
    const std::int64_t stretch =
        retention.every > 0 ? *step_of(oldest_first[i]) / retention.every : last_stretch;
    const bool stays = stretch != last_stretch ||
                       std::ranges::count(retention.for_good, *step_of(oldest_first[i])) > 0;
    last_stretch = stretch;
    if (!stays) system.unlink(oldest_first[i].c_str());  // one too many does no harm
  }
}

std::vector<std::filesystem::path> set_aside_later(const std::filesystem::path& folder,
                                                   std::int64_t step,
                                                   const files::SystemCalls& system) {
  std::vector<std::filesystem::path> renamed;
  for (const std::filesystem::path& path : list_checkpoints(folder)) {
    if (*step_of(path) <= step) continue;
    std::filesystem::path aside = path;
    aside += ".set-aside";
    files::rename_durably(path, aside, system);
    renamed.push_back(aside);
  }
  return renamed;
}

}  // namespace record
