#pragma once

#include <ostream>

#include "wiring/exit_code.hpp"
#include "wiring/run_request.hpp"
#include "wiring/system_calls.hpp"

namespace wiring {

/// Runs a request from its start, fresh or resumed, to the end of its programme, to failure or to
/// the stop that was asked for; with `check_only` builds everything and writes no file.
/// @param out  progress and results
/// @param err  what is refused; warnings and failures go to standard error by the log
/// @throws FileError if a checkpoint is unusable or a result cannot be written; the message names
/// the last good checkpoint.
/// @param system  by which all results are written
[[nodiscard]] ExitCode run_programme(const RunRequest& request, std::ostream& out,
                                     std::ostream& err, const SystemCalls& system = system_calls());

/// Threads for a body: those asked for, else as many as OpenMP offers and the body keeps busy.
[[nodiscard]] int thread_count(int asked, std::int64_t particles);

}  // namespace wiring
