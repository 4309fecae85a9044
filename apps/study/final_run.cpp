#include "study/final_run.hpp"

#include <fmt/format.h>

#include <ostream>

#include "program/child_process.hpp"
#include "scene/scene.hpp"

namespace study {

std::filesystem::path output_folder(const std::filesystem::path& asked,
                                    const std::filesystem::path& scene_file,
                                    const scene::Scene& scene) {
  if (!asked.empty()) return asked;
  if (scene.output.directory) return *scene.output.directory;
  return std::filesystem::path("out") / scene_file.stem();
}

program::ExitCode become_run(const FinalRun& run, const std::vector<std::string>& settings,
                             std::ostream& out) {
  std::vector<std::string> arguments{run.scene_file.string(), "--out", run.folder.string(),
                                     "--threads", fmt::format("{}", run.threads)};
  if (run.quiet) arguments.emplace_back("--quiet");
  for (const auto& list : {run.settings, settings}) {
    for (const std::string& setting : list) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
  }
  out.flush();
  program::become(run.programs / "fpm-run", arguments);
}

}  // namespace study
