#pragma once

#include <sys/types.h>

#include <ctime>
#include <functional>

namespace files {

/// The system calls by which a run's results reach the disk, and the clock that dates them. All
/// writing goes through one of these, so that a test can let any call fail, fall short or be the
/// last one before a kill. Each returns and sets errno as the system's own does.
struct SystemCalls {
  std::function<int(const char* path, int flags, mode_t mode)> open;
  std::function<ssize_t(int file, const void* bytes, size_t count, off_t at)> pwrite;
  std::function<int(int file, off_t size)> ftruncate;
  std::function<int(int file)> fsync;
  std::function<int(int file)> close;
  std::function<int(int file, int operation)> flock;
  std::function<int(const char* from, const char* to)> rename;
  std::function<int(const char* path)> unlink;
  std::function<std::time_t()> time;
};

/// The calls themselves.
[[nodiscard]] const SystemCalls& system_calls();

}  // namespace files
