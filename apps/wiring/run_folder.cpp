#include "wiring/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <vector>

#include "wiring/durable_file.hpp"

namespace wiring {

namespace {

int locked(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "run.lock";
  const int lock = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (lock < 0) throw FileError(file, std::string("cannot be opened: ") + std::strerror(errno));
  if (::flock(lock, LOCK_EX | LOCK_NB) != 0) {
    const bool taken = errno == EWOULDBLOCK;
    const std::string reason = taken ? "another run is writing here; choose another --out"
                                     : std::string("cannot be locked: ") + std::strerror(errno);
    ::close(lock);
    throw FileError(folder, reason);
  }
  return lock;
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

RunFolder::RunFolder(std::filesystem::path path) : path_(std::move(path)) {
  create_folder(path_);
  lock_ = locked(path_);
  for (const auto& folder : {path_, frames(), checkpoints()}) remove_unfinished(folder);
}

RunFolder::~RunFolder() {
  ::close(lock_);
}

std::optional<std::filesystem::path> RunFolder::set_previous_aside() const {
  std::vector<std::filesystem::path> results;
  for (const auto& result : {curve(), series(), log(), failure(), frames(), checkpoints()}) {
    if (std::filesystem::exists(result)) results.push_back(result);
  }
  if (results.empty()) return std::nullopt;
  std::filesystem::path previous;
  for (int number = 1; previous.empty() || std::filesystem::exists(previous); ++number) {
    previous = path_ / fmt::format("previous-{}", number);
  }
  create_folder(previous);
  for (const auto& result : results) {
    std::error_code failure;
    std::filesystem::rename(result, previous / result.filename(), failure);
    if (failure) throw FileError(result, "cannot be moved aside: " + failure.message());
  }
  return previous;
}

}  // namespace wiring
