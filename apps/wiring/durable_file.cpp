#include "wiring/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

namespace wiring {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw FileError(file, what + ": " + std::strerror(errno));
}

/// A file descriptor that closes itself.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : file_(file), number_(::open(file.c_str(), flags | O_CLOEXEC)) {
    if (number_ < 0) fail(file_, "cannot be opened");
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }

  void sync() const {
    if (::fsync(number_) != 0) fail(file_, "cannot be forced to disk");
  }

  /// Some file systems report a failed write only here.
  void close() {
    if (::close(std::exchange(number_, -1)) != 0) fail(file_, "cannot be closed");
  }

 private:
  std::filesystem::path file_;
  int number_;
};

/// Removes the temporary file unless it has got its name.
class Cleaner {
 public:
  explicit Cleaner(std::filesystem::path file) : file_(std::move(file)) {}
  Cleaner(const Cleaner&) = delete;
  Cleaner& operator=(const Cleaner&) = delete;
  ~Cleaner() {
    std::error_code ignored;
    if (!kept_) std::filesystem::remove(file_, ignored);
  }
  void keep() { kept_ = true; }

 private:
  std::filesystem::path file_;
  bool kept_ = false;
};

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

void sync_to_disk(const std::filesystem::path& file_or_folder) {
  Descriptor descriptor(file_or_folder, O_RDONLY);
  descriptor.sync();
  descriptor.close();
}

void write_durably(const std::filesystem::path& file,
                   const std::function<void(const std::filesystem::path& temporary)>& fill) {
  // The process id keeps two runs from writing one temporary file.
  std::filesystem::path temporary = file;
  temporary += ".tmp-" + std::to_string(::getpid());
  Cleaner cleaner(temporary);
  fill(temporary);
  sync_to_disk(temporary);
  if (::rename(temporary.c_str(), file.c_str()) != 0) fail(file, "cannot get its name");
  cleaner.keep();
  sync_to_disk(folder_of(file));
}

void write_text_durably(const std::filesystem::path& file, std::string_view text) {
  write_durably(file, [&](const std::filesystem::path& temporary) {
    std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
    if (!stream) fail(temporary, "cannot be created");
    stream.write(text.data(), static_cast<std::streamsize>(text.size()));
    stream.close();
    if (!stream) fail(temporary, "cannot be written");
  });
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code failure;
  if (std::filesystem::is_directory(file, failure)) throw FileError(file, "is a folder");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(file, "cannot be opened");
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad() || text.bad()) fail(file, "cannot be read");
  return text.str();
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::create_directories(folder, failure);
  if (failure) throw FileError(folder, "cannot be created: " + failure.message());
}

}  // namespace wiring
