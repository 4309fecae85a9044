#pragma once

namespace program {

/// Exit codes of every program of this project; scripts may rely on them.
enum class ExitCode : int {
  done = 0,
  bug = 1,                  // an internal error: please report it
  input_refused = 2,        // scene, setting or command line; nothing was written
  not_converged = 3,        // the message names the last good checkpoint
  checkpoint_unusable = 4,  // the message names the next older usable one, if any
  interrupted = 75,         // stopped by a signal or --max-wall; the run can be resumed
};

/// The number a program returns to the shell.
[[nodiscard]] constexpr int to_int(ExitCode code) {
  return static_cast<int>(code);
}

}  // namespace program
