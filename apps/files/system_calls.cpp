#include "files/system_calls.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdio>

namespace files {

const SystemCalls& system_calls() {
  static const SystemCalls calls{
      [](const char* path, int flags, mode_t mode) {
        return ::open(path, flags | O_CLOEXEC, mode);
      },
      ::pwrite,
      ::ftruncate,
      ::fsync,
      ::close,
      ::flock,
      [](const char* from, const char* to) { return ::rename(from, to); },
      ::unlink,
      [] { return std::time(nullptr); },
  };
  return calls;
}

}  // namespace files
