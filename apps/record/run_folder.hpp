#pragma once

#include <filesystem>
#include <optional>

#include "files/system_calls.hpp"
#include "record/run_lock.hpp"

namespace record {

/// The output folder of one run, held by a lock while this object lives: a second run in it is
/// refused.
class RunFolder {
 public:
  /// Makes the folder if need be and takes its lock; removes what a killed run left unfinished.
  /// @param system  by which all its files are written; must outlive it
  /// @throws FileError if the folder cannot be made, or another run has it: it says which.
  explicit RunFolder(std::filesystem::path path,
                     const files::SystemCalls& system = files::system_calls());

  /// Moves the results of an earlier run to `previous-1`, `previous-2`, ... in the folder: a
  /// forgotten --resume must not cost a night's work.
  /// @return where they are now, or nothing if there were none.
  [[nodiscard]] std::optional<std::filesystem::path> set_previous_aside() const;

  /// Who had the folder and died in it, see RunLock.
  [[nodiscard]] const std::string& dead_owner() const { return lock_.dead_owner(); }
  [[nodiscard]] const files::SystemCalls& system() const { return system_; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path curve() const { return path_ / "curve.csv"; }
  [[nodiscard]] std::filesystem::path series() const { return path_ / "run.hdf.series"; }
  [[nodiscard]] std::filesystem::path log() const { return path_ / "run.log"; }
  [[nodiscard]] std::filesystem::path failure() const { return path_ / "failure.hdf"; }
  [[nodiscard]] std::filesystem::path limit() const { return path_ / "limit"; }
  [[nodiscard]] std::filesystem::path frames() const { return path_ / "frames"; }
  [[nodiscard]] std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }

 private:
  const files::SystemCalls& system_;
  std::filesystem::path path_;
  RunLock lock_;
};

}  // namespace record
