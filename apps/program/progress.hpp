#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>

namespace program {

/// What a user wants to know while a run goes on.
struct ProgressStatus {
  std::int64_t step = 0;
  double fraction = 0.0;  // of the load programme, 0 .. 1
  std::optional<double> settlement_over_B;
  std::optional<double> mean_pressure;  // [Pa]
  std::int64_t newton_iterations = 0;   // of the last step
  std::int64_t evaluations = 0;         // of the last step: residuals and Jacobian actions
  double residual_ratio = 0.0;
  std::int64_t cuts = 0;              // of the whole run
  double yielding_share = 0.0;        // of the particles, 0 .. 1
  std::int64_t re_searched_rows = 0;  // of the whole run
  double elapsed = 0.0;               // [s]
};

/// Seconds as people say them: `8 s`, `3 min 05 s`, `2 h 10 min`.
[[nodiscard]] std::string duration_text(double seconds);

/// Time left by the pace of the run so far, nothing before 1 % or 1 s of it.
[[nodiscard]] std::optional<double> time_left(const ProgressStatus& status);

/// The status in one line of at most `width` characters (ASCII); what is least urgent goes first
/// when there is no room.
[[nodiscard]] std::string progress_line(const ProgressStatus& status, std::size_t width);

enum class ProgressMode { none, lines, live };

/// The mode for standard output: none if quiet, live if it is a terminal, lines otherwise.
[[nodiscard]] ProgressMode progress_mode(bool quiet);

/// Columns of the terminal behind standard output, 80 if it has none.
[[nodiscard]] std::size_t terminal_width();

/// Shows the progress of a run: one line rewritten in place, or plain lines at most every
/// `interval` seconds.
class Progress {
 public:
  Progress(std::ostream& stream, ProgressMode mode, std::size_t width = 80, double interval = 2.0)
      : stream_(stream), mode_(mode), width_(width), interval_(interval) {}

  /// Shows `status`, unless the last line is too recent; its `elapsed` is the clock.
  void update(const ProgressStatus& status);
  /// Writes a line of its own, clear of the live line.
  void say(const std::string& line);
  /// Shows the last status that was held back and ends the live line.
  void finish();

 private:
  void show(const ProgressStatus& status);

  std::ostream& stream_;
  ProgressMode mode_;
  std::size_t width_;
  double interval_;  // [s]
  std::optional<double> shown_at_;
  std::optional<ProgressStatus> held_back_;
  bool line_open_ = false;
};

}  // namespace program
