#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace fuzz {

/// A file in memory that has a path, so that a fuzzer does not wear a disk out.
class MemoryFile {
 public:
  MemoryFile() : number_(::memfd_create("fuzz", 0)) {
    if (number_ < 0) throw std::runtime_error("memfd_create failed");
  }
  MemoryFile(const std::uint8_t* data, std::size_t size) : MemoryFile() {
    if (::pwrite(number_, data, size, 0) != static_cast<ssize_t>(size)) {
      throw std::runtime_error("the file in memory cannot be written");
    }
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(number_); }

  [[nodiscard]] std::filesystem::path path() const {
    return "/proc/self/fd/" + std::to_string(number_);
  }

 private:
  int number_;
};

}  // namespace fuzz
