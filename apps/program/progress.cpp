#include "program/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace program {

namespace {

// A live line that changes faster than this only flickers.
constexpr double live_interval = 0.1;  // [s]
constexpr const char* clear_line = "\r\x1b[K";

struct Piece {
  std::string text;
  int urgency;  // pieces of low urgency are left out first
};

std::string pressure_text(double pascal) {
  const double size = std::abs(pascal);
  if (size >= 1e6) return fmt::format("{:.3f} MPa", pascal / 1e6);
  if (size >= 1e3) return fmt::format("{:.2f} kPa", pascal / 1e3);
  return fmt::format("{:.2f} Pa", pascal);
}

std::vector<Piece> pieces_of(const ProgressStatus& status) {
  std::vector<Piece> pieces;
  pieces.push_back({fmt::format("{:5.1f} %", 100.0 * status.fraction), 9});
  pieces.push_back({fmt::format("step {}", status.step), 7});
  if (status.settlement_over_B) {
    pieces.push_back({fmt::format("d/B {:.2f} %", 100.0 * *status.settlement_over_B), 8});
  }
  if (status.mean_pressure) pieces.push_back({"p " + pressure_text(*status.mean_pressure), 8});
  pieces.push_back(
      {fmt::format("Newton {} evals {}", status.newton_iterations, status.evaluations), 4});
  pieces.push_back({fmt::format("res {:.1e}", status.residual_ratio), 3});
  if (status.cuts > 0) pieces.push_back({fmt::format("cuts {}", status.cuts), 5});
  pieces.push_back({fmt::format("yielding {:.0f} %", 100.0 * status.yielding_share), 2});
  if (status.re_searched_rows > 0) {
    pieces.push_back({fmt::format("re-searched {}", status.re_searched_rows), 1});
  }
  if (const auto left = time_left(status)) {
    pieces.push_back({duration_text(*left) + " left", 6});
  }
  return pieces;
}

std::string joined_pieces(const std::vector<Piece>& pieces) {
  std::string line;
  for (const Piece& piece : pieces) line += (line.empty() ? "" : " | ") + piece.text;
  return line;
}

}  // namespace

std::string duration_text(double seconds) {
  const auto whole = std::llround(std::max(seconds, 0.0));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::optional<double> time_left(const ProgressStatus& status) {
  constexpr double first_fraction = 0.01;
  constexpr double first_second = 1.0;
  if (status.fraction < first_fraction || status.elapsed < first_second) return std::nullopt;
  return status.elapsed * (1.0 - std::min(status.fraction, 1.0)) / status.fraction;
}

std::string progress_line(const ProgressStatus& status, std::size_t width) {
  std::vector<Piece> pieces = pieces_of(status);
  std::string line = joined_pieces(pieces);
  while (line.size() > width && pieces.size() > 1) {
    pieces.erase(std::min_element(pieces.begin(), pieces.end(), [](const auto& a, const auto& b) {
      return a.urgency < b.urgency;
    }));
    line = joined_pieces(pieces);
  }
  return line.substr(0, width);
}

ProgressMode progress_mode(bool quiet) {
  if (quiet) return ProgressMode::none;
  return ::isatty(STDOUT_FILENO) == 1 ? ProgressMode::live : ProgressMode::lines;
}

std::size_t terminal_width() {
  constexpr std::size_t usual = 80;
  winsize size{};
  const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : usual;
}

void Progress::update(const ProgressStatus& status) {
  if (mode_ == ProgressMode::none) return;
  const double interval = mode_ == ProgressMode::live ? live_interval : interval_;
  if (shown_at_ && status.elapsed < *shown_at_ + interval) {
    held_back_ = status;
    return;
  }
  show(status);
}

void Progress::show(const ProgressStatus& status) {
  if (mode_ == ProgressMode::live) {
    // The last column stays free: some terminals wrap there.
    stream_ << clear_line << progress_line(status, width_ - 1) << std::flush;
    line_open_ = true;
  } else {
    constexpr std::size_t no_limit = 500;
    stream_ << progress_line(status, no_limit) << std::endl;
  }
  shown_at_ = status.elapsed;
  held_back_.reset();
}

void Progress::say(const std::string& line) {
  if (mode_ == ProgressMode::none) return;
  if (line_open_) stream_ << clear_line;
  line_open_ = false;
  stream_ << line << std::endl;
}

void Progress::finish() {
  if (held_back_) show(*held_back_);
  if (line_open_) stream_ << std::endl;
  line_open_ = false;
}

}  // namespace program
