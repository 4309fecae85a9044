#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace scene {
struct Scene;
}

namespace run {

/// From which checkpoint a run goes on.
struct ResumeFrom {
  std::filesystem::path checkpoint;       // or a run's folder; empty: the output folder: its newest
  std::optional<std::size_t> stage = {};  // with which it goes on, from the end of the one before
};

/// How accurate a run is to be, in the words of the user; fpm-study sees to it.
struct AccuracyWish {
  std::string accuracy;                 // 2%
  std::optional<std::string> budget;    // 10min
  std::optional<std::string> quantity;  // of what
  std::optional<std::string> far;       // left,bottom: sides that are only where the ground ends
};

/// One run as asked for on the command line: the checked scene and what is not part of it.
struct RunRequest {
  std::shared_ptr<const scene::Scene> scene;
  std::filesystem::path scene_file;
  std::filesystem::path directory;       // output folder, resolved from --out, scene and file name
  std::vector<std::string> settings;     // the --set arguments, already applied to `scene`
  std::optional<ResumeFrom> resume;      // absent: a fresh run
  std::optional<AccuracyWish> accuracy;  // absent: as fine as the scene says
  std::optional<std::string> quality;    // draft, normal, fine; fpm-study sees to it, too
  bool check_only = false;               // build the model, report particles and memory, do not run
  std::filesystem::path drawing;         // where the scene is drawn, of a check; empty: nowhere
  int threads = 0;                       // 0: OpenMP's own choice
  std::optional<double> max_wall_s;      // [s] stop at the first converged step after it
  bool quiet = false;
  std::filesystem::path limit_program;  // fpm-limit, for `limit.check`
};

}  // namespace run
