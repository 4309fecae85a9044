#include <iostream>
#include <string>
#include <vector>

#include "run/command_line.hpp"
#include "run/run_scene.hpp"

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return program::to_int(run::fpm_run(arguments, std::cout, std::cerr, run::run_scene));
}
