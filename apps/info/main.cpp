// fpm-info: says in plain text what a checkpoint, a frame or an output folder holds.

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "info/describe.hpp"
#include "wiring/durable_file.hpp"
#include "wiring/exit_code.hpp"
#include "wiring/version.hpp"

namespace {

using wiring::ExitCode;

constexpr const char* usage =
    "Usage: fpm-info FILE|FOLDER ...\n"
    "\n"
    "Says what checkpoints, frames (*.hdf) or output folders of fpm-run hold: step and versions,\n"
    "groups, datasets with type, shape and unit.\n"
    "\n"
    "Exit codes: 0 done, 2 wrong use, 4 a file is unusable.\n";

ExitCode describe_all(const std::vector<std::string>& paths) {
  ExitCode code = ExitCode::done;
  for (const std::string& path : paths) {
    try {
      const bool folder = std::filesystem::is_directory(path);
      std::cout << (folder ? describe_folder(path) : describe_file(path));
    } catch (const wiring::FileError& failure) {
      std::cerr << "error: " << failure.what() << '\n';
      code = ExitCode::checkpoint_unusable;
    }
  }
  return code;
}

ExitCode run(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    if (argument == "--help") {
      std::cout << usage;
      return ExitCode::done;
    }
    if (argument == "--version") {
      std::cout << "fpm-info " << wiring::version << '\n';
      return ExitCode::done;
    }
    if (argument.starts_with("--")) {
      std::cerr << "error: " << argument << ": no such option\nTry fpm-info --help.\n";
      return ExitCode::input_refused;
    }
  }
  if (arguments.empty()) {
    std::cerr << "error: FILE or FOLDER is missing\nTry fpm-info --help.\n";
    return ExitCode::input_refused;
  }
  return describe_all(arguments);
}

}  // namespace

int main(int count, char** words) {
  try {
    return wiring::to_int(run({words + 1, words + count}));
  } catch (const std::exception& failure) {
    std::cerr << "internal error: " << failure.what() << "\nThis is a bug: please report it.\n";
    return wiring::to_int(ExitCode::bug);
  }
}
