#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace record {

/// One converged step of a run as the curve file shows it.
struct CurveRow {
  std::int64_t step = 0;
  double load_parameter = 0.0;      // 0 .. 1 of the drive
  double settlement = 0.0;          // [m] of the driven side along its direction, or of a loaded
                                    // plate along its load, where that acts
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
  std::vector<double> measures;       // what the scene measures besides, before `wall` in the file
  bool operator==(const CurveRow&) const = default;

  /// Visits every column but the measures in the order of the file, visit(name, value) with the
  /// unit in the name, or visit(name, value, name_3d) where the unit is another one in 3D.
  template <class Self, class Visitor>
  static void for_each_column(Self& row, Visitor&& visit) {
    visit("step", row.step);
    visit("load_parameter", row.load_parameter);
    visit("settlement_m", row.settlement);
    visit("settlement_over_B", row.settlement_over_B);
    visit("reaction_N_per_m", row.reaction, "reaction_N");
    visit("mean_pressure_Pa", row.mean_pressure);
    visit("corrected_pressure_Pa", row.corrected_pressure);
    visit("increment_m", row.increment);
    visit("newton_iterations", row.newton_iterations);
    visit("residual_evaluations", row.residual_evaluations);
    visit("jacobian_actions", row.jacobian_actions);
    visit("evaluations", row.evaluations);
    visit("cuts", row.cuts);
    visit("plastic_particles", row.plastic_particles);
    visit("researched_rows", row.re_searched_rows);
    visit("residual_ratio", row.residual_ratio);
    visit("max_plastic_strain", row.max_plastic_strain);
    visit("hourglass_work_ratio", row.hourglass_work_ratio);
    visit("wall_s", row.wall);
  }
};

/// Which columns a curve has.
struct CurveColumns {
  int dimension = 2;
  std::vector<std::string> measures;  // each with its unit

  // NOLINTNEXTLINE(google-explicit-constructor): most curves measure nothing besides
  CurveColumns(int dim, std::vector<std::string> of_measures = {})
      : dimension(dim), measures(std::move(of_measures)) {}
  bool operator==(const CurveColumns&) const = default;
};

/// Names of all columns in the order of the file.
[[nodiscard]] std::vector<std::string> column_names(const CurveColumns& columns);

/// Header line without its end.
[[nodiscard]] std::string curve_header(const CurveColumns& columns);
/// The columns of a header; nothing if it is none of a curve.
[[nodiscard]] std::optional<CurveColumns> parse_curve_header(std::string_view line);
/// One row without its end; every value reads back to the same double.
[[nodiscard]] std::string curve_line(const CurveRow& row);
/// The row of a line.
/// @param measures  how many there are
/// @throws std::invalid_argument naming the column that is no number.
[[nodiscard]] CurveRow parse_curve_line(std::string_view line, std::size_t measures = 0);
/// A curve file's content.
[[nodiscard]] std::string curve_text(const CurveColumns& columns,
                                     const std::vector<CurveRow>& rows);

/// Gives rows that measured `before` the measures `after`: those of the same name keep their
/// values, new ones are NaN.
void change_measures(std::vector<CurveRow>& rows, const std::vector<std::string>& before,
                     const std::vector<std::string>& after);

}  // namespace record
