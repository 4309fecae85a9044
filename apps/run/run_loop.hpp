#pragma once

#include <ostream>

#include "files/system_calls.hpp"
#include "program/exit_code.hpp"
#include "run/request.hpp"

namespace run {

/// Runs a request from its start, fresh or resumed, to the end of its programme, to failure or to
/// the stop that was asked for; with `check_only` builds everything and writes no file.
/// @param out  progress and results
/// @param err  what is refused; warnings and failures go to standard error by the log
/// @throws FileError if a checkpoint is unusable or a result cannot be written; the message names
/// the last good checkpoint.
/// @param system  by which all results are written
[[nodiscard]] program::ExitCode run_programme(
    const RunRequest& request, std::ostream& out, std::ostream& err,
    const files::SystemCalls& system = files::system_calls());

/// Threads for a body: those asked for, else as many as OpenMP offers and the body keeps busy.
[[nodiscard]] int thread_count(int asked, std::int64_t particles);

}  // namespace run
