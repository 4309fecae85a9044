#include "run/recorder.hpp"

#include <fmt/format.h>

#include "files/time_stamp.hpp"
#include "model/checkpoint.hpp"
#include "model/particle_fields.hpp"
#include "program/version.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/checkpoint_name.hpp"
#include "scene/drives.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "stepping/failure_report.hpp"

namespace run {

template <int Dim>
Recorder<Dim>::Recorder(const RunRequest& request, const record::RunFolder& folder,
                        const model::Model<Dim>& model, const model::Measures<Dim>& measures,
                        const RunStart<Dim>& start, model::State<Dim>& state, Outputs outputs,
                        std::ostream& out)
    : scene_(*request.scene),
      model_(&model),
      measures_(&measures),
      state_(state),
      folder_(folder),
      outputs_(std::move(outputs)),
      progress_(out, program::progress_mode(request.quiet), program::terminal_width()),
      history_(start.history),
      notes_(model::notes_for(*request.scene)) {
  notes_.versions = program::with_versions("fpm-run");
  notes_.lineage = start.lineage;
  notes_.measures = measures_->columns();
  stage_ends_ = model::stage_ends(notes_.measures, history_);
  last_checkpoint_ = start.checkpoint;
  if (outputs_.holds_start) checkpointed_step_ = state_.programme.step;
  if (!history_.empty()) earlier_ = checkpointed_at_ = history_.back().wall;
}

template <int Dim>
void Recorder<Dim>::begin(const record::CurveRow& first) {
  if (outputs_.previous) {
    say(fmt::format("results of an earlier run are now in {}", outputs_.previous->string()));
  }
  if (!history_.empty()) return;
  append(first);
  if (outputs_.frames.due(0)) write_frame();
  write_checkpoint("start of the run");
}

template <int Dim>
double Recorder<Dim>::elapsed() const {
  const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begin_;
  return earlier_ + now.count();
}

template <int Dim>
void Recorder<Dim>::begin_branch() {
  if (checkpointed_step_ == state_.programme.step) return;
  write_checkpoint("start of the branch");
}

template <int Dim>
void Recorder<Dim>::append(record::CurveRow row) {
  row.measures = measures_->of(state_);
  outputs_.curve.append(row);
  history_.push_back(std::move(row));
}

template <int Dim>
void Recorder<Dim>::take(record::CurveRow row) {
  row.wall = elapsed();
  append(std::move(row));
  progress_.update(status());
  constexpr std::size_t no_limit = 500;
  outputs_.log.info(progress_line(status(), no_limit));
  // The frame first: a run that goes on from the checkpoint does not write it again.
  if (outputs_.frames.due(history_.back().step)) write_frame();
  const std::string why = why_checkpoint_is_due();
  if (!why.empty()) write_checkpoint(why);
}

template <int Dim>
std::string Recorder<Dim>::why_checkpoint_is_due() const {
  const scene::Output& output = scene_.output;
  const bool by_step =
      output.checkpoints_every > 0 && state_.programme.step % output.checkpoints_every == 0;
  if (by_step && output.checkpoints_every == 1) return "every step";
  if (by_step) return fmt::format("every {} steps", output.checkpoints_every);
  constexpr double minute = 60.0;  // [s]
  const double waited = (elapsed() - checkpointed_at_) / minute;
  const bool by_time =
      output.checkpoints_every_minutes > 0.0 && waited >= output.checkpoints_every_minutes;
  return by_time ? fmt::format("every {} minutes", output.checkpoints_every_minutes) : "";
}

template <int Dim>
void Recorder<Dim>::finish(const std::string& reason, bool interrupted) {
  progress_.finish();
  if (!interrupted && outputs_.frames.lacks(state_.programme.step)) write_frame();
  if (checkpointed_step_ != state_.programme.step) write_checkpoint(reason);
}

template <int Dim>
void Recorder<Dim>::end_stage(const std::string& title) {
  progress_.finish();
  say(fmt::format("{}: at its end", title));
  stage_ends_.push_back(state_.programme.step);
  if (outputs_.frames.lacks(state_.programme.step)) write_frame();
  if (checkpointed_step_ != state_.programme.step) write_checkpoint("end of " + title);
}

template <int Dim>
void Recorder<Dim>::enter(const model::Model<Dim>& model, const model::Measures<Dim>& measures) {
  model_ = &model;
  measures_ = &measures;
}

template <int Dim>
void Recorder<Dim>::write_failure(const stepping::StepResult& result) {
  auto fields = particle_fields(*model_, state_, {});
  for (files::PointField& field : stepping::failure_fields(*model_, result))
    fields.push_back(std::move(field));
  const record::CurveRow& row = history_.back();
  record::write_frame(folder_.failure(), row.step, time_of(row, scene_),
                      model::current_points(*model_, state_), fields, scene_.output.compression,
                      folder_.system());
}

template <int Dim>
void Recorder<Dim>::say(const std::string& line) {
  progress_.say(line);
  outputs_.log.info(line);
}

template <int Dim>
void Recorder<Dim>::write_frame() {
  const record::CurveRow& row = history_.back();
  outputs_.frames.write(row.step, time_of(row, scene_), model::current_points(*model_, state_),
                        particle_fields(*model_, state_, scene_.output.fields));
}

template <int Dim>
void Recorder<Dim>::write_checkpoint(const std::string& reason) {
  outputs_.curve.sync();
  notes_.reason = reason;
  notes_.created = files::time_stamp(folder_.system().time());
  notes_.history = history_;
  const std::int64_t step = state_.programme.step;
  const std::filesystem::path path = folder_.checkpoints() / record::checkpoint_name(step);
  model::write_checkpoint(path, *model_, state_, notes_,
                          model::particle_fields(*model_, state_, scene_.output.fields),
                          scene_.output.compression, folder_.system());
  last_checkpoint_ = path;
  checkpointed_step_ = step;
  checkpointed_at_ = elapsed();
  const record::Retention retention{scene_.output.checkpoints_kept,
                                    scene_.output.checkpoints_kept_every, stage_ends_};
  record::remove_older(folder_.checkpoints(), step, retention, folder_.system());
}

template <int Dim>
program::ProgressStatus Recorder<Dim>::status() const {
  const record::CurveRow& row = history_.back();
  program::ProgressStatus status;
  status.step = row.step;
  status.fraction = (static_cast<double>(state_.programme.stage) + state_.programme.progress) /
                    static_cast<double>(scene::stage_count(scene_));
  for (const scene::Drive* drive : scene::all_drives(scene_)) {
    if (drive->kind != scene::DriveKind::displacement) continue;
    if (drive->reference_length) status.settlement_over_B = row.settlement_over_B;
    if (drive->width) status.mean_pressure = row.mean_pressure;
  }
  status.newton_iterations = row.newton_iterations;
  status.evaluations = row.evaluations;
  status.residual_ratio = row.residual_ratio;
  status.yielding_share =
      static_cast<double>(row.plastic_particles) / static_cast<double>(model_->size());
  for (const record::CurveRow& each : history_) {
    status.cuts += each.cuts;
    status.re_searched_rows += each.re_searched_rows;
  }
  status.elapsed = row.wall;
  return status;
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace run
