#include "run/run_scene.hpp"

#include <iostream>

#include "wiring/run_loop.hpp"

wiring::ExitCode run_scene(const wiring::RunRequest& request) {
  return wiring::run_programme(request, std::cout, std::cerr);
}
