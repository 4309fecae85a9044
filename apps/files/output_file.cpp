#include "files/output_file.hpp"

#include <fcntl.h>

#include <cerrno>
#include <utility>

namespace files {

namespace {

constexpr mode_t readable_by_all = 0666;  // less the user's umask

}  // namespace

int write_all(const SystemCalls& system, int file, std::span<const std::byte> bytes, off_t at) {
  while (!bytes.empty()) {
    const ssize_t written = system.pwrite(file, bytes.data(), bytes.size(), at);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    if (written == 0) return ENOSPC;  // a device that takes nothing will not take it next time
    bytes = bytes.subspan(static_cast<std::size_t>(written));
    at += written;
  }
  return 0;
}

OutputFile OutputFile::create(const std::filesystem::path& file, const SystemCalls& system) {
  return {file, system, O_WRONLY | O_CREAT | O_TRUNC, 0};
}

OutputFile OutputFile::append(const std::filesystem::path& file, const SystemCalls& system) {
  std::error_code failure;
  const auto size = std::filesystem::file_size(file, failure);
  if (failure) throw FileError(file, "cannot be opened: " + failure.message());
  return {file, system, O_WRONLY, static_cast<off_t>(size)};
}

OutputFile::OutputFile(std::filesystem::path file, const SystemCalls& system, int flags, off_t at)
    : file_(std::move(file)),
      system_(&system),
      number_(system.open(file_.c_str(), flags, readable_by_all)),
      at_(at) {
  if (number_ < 0) throw system_error(file_, "cannot be opened", errno);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      system_(other.system_),
      number_(std::exchange(other.number_, -1)),
      at_(other.at_) {}

OutputFile::~OutputFile() {
  if (number_ >= 0) system_->close(number_);
}

void OutputFile::write(std::string_view text) {
  const int failure = write_all(*system_, number_, std::as_bytes(std::span(text)), at_);
  if (failure != 0) throw system_error(file_, "cannot be written", failure);
  at_ += static_cast<off_t>(text.size());
}

void OutputFile::sync() {
  if (system_->fsync(number_) != 0) throw system_error(file_, "cannot be forced to disk", errno);
}

void OutputFile::close() {
  if (system_->close(std::exchange(number_, -1)) != 0) {
    throw system_error(file_, "cannot be closed", errno);
  }
}

}  // namespace files
