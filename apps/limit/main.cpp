#include <iostream>
#include <string>
#include <vector>

#include "limit/command_line.hpp"

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return program::to_int(limit::fpm_limit(arguments, std::cout, std::cerr));
}
