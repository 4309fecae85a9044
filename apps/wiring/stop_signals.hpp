#pragma once

#include <csignal>

namespace wiring {

/// While it lives, the first SIGINT or SIGTERM is a request to stop, to be asked for; a second one
/// ends the process at once, as without this class. One at a time.
class StopSignals {
 public:
  StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;
  /// Puts the former handlers back.
  ~StopSignals();

  /// The number of the signal that came, or 0.
  [[nodiscard]] int received() const;

 private:
  struct sigaction interrupt_ {};
  struct sigaction terminate_ {};
};

}  // namespace wiring
