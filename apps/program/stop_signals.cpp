#include "program/stop_signals.hpp"

#include <cstddef>

namespace program {

namespace {

struct Known {
  int number;
  bool stops;  // else it is ignored
  std::string_view name;
};
constexpr std::array<Known, 6> known{{{SIGINT, true, "SIGINT"},
                                      {SIGTERM, true, "SIGTERM"},
                                      {SIGHUP, true, "SIGHUP"},
                                      {SIGXCPU, true, "SIGXCPU"},
                                      {SIGXFSZ, false, "SIGXFSZ"},
                                      {SIGPIPE, false, "SIGPIPE"}}};

// A handler can reach nothing but what is static.
volatile std::sig_atomic_t received_signal = 0;

extern "C" void take_signal(int number) {
  received_signal = number;
  for (const Known& signal : known) {
    if (signal.stops) std::signal(signal.number, SIG_DFL);
  }
}

}  // namespace

StopSignals::StopSignals() {
  received_signal = 0;
  for (std::size_t i = 0; i < known.size(); ++i) {
    struct sigaction action {};
    action.sa_handler = known[i].stops ? take_signal : SIG_IGN;
    action.sa_flags = SA_RESTART;  // a write to disk that is under way is not to fail
    sigemptyset(&action.sa_mask);
    sigaction(known[i].number, nullptr, &former_[i]);
    if (former_[i].sa_handler != SIG_IGN) sigaction(known[i].number, &action, nullptr);
  }
}

StopSignals::~StopSignals() {
  for (std::size_t i = 0; i < known.size(); ++i) sigaction(known[i].number, &former_[i], nullptr);
}

int StopSignals::received() const {
  return received_signal;
}

std::string_view StopSignals::name() const {
  for (const Known& signal : known) {
    if (signal.number == received_signal) return signal.name;
  }
  return "";
}

}  // namespace program
