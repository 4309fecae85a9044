#include "record/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <span>
#include <string_view>
#include <thread>

#include "files/output_file.hpp"
#include "files/time_stamp.hpp"

namespace record {

namespace {

constexpr mode_t writable_by_all = 0666;  // less the user's umask
constexpr std::string_view process = "process ";
constexpr std::string_view on_host = " on ";

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  return name.data();
}

std::string this_owner(const files::SystemCalls& system) {
  return fmt::format("{}{}{}{} since {}", process, ::getpid(), on_host, host_name(),
                     files::time_stamp(system.time()));
}

/// The first line of the lock file, "" if it is empty.
std::string owner_in(int file) {
  std::array<char, 512> text{};
  const ssize_t got = ::pread(file, text.data(), text.size(), 0);
  const std::string_view whole(text.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
  return std::string(whole.substr(0, whole.find('\n')));
}

/// Whether an owner may still be at work: not if the process is of this machine and gone.
bool may_live(std::string_view owner) {
  if (!owner.starts_with(process)) return false;
  pid_t number = 0;
  const std::string_view rest = owner.substr(process.size());
  const auto [stop, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  const std::string_view place = rest.substr(static_cast<std::size_t>(stop - rest.data()));
  if (failure != std::errc{} || number == ::getpid()) return false;
  if (!place.starts_with(std::string(on_host) + host_name() + " ")) return true;
  return ::kill(number, 0) == 0 || errno == EPERM;
}

bool is_without_locks(int failure) {
  return failure == ENOSYS || failure == EOPNOTSUPP || failure == ENOLCK || failure == EINVAL;
}

std::string refusal(const std::string& owner) {
  return fmt::format("another run is writing here{}; choose another --out",
                     owner.empty() ? "" : " (" + owner + ")");
}

/// Takes the lock; waits a moment for whoever only looks at it (lock_owner).
/// @return 0, or the errno of the failure
int taken(int file, const files::SystemCalls& system) {
  constexpr int attempts = 5;
  constexpr std::chrono::milliseconds moment(20);
  for (int attempt = 1;; ++attempt) {
    if (system.flock(file, LOCK_EX | LOCK_NB) == 0) return 0;
    if (errno != EWOULDBLOCK || attempt == attempts) return errno;
    std::this_thread::sleep_for(moment);
  }
}

/// Why the lock cannot be had, or "".
std::string objection(int file, const files::SystemCalls& system,
                      const std::filesystem::path& path) {
  const int failure = taken(file, system);
  if (failure == 0) return "";
  const std::string owner = owner_in(file);
  if (failure == EWOULDBLOCK) return refusal(owner);
  if (!is_without_locks(failure))
    return files::system_error(path, "cannot be locked", failure).reason();
  if (!may_live(owner)) return "";
  return refusal(owner) + ", or remove run.lock if that run is gone";
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& folder, const files::SystemCalls& system)
    : system_(system) {
  const std::filesystem::path path = folder / "run.lock";
  file_ = system.open(path.c_str(), O_RDWR | O_CREAT, writable_by_all);
  if (file_ < 0) throw files::system_error(path, "cannot be opened", errno);
  const std::string refused = objection(file_, system, path);
  if (!refused.empty()) {
    system.close(file_);
    throw files::FileError(folder, refused);
  }
  dead_owner_ = owner_in(file_);
  // Without these words the lock holds all the same, unless it rests on them.
  const std::string owner = this_owner(system) + "\n";
  (void)system.ftruncate(file_, 0);
  (void)files::write_all(system, file_, std::as_bytes(std::span(owner)), 0);
}

LockOwner lock_owner(const std::filesystem::path& folder, const files::SystemCalls& system) {
  const int file = system.open((folder / "run.lock").c_str(), O_RDONLY, 0);
  if (file < 0) return {};
  LockOwner owner{owner_in(file), false};
  if (system.flock(file, LOCK_SH | LOCK_NB) != 0) {
    owner.alive = errno == EWOULDBLOCK || (is_without_locks(errno) && may_live(owner.name));
  }
  system.close(file);
  return owner;
}

RunLock::~RunLock() {
  (void)system_.ftruncate(file_, 0);
  system_.close(file_);
}

}  // namespace record
