#include "run/run_scene.hpp"

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include "program/child_process.hpp"
#include "run/run_loop.hpp"

namespace run {

namespace {

/// fpm-study makes the ladder, or knows the setting, and becomes the run that comes out of it.
[[noreturn]] void become_study(const RunRequest& request) {
  std::vector<std::string> arguments{
      request.scene_file.string(),
      request.quality ? "--quality" : "--accuracy",
      request.quality ? *request.quality : request.accuracy->accuracy,
      "--out",
      request.directory.string(),
      "--threads",
      std::to_string(std::max(1, request.threads))};
  const auto give = [&](const char* option, const std::string& value) {
    arguments.emplace_back(option);
    arguments.push_back(value);
  };
  if (request.accuracy) {
    if (request.accuracy->budget) give("--budget", *request.accuracy->budget);
    if (request.accuracy->quantity) give("--quantity", *request.accuracy->quantity);
    if (request.accuracy->far) give("--far", *request.accuracy->far);
  }
  for (const std::string& setting : request.settings) give("--set", setting);
  if (request.quiet) arguments.emplace_back("--quiet");
  program::become(program::folder_of_this_program() / "fpm-study", arguments);
}

}  // namespace

program::ExitCode run_scene(const run::RunRequest& request) {
  if (request.accuracy || request.quality) become_study(request);
  run::RunRequest complete = request;
  complete.limit_program = program::folder_of_this_program() / "fpm-limit";
  return run::run_programme(complete, std::cout, std::cerr);
}

}  // namespace run
