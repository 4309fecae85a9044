#pragma once

#include <boost/program_options.hpp>
#include <functional>
#include <ostream>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "program/exit_code.hpp"

namespace program {

/// The command line cannot be understood, or asks for what does not exist.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The values of a command line: its options, and under `positional` the words that are none.
/// Options are not abbreviated: a script must not change its meaning when one is added.
/// @throws UsageError, with the nearest option's name where one is near.
[[nodiscard]] boost::program_options::variables_map parse(
    std::span<const std::string> arguments, const boost::program_options::options_description& all,
    const char* positional);

/// The texts given for an option, or for what is positional.
[[nodiscard]] std::vector<std::string> texts(const boost::program_options::variables_map& values,
                                             const char* name);

/// A program without its process: what `run` returns; exceptions end here, each as one clear
/// message and an exit code. A UsageError is input refused, a files::FileError a file that cannot
/// be used, anything else a bug of ours.
/// @param name  of the program, to whose --help wrong use is sent
[[nodiscard]] ExitCode run_program(std::string_view name, std::ostream& err,
                                   const std::function<ExitCode()>& run);

}  // namespace program
