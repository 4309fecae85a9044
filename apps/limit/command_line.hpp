#pragma once

#include <ostream>
#include <span>
#include <string>

#include "program/exit_code.hpp"

namespace limit {

/// The program fpm-limit without its process. Exceptions end here, each as one clear message.
/// @param arguments  without the program's name
/// @param out, err   standard output and standard error
[[nodiscard]] program::ExitCode fpm_limit(std::span<const std::string> arguments, std::ostream& out,
                                          std::ostream& err);

}  // namespace limit
