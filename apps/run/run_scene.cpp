#include "run/run_scene.hpp"

#include <filesystem>
#include <iostream>
#include <system_error>

#include "run/run_loop.hpp"

namespace run {

program::ExitCode run_scene(const run::RunRequest& request) {
  run::RunRequest complete = request;
  std::error_code failure;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failure);
  complete.limit_program = self.parent_path() / "fpm-limit";
  return run::run_programme(complete, std::cout, std::cerr);
}

}  // namespace run
