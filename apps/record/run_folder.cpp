#include "record/run_folder.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "files/durable_file.hpp"

namespace record {

namespace {

std::filesystem::path made(std::filesystem::path folder, const files::SystemCalls& system) {
  files::create_folder(folder, system);
  return folder;
}

// The temporary files of write_durably; whoever wrote them is gone, for the lock is ours.
void remove_unfinished(const std::filesystem::path& folder) {
  std::error_code ignored;
  std::vector<std::filesystem::path> unfinished;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().find(".tmp-") != std::string::npos) {
      unfinished.push_back(entry.path());
    }
  }
  for (const auto& file : unfinished) std::filesystem::remove(file, ignored);
}

}  // namespace

RunFolder::RunFolder(std::filesystem::path path, const files::SystemCalls& system)
    : system_(system), path_(made(std::move(path), system)), lock_(path_, system) {
  for (const auto& folder : {path_, frames(), checkpoints()}) remove_unfinished(folder);
}

std::optional<std::filesystem::path> RunFolder::set_previous_aside() const {
  std::vector<std::filesystem::path> results;
  for (const auto& result :
       {curve(), series(), log(), failure(), limit(), frames(), checkpoints()}) {
    if (std::filesystem::exists(result)) results.push_back(result);
  }
  if (results.empty()) return std::nullopt;
  std::filesystem::path previous;
  for (int number = 1; previous.empty() || std::filesystem::exists(previous); ++number) {
    previous = path_ / fmt::format("previous-{}", number);
  }
  files::create_folder(previous, system_);
  for (const auto& result : results) {
    files::rename_durably(result, previous / result.filename(), system_);
  }
  files::sync_to_disk(path_, system_);
  return previous;
}

}  // namespace record
