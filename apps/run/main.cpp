#include <iostream>
#include <string>
#include <vector>

#include "run/run_scene.hpp"
#include "wiring/cli.hpp"

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return wiring::to_int(wiring::fpm_run(arguments, std::cout, std::cerr, run_scene));
}
