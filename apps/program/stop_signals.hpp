#pragma once

#include <array>
#include <csignal>
#include <string_view>

namespace program {

/// While it lives, the first SIGINT, SIGTERM, SIGHUP (the terminal is gone) or SIGXCPU (the batch
/// system's time is up) is a request to stop, to be asked for; a second one ends the process at
/// once, as without this class. A signal that was ignored, as SIGHUP under nohup, stays so. And a
/// file beyond the size limit or a reader of the output who left are errors of the write, where
/// SIGXFSZ and SIGPIPE would end the process. One object at a time.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// Puts the former handlers back.
  ~StopSignals();

  /// The number of the signal that came, or 0.
  [[nodiscard]] int received() const;
  /// Its name, or "".
  [[nodiscard]] std::string_view name() const;

 private:
  std::array<struct sigaction, 6> former_{};  // of each signal that is dealt with
};

}  // namespace program
