#include <iostream>
#include <string>
#include <vector>

#include "program/thread_waiting.hpp"
#include "run/command_line.hpp"
#include "run/run_scene.hpp"

int main(int count, char** words) {
  program::wait_briefly(words);
  const std::vector<std::string> arguments(words + 1, words + count);
  return program::to_int(run::fpm_run(arguments, std::cout, std::cerr, run::run_scene));
}
