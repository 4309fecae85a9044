#pragma once

#include <chrono>
#include <ostream>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "program/logging.hpp"
#include "program/progress.hpp"
#include "record/checkpoint_file.hpp"
#include "record/curve.hpp"
#include "record/frames.hpp"
#include "record/run_folder.hpp"
#include "run/request.hpp"
#include "run/start.hpp"
#include "stepping/stepper.hpp"

namespace run {

/// All that observes a run: curve, frames, checkpoints, progress and log. Outputs of an earlier run
/// are cut back to the checkpoint the run goes on from, so that they have each step once.
template <int Dim>
class Recorder {
 public:
  /// Prepares the folder for this start; a fresh run gets its row, and its frame, of step 0.
  /// @param state  of the run, always at a converged step when a member is called
  /// @throws FileError
  Recorder(const RunRequest& request, const record::RunFolder& folder,
           const model::Model<Dim>& model, const RunStart<Dim>& start, model::State<Dim>& state,
           std::ostream& out);

  /// Gives a branch a checkpoint of its own before its first step: it no longer needs the folder it
  /// comes from. Does nothing for a run that has one.
  void begin_branch();

  /// Records a converged step; checkpoints and frames as often as the scene says.
  void take(const stepping::StepRecord& record);

  /// Ends the record: the last frame, unless the run is merely interrupted, and a checkpoint of the
  /// state unless there is one.
  void finish(const std::string& reason, bool interrupted);

  /// Writes what a failed attempt left to the folder's failure file, beside the fields of the last
  /// converged state.
  void write_failure(const stepping::StepResult& result);

  /// One line for the user and the log.
  void say(const std::string& line);
  program::Log& log() { return log_; }

  [[nodiscard]] const std::vector<record::CurveRow>& history() const { return history_; }
  /// The last checkpoint written or resumed from; empty if there is none.
  [[nodiscard]] const std::filesystem::path& last_checkpoint() const { return last_checkpoint_; }
  /// Seconds of the whole run, those before the checkpoint included.
  [[nodiscard]] double elapsed() const;

 private:
  void write_frame();
  void write_checkpoint(const std::string& reason);
  [[nodiscard]] std::string why_checkpoint_is_due() const;
  program::ProgressStatus status(const stepping::StepRecord& record) const;

  const scene::Scene& scene_;
  const model::Model<Dim>& model_;
  model::State<Dim>& state_;
  const record::RunFolder& folder_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::vector<record::CurveRow> history_;
  record::CheckpointNotes notes_;
  double earlier_ = 0.0;  // [s] of the run before the checkpoint
  std::filesystem::path last_checkpoint_;
  std::int64_t checkpointed_step_ = -1;
  double checkpointed_at_ = 0.0;  // [s] of elapsed()
  std::int64_t cuts_ = 0;
  std::int64_t re_searched_ = 0;

  std::optional<std::filesystem::path> previous_;
  program::Log log_;
  record::CurveFile curve_;
  record::Frames frames_;
  program::Progress progress_;
};

}  // namespace run
