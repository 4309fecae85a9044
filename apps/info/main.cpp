// fpm-info: says in plain text what a checkpoint, a frame or an output folder holds.

#include <boost/program_options.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "files/file_error.hpp"
#include "info/describe.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"

namespace {

namespace po = boost::program_options;
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
    "checkpoint.\n";

po::options_description options() {
  po::options_description all("Options");
  all.add_options()  //
      ("scene", po::bool_switch(),
       "print the scene that a checkpoint was written with, every key, as a scene file")  //
      ("version", po::bool_switch(), "print the version")                                 //
      ("help", po::bool_switch(), "print this help");
  return all;
}

constexpr const char* exit_codes =
    "\nExit codes: 0 done, 1 internal error, 2 wrong use, 4 a file is unusable.\n";

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
  const po::variables_map values = program::parse(arguments, options(), "path");
  if (values["help"].as<bool>()) {
    std::cout << usage << '\n' << options() << exit_codes;
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    std::cout << "fpm-info " << program::version << '\n';
    return ExitCode::done;
  }
  const std::vector<std::string> paths = program::texts(values, "path");
  if (paths.empty()) throw program::UsageError("FILE or FOLDER is missing");
  return describe_all(paths, values["scene"].as<bool>());
}

}  // namespace

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return program::to_int(
      program::run_program("fpm-info", std::cerr, [&] { return run(arguments); }));
}
