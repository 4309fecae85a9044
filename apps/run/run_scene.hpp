#pragma once

#include "wiring/exit_code.hpp"
#include "wiring/run_request.hpp"

/// Runs (or with `check_only` only builds) one scene.
/// @return how it ended, see wiring::ExitCode. Numerical failure is a value; exceptions are misuse
/// or environment (disk, memory) and are turned into a message by the caller.
[[nodiscard]] wiring::ExitCode run_scene(const wiring::RunRequest& request);
