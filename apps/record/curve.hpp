#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "files/output_file.hpp"

namespace record {

/// One converged step of a run as the curve file shows it.
struct CurveRow {
  std::int64_t step = 0;
  double load_parameter = 0.0;      // 0 .. 1 of the drive
  double settlement = 0.0;          // [m] of the driven side along its direction
  double settlement_over_B = 0.0;   // over drive.reference_length
  double reaction = 0.0;            // [N/m], 3D [N], along the drive, positive against it
  double mean_pressure = 0.0;       // [Pa] reaction / width
  double corrected_pressure = 0.0;  // [Pa] without the work of the hourglass control
  double increment = 0.0;           // [m] of this step
  std::int64_t newton_iterations = 0;
  std::int64_t residual_evaluations = 0;
  std::int64_t jacobian_actions = 0;
  std::int64_t evaluations = 0;  // both of these together, failed attempts included
  std::int64_t cuts = 0;         // halvings before this step converged
  std::int64_t plastic_particles = 0;
  std::int64_t re_searched_rows = 0;
  double residual_ratio = 0.0;        // at the end of the step, over what the tolerance is of
  double max_plastic_strain = 0.0;    // equivalent, accumulated
  double hourglass_work_ratio = 0.0;  // work of the control over that of the loads, so far
  double wall = 0.0;                  // [s] since the run began; the one column that may differ
  bool operator==(const CurveRow&) const = default;
};

/// One column of the curve file: its header, with the unit, and its member.
struct CurveColumn {
  std::string_view name;
  std::string_view name_3d;  // where the unit is another one in 3D, else empty
  std::variant<std::int64_t CurveRow::*, double CurveRow::*> member;
};

/// All columns in the order of the file.
[[nodiscard]] const std::vector<CurveColumn>& curve_columns();

/// Header line without its end.
[[nodiscard]] std::string curve_header(int dimension);
/// One row without its end; every value reads back to the same double.
[[nodiscard]] std::string curve_line(const CurveRow& row);
/// The row of a line.
/// @throws std::invalid_argument naming the column that is no number.
[[nodiscard]] CurveRow parse_curve_line(std::string_view line);
/// All rows of a curve file.
/// @throws FileError if it is no curve file or has a broken line.
[[nodiscard]] std::vector<CurveRow> read_curve(const std::filesystem::path& file);

/// The curve file of a running run: one row per converged step, visible in the file at once.
class CurveFile {
 public:
  /// Begins a new curve; an old file of that name is replaced.
  [[nodiscard]] static CurveFile create(const std::filesystem::path& file, int dimension,
                                        const files::SystemCalls& system = files::system_calls());

  /// Goes on with the rows of `source` up to and including `step`; later rows, and a last line that
  /// a killed run left unfinished, are dropped. Kept lines are copied as they are. `file` and
  /// `source` may be one file; it then is replaced durably.
  /// @throws FileError if `source` does not reach `step` or is broken before it.
  [[nodiscard]] static CurveFile resume(const std::filesystem::path& file,
                                        const std::filesystem::path& source, int dimension,
                                        std::int64_t step,
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
