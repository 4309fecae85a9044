#pragma once

#include <filesystem>
#include <string>

#include "files/system_calls.hpp"

namespace record {

/// The lock of an output folder, `run.lock`, held while this object lives. It is the system's
/// (flock), which ends with its process however that ends, so that the lock of a dead owner is no
/// lock. Where the file system has none, the file's content stands for it: it says who holds it,
/// and an owner who is no longer alive on this machine is none.
class RunLock {
 public:
  /// @param system  must outlive the lock
  /// @throws FileError saying who holds the folder, or that there can be no lock file.
  explicit RunLock(const std::filesystem::path& folder,
                   const files::SystemCalls& system = files::system_calls());
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;
  ~RunLock();

  /// Who had the folder and died without giving it back: killed, or with the machine; "" if nobody.
  [[nodiscard]] const std::string& dead_owner() const { return dead_owner_; }

 private:
  const files::SystemCalls& system_;
  int file_ = -1;
  std::string dead_owner_;
};

/// Who has, or died having, the lock of a folder.
struct LockOwner {
  std::string name;  // "process 1234 on host since 2024-05-17T08:30:00Z", or "" if nobody has
  bool alive = false;
};

/// Looks at a lock without taking it. Where the file system has no locks, an owner who may be alive
/// is.
[[nodiscard]] LockOwner lock_owner(const std::filesystem::path& folder,
                                   const files::SystemCalls& system = files::system_calls());

}  // namespace record
