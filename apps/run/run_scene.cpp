#include "run/run_scene.hpp"

#include <filesystem>
#include <iostream>
#include <system_error>

#include "wiring/run_loop.hpp"

wiring::ExitCode run_scene(const wiring::RunRequest& request) {
  wiring::RunRequest complete = request;
  std::error_code failure;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failure);
  complete.limit_program = self.parent_path() / "fpm-limit";
  return wiring::run_programme(complete, std::cout, std::cerr);
}
