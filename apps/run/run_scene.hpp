#pragma once

#include "program/exit_code.hpp"
#include "run/request.hpp"

namespace run {

/// Runs (or with `check_only` only builds) one scene.
/// @return how it ended, see program::ExitCode. Numerical failure is a value; exceptions are misuse
/// or environment (disk, memory) and are turned into a message by the caller.
[[nodiscard]] program::ExitCode run_scene(const run::RunRequest& request);

}  // namespace run
