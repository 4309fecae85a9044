#include "record/checkpoint_folder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>

#include "files/durable_file.hpp"
#include "record/checkpoint_file.hpp"

namespace record {

namespace {

constexpr std::string_view name_begins = "step-";
constexpr std::string_view name_ends = ".hdf";

}  // namespace

std::string checkpoint_name(std::int64_t step) {
  return fmt::format("{}{:06}{}", name_begins, step, name_ends);
}

std::optional<std::int64_t> step_of(const std::filesystem::path& checkpoint) {
  const std::string name = checkpoint.filename().string();
  if (!name.starts_with(name_begins) || !name.ends_with(name_ends)) return std::nullopt;
  const char* first = name.data() + name_begins.size();
  const char* last = name.data() + name.size() - name_ends.size();
  std::int64_t step = 0;
  if (first >= last) return std::nullopt;
  const auto [stop, failure] = std::from_chars(first, last, step);
  if (failure != std::errc{} || stop != last || step < 0) return std::nullopt;
  return step;
}

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
    const bool stays = stretch != last_stretch;
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
