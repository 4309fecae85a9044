#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "campaign/outcome.hpp"
#include "record/run_lock.hpp"

namespace scene {
struct Scene;
}

namespace campaign {

/// One run to be made.
struct Task {
  std::string name;   // for the user
  std::string scene;  // text of its file, see task_scene
};

/// The text by which a scene is run: every key of it, less what does not touch the results: no
/// frames, few checkpoints, no bounds beside it.
[[nodiscard]] std::string task_scene(const scene::Scene& scene);

/// How runs are made.
struct Settings {
  std::filesystem::path program;  // fpm-run
  std::filesystem::path folder;   // where each has a folder of its own, by its digest
  int jobs = 1;                   // at a time
  int threads = 1;                // of each
};

/// How far a run is.
struct Status {
  enum class Stage { waiting, running, finished, failed };
  Stage stage = Stage::waiting;
  bool was_there = false;        // finished before this campaign began
  std::filesystem::path folder;  // of its output: curve.csv and the rest
  Outcome outcome;               // once it has ended
  double fraction = 0.0;         // 0 .. 1 of its programme
  double elapsed = 0.0;          // [s] of the process that runs
  double cpu = 0.0;              // [s] of processor time of it
  std::int64_t bytes = 0;        // what fpm-run --check says it needs; 0: not known
  std::int64_t steps = 0;        // planned, likewise
  std::string complaint;         // why it failed or was refused: the last word of fpm-run
};

/// Seconds until all have ended, by the pace so far; nothing before there is one.
[[nodiscard]] std::optional<double> time_left(const std::vector<Status>& all, int jobs);

/// Makes runs beside each other, each once: a run whose scene and program are those of one that has
/// finished in the folder is not made again, and one that was interrupted or killed goes on from
/// its checkpoint.
class Campaign {
 public:
  /// @throws FileError if the folder cannot be used, or another campaign is at work in it.
  Campaign(std::vector<Task> tasks, Settings settings);
  Campaign(const Campaign&) = delete;
  Campaign& operator=(const Campaign&) = delete;
  ~Campaign();

  /// Asks fpm-run about each run without making it: validates it and learns what it needs.
  /// @return whether all may be run; the complaints are in the status
  bool check();

  /// Makes all that are not made yet.
  /// @param watch  called now and then and after each end; false stops: what runs is interrupted,
  /// resumably, and waited for
  void run(const std::function<bool(const std::vector<Status>&)>& watch);

  [[nodiscard]] const std::vector<Status>& status() const { return status_; }

 private:
  struct Process;

  [[nodiscard]] std::filesystem::path home(std::size_t task) const;
  [[nodiscard]] bool may_start(std::size_t task) const;
  void start(std::size_t task);
  void look_at(std::size_t task);
  void end(std::size_t task, int exit_code);
  void stop_all();

  std::vector<Task> tasks_;
  Settings settings_;
  std::vector<Status> status_;
  std::vector<std::unique_ptr<Process>> processes_;  // of each task, or none
  std::unique_ptr<record::RunLock> lock_;
};

}  // namespace campaign
