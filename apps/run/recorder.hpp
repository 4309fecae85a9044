#pragma once

#include <chrono>
#include <ostream>
#include <string>
#include <vector>

#include "model/measures.hpp"
#include "model/model.hpp"
#include "program/progress.hpp"
#include "record/checkpoint_file.hpp"
#include "record/curve.hpp"
#include "record/run_folder.hpp"
#include "run/outputs.hpp"
#include "run/request.hpp"
#include "run/start.hpp"
#include "stepping/stepper.hpp"

namespace run {

/// All that observes a run: curve, frames, checkpoints, progress and log.
template <int Dim>
class Recorder {
 public:
  /// @param state  of the run, always at a converged step when a member is called
  /// @param outputs  the folder as `prepare` left it for this start
  Recorder(const RunRequest& request, const record::RunFolder& folder,
           const model::Model<Dim>& model, const model::Measures<Dim>& measures,
           const RunStart<Dim>& start, model::State<Dim>& state, Outputs outputs,
           std::ostream& out);

  /// Begins the record; that of a fresh run with its row, its frame and its checkpoint of step 0.
  void begin(const record::CurveRow& first);

  /// Gives a branch a checkpoint of its own before its first step: it no longer needs the folder it
  /// comes from. Does nothing for a run that has one.
  void begin_branch();

  /// Records a converged step; checkpoints and frames as often as the scene says.
  /// @param row  but for the wall time and what is measured besides
  void take(record::CurveRow row);

  /// Ends the record: the last frame, unless the run is merely interrupted, and a checkpoint of the
  /// state unless there is one.
  void finish(const std::string& reason, bool interrupted);

  /// Writes what a failed attempt left to the folder's failure file, beside the fields of the last
  /// converged state.
  void write_failure(const stepping::StepResult& result);

  /// Ends a stage: a frame, and a checkpoint that stays, unless there are.
  void end_stage(const std::string& title);
  /// Goes on with another stage's model and measures, which must outlive it.
  void enter(const model::Model<Dim>& model, const model::Measures<Dim>& measures);

  /// One line for the user and the log.
  void say(const std::string& line);
  program::Log& log() { return outputs_.log; }

  [[nodiscard]] const std::vector<record::CurveRow>& history() const { return history_; }
  /// The last checkpoint written or resumed from; empty if there is none.
  [[nodiscard]] const std::filesystem::path& last_checkpoint() const { return last_checkpoint_; }
  /// Seconds of the whole run, those before the checkpoint included.
  [[nodiscard]] double elapsed() const;

 private:
  void append(record::CurveRow row);
  void write_frame();
  void write_checkpoint(const std::string& reason);
  [[nodiscard]] std::string why_checkpoint_is_due() const;
  [[nodiscard]] program::ProgressStatus status() const;

  const scene::Scene& scene_;
  const model::Model<Dim>* model_;
  const model::Measures<Dim>* measures_;
  model::State<Dim>& state_;
  const record::RunFolder& folder_;
  Outputs outputs_;
  program::Progress progress_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  double earlier_ = 0.0;  // [s] of the run before the checkpoint
  std::vector<record::CurveRow> history_;
  record::CheckpointNotes notes_;
  std::filesystem::path last_checkpoint_;
  std::vector<std::int64_t> stage_ends_;  // steps
  std::int64_t checkpointed_step_ = -1;
  double checkpointed_at_ = 0.0;  // [s] of elapsed()
};

}  // namespace run
