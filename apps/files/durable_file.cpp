#include "files/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <utility>

#include "files/output_file.hpp"

namespace files {

namespace {

/// Removes the temporary file unless it has got its name.
class Cleaner {
 public:
  Cleaner(std::filesystem::path file, const SystemCalls& system)
      : file_(std::move(file)), system_(system) {}
  Cleaner(const Cleaner&) = delete;
  Cleaner& operator=(const Cleaner&) = delete;
  ~Cleaner() {
    if (!kept_) system_.unlink(file_.c_str());  // if it cannot, the next run does
  }
  void keep() { kept_ = true; }

 private:
  std::filesystem::path file_;
  const SystemCalls& system_;
  bool kept_ = false;
};

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

void sync_to_disk(const std::filesystem::path& file_or_folder, const SystemCalls& system) {
  const int file = system.open(file_or_folder.c_str(), O_RDONLY, 0);
  if (file < 0) throw system_error(file_or_folder, "cannot be opened", errno);
  const int failure = system.fsync(file) != 0 ? errno : 0;
  system.close(file);
  if (failure != 0) throw system_error(file_or_folder, "cannot be forced to disk", failure);
}

void write_durably(const std::filesystem::path& file,
                   const std::function<void(const std::filesystem::path& temporary)>& fill,
                   const SystemCalls& system) {
  // The process id keeps two runs from writing one temporary file.
  std::filesystem::path temporary = file;
  temporary += ".tmp-" + std::to_string(::getpid());
  Cleaner cleaner(temporary, system);
  fill(temporary);
  sync_to_disk(temporary, system);
  if (system.rename(temporary.c_str(), file.c_str()) != 0) {
    throw system_error(file, "cannot get its name", errno);
  }
  cleaner.keep();
  sync_to_disk(folder_of(file), system);
}

void write_text_durably(const std::filesystem::path& file, std::string_view text,
                        const SystemCalls& system) {
  const auto fill = [&](const std::filesystem::path& temporary) {
    OutputFile out = OutputFile::create(temporary, system);
    out.write(text);
    out.close();
  };
  write_durably(file, fill, system);
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to,
                    const SystemCalls& system) {
  if (system.rename(from.c_str(), to.c_str()) != 0) {
    throw system_error(from, "cannot be renamed to " + to.filename().string(), errno);
  }
  sync_to_disk(folder_of(to), system);
}

std::string read_text(const std::filesystem::path& file) {
  std::error_code failure;
  if (std::filesystem::is_directory(file, failure))
    throw FileError(file, "cannot be read: it is a folder");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw system_error(file, "cannot be read", errno);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad() || text.bad()) throw system_error(file, "cannot be read", errno);
  return text.str();
}

void create_folder(const std::filesystem::path& folder, const SystemCalls& system) {
  std::error_code failure;
  if (std::filesystem::is_directory(folder, failure)) return;
  const std::filesystem::path parent = folder_of(folder);
  if (parent != folder) create_folder(parent, system);
  std::filesystem::create_directory(folder, failure);
  if (failure) throw FileError(folder, "cannot be created: " + failure.message());
  sync_to_disk(parent, system);
}

}  // namespace files
