#pragma once

#include <filesystem>
#include <optional>

namespace wiring {

/// The output folder of one run, held by a lock while this object lives: a second run in it is
/// refused. The lock is the system's (flock) and ends with its process, however that ends.
class RunFolder {
 public:
  /// Makes the folder if need be and takes its lock; removes what a killed run left unfinished.
  /// @throws FileError if the folder cannot be made, or another run has it.
  explicit RunFolder(std::filesystem::path path);
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;
  ~RunFolder();

  /// Moves the results of an earlier run to `previous-1`, `previous-2`, ... in the folder: a
  /// forgotten --resume must not cost a night's work.
  /// @return where they are now, or nothing if there were none.
  [[nodiscard]] std::optional<std::filesystem::path> set_previous_aside() const;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] std::filesystem::path curve() const { return path_ / "curve.csv"; }
  [[nodiscard]] std::filesystem::path series() const { return path_ / "run.hdf.series"; }
  [[nodiscard]] std::filesystem::path log() const { return path_ / "run.log"; }
  [[nodiscard]] std::filesystem::path failure() const { return path_ / "failure.hdf"; }
  [[nodiscard]] std::filesystem::path frames() const { return path_ / "frames"; }
  [[nodiscard]] std::filesystem::path checkpoints() const { return path_ / "checkpoints"; }

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace wiring
