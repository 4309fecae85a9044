// fpm-info: says in plain text what a checkpoint, a frame or an output folder holds.

#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "files/durable_file.hpp"
#include "info/describe.hpp"
#include "program/exit_code.hpp"
#include "program/version.hpp"

namespace {

using namespace info;
using program::ExitCode;

constexpr const char* usage =
    "Usage: fpm-info FILE|FOLDER ...\n"
    "       fpm-info --scene CHECKPOINT\n"
    "\n"
    "Says what checkpoints, frames (*.hdf) or output folders of fpm-run hold. Of a checkpoint:\n"
    "step, when, why and by which versions it was written, from which others it comes, and what a\n"
    "run that goes on from it may change; then groups, datasets with type, shape and unit. Every\n"
    "byte of a checkpoint is checked. Of a folder: whether a run is at work in it, and each\n"
    "checkpoint.\n"
    "\n"
    "  --scene  prints the scene that a checkpoint was written with, every key, as a scene file\n"
    "\n"
    "Exit codes: 0 done, 2 wrong use, 4 a file is unusable.\n";

std::string described(const std::string& path, bool scene) {
  if (scene) return scene_in(path);
  return std::filesystem::is_directory(path) ? describe_folder(path) : describe_file(path);
}

ExitCode describe_all(const std::vector<std::string>& paths, bool scene) {
  ExitCode code = ExitCode::done;
  for (const std::string& path : paths) {
    try {
      std::cout << described(path, scene);
    } catch (const files::FileError& failure) {
      std::cerr << "error: " << failure.what() << '\n';
      code = ExitCode::checkpoint_unusable;
    }
  }
  return code;
}

ExitCode run(const std::vector<std::string>& arguments) {
  std::vector<std::string> paths;
  bool scene = false;
  for (const std::string& argument : arguments) {
    if (argument == "--scene") {
      scene = true;
      continue;
    }
    if (argument == "--help") {
      std::cout << usage;
      return ExitCode::done;
    }
    if (argument == "--version") {
      std::cout << "fpm-info " << program::version << '\n';
      return ExitCode::done;
    }
    if (argument.starts_with("--")) {
      std::cerr << "error: " << argument << ": no such option\nTry fpm-info --help.\n";
      return ExitCode::input_refused;
    }
    paths.push_back(argument);
  }
  if (paths.empty()) {
    std::cerr << "error: FILE or FOLDER is missing\nTry fpm-info --help.\n";
    return ExitCode::input_refused;
  }
  return describe_all(paths, scene);
}

}  // namespace

int main(int count, char** words) {
  try {
    return program::to_int(run({words + 1, words + count}));
  } catch (const std::exception& failure) {
    std::cerr << "internal error: " << failure.what() << "\nThis is a bug: please report it.\n";
    return program::to_int(ExitCode::bug);
  }
}
