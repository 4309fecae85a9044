#include "run/run_scene.hpp"

#include <iostream>

#include "program/child_process.hpp"
#include "run/run_loop.hpp"

namespace run {

program::ExitCode run_scene(const run::RunRequest& request) {
  run::RunRequest complete = request;
  complete.limit_program = program::folder_of_this_program() / "fpm-limit";
  return run::run_programme(complete, std::cout, std::cerr);
}

}  // namespace run
