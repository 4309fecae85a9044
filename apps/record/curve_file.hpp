#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "files/output_file.hpp"
#include "record/curve.hpp"

namespace record {

/// All rows of a curve file.
/// @throws FileError if it is no curve file or has a broken line.
[[nodiscard]] std::vector<CurveRow> read_curve(const std::filesystem::path& file);
/// Which columns a curve file has.
/// @throws FileError if it is no curve file.
[[nodiscard]] CurveColumns read_curve_columns(const std::filesystem::path& file);

/// The curve file of a running run: one row per converged step, visible in the file at once.
class CurveFile {
 public:
  /// Begins a new curve; an old file of that name is replaced.
  [[nodiscard]] static CurveFile create(const std::filesystem::path& file,
                                        const CurveColumns& columns,
                                        const files::SystemCalls& system = files::system_calls());

  /// Goes on with the rows of `source` up to and including `step`; later rows, and a last line that
  /// a killed run left unfinished, are dropped. Kept lines are copied as they are. `file` and
  /// `source` may be one file; it then is replaced durably.
  /// @throws FileError if `source` does not reach `step` or is broken before it.
  [[nodiscard]] static CurveFile resume(const std::filesystem::path& file,
                                        const std::filesystem::path& source,
                                        const CurveColumns& columns, std::int64_t step,
                                        const files::SystemCalls& system = files::system_calls());

  /// Adds a row.
  /// @throws FileError if it cannot be written.
  void append(const CurveRow& row) { file_.write(curve_line(row) + "\n"); }
  /// Forces all rows to disk; call before a checkpoint that counts on them.
  void sync() { file_.sync(); }

 private:
  CurveFile(const std::filesystem::path& file, const files::SystemCalls& system)
      : file_(files::OutputFile::append(file, system)) {}

  files::OutputFile file_;
};

}  // namespace record
