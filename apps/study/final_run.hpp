#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "program/exit_code.hpp"

namespace scene {
struct Scene;
}

namespace study {

/// The run of fpm-run that the user wants in the end.
struct FinalRun {
  std::filesystem::path scene_file;
  std::vector<std::string> settings;  // --set of the user
  std::filesystem::path folder;       // of the output
  int threads = 1;
  bool quiet = false;
  std::filesystem::path programs;  // folder of fpm-run
};

/// The folder that fpm-run itself would take: asked for, the scene's, or out/ and its name.
[[nodiscard]] std::filesystem::path output_folder(const std::filesystem::path& asked,
                                                  const std::filesystem::path& scene_file,
                                                  const scene::Scene& scene);

/// That run with more settings, in this process' place.
[[nodiscard]] program::ExitCode become_run(const FinalRun& run,
                                           const std::vector<std::string>& settings,
                                           std::ostream& out);

}  // namespace study
