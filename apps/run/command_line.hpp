#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "program/exit_code.hpp"
#include "run/request.hpp"

namespace run {

/// Seconds of `5h`, `30m`, `90s` or a sum like `1h30m`; nothing if it is no such duration.
[[nodiscard]] std::optional<double> parse_duration(std::string_view text);

/// What the scene is, for --check and the log: body, particles, materials, resolved choices, steps.
[[nodiscard]] std::string scene_summary(const scene::Scene& scene);

/// What runs a request: `run_scene` in the program, something smaller in tests.
using Runner = std::function<program::ExitCode(const RunRequest&)>;

/// The program fpm-run without its process: reads the command line and the scene, answers what
/// needs no run, else hands the request to `runner`. Exceptions end here, each as one clear
/// message.
/// @param arguments  without the program's name
/// @param out, err   standard output and standard error
[[nodiscard]] program::ExitCode fpm_run(std::span<const std::string> arguments, std::ostream& out,
                                        std::ostream& err, const Runner& runner);

}  // namespace run
