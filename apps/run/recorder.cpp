#include "run/recorder.hpp"

#include <fmt/format.h>

#include "files/durable_file.hpp"
#include "files/time_stamp.hpp"
#include "model/checkpoint.hpp"
#include "model/particle_fields.hpp"
#include "program/version.hpp"
#include "record/checkpoint_folder.hpp"
#include "stepping/failure_report.hpp"

namespace run {

namespace {

record::CurveRow row_of(const stepping::StepRecord& record, const scene::Scene& scene,
                        double wall) {
  record::CurveRow row;
  row.step = record.step;
  row.load_parameter = record.load;
  row.settlement = record.settlement;
  const double length = scene.drive.reference_length.value_or(0.0);
  row.settlement_over_B = length > 0.0 ? record.settlement / length : 0.0;
  row.reaction = record.reaction;
  row.mean_pressure = record.mean_pressure;
  row.corrected_pressure = record.corrected_pressure;
  row.increment = record.increment;
  row.newton_iterations = record.newton_iterations;
  row.residual_evaluations = record.residual_evaluations;
  row.jacobian_actions = record.jacobian_actions;
  row.evaluations = record.evaluations;
  row.cuts = record.cuts;
  row.plastic_particles = record.plastic_particles;
  row.re_searched_rows = record.re_searched_rows;
  row.residual_ratio = record.residual_ratio;
  row.max_plastic_strain = record.max_plastic_strain;
  row.hourglass_work_ratio = record.hourglass_work_ratio;
  row.wall = wall;
  return row;
}

// Time in frames: what the user drives, so that it does not depend on the target.
double time_of(const record::CurveRow& row, const scene::Scene& scene) {
  return scene.drive.kind == scene::DriveKind::displacement ? row.settlement : row.load_parameter;
}

// Whether the run goes on in the folder of its checkpoint, instead of branching off into another.
template <int Dim>
bool same_folder(const record::RunFolder& folder, const RunStart<Dim>& start) {
  std::error_code absent;
  return !start.checkpoint.empty() &&
         std::filesystem::equivalent(folder.checkpoints(),
                                     std::filesystem::absolute(start.checkpoint).parent_path(),
                                     absent);
}

template <int Dim>
std::optional<std::filesystem::path> make_room(const record::RunFolder& folder,
                                               const RunStart<Dim>& start) {
  if (!same_folder(folder, start)) return folder.set_previous_aside();
  std::error_code ignored;
  std::filesystem::remove(folder.failure(), ignored);  // of a run that now goes on
  record::set_aside_later(folder.checkpoints(), start.state.programme.step, folder.system());
  return std::nullopt;
}

template <int Dim>
record::CurveFile curve_for(const record::RunFolder& folder, const RunStart<Dim>& start) {
  if (start.history.empty()) return record::CurveFile::create(folder.curve(), Dim, folder.system());
  files::write_text_durably(folder.curve(), record::curve_text(Dim, start.history),
                            folder.system());
  return record::CurveFile::resume(folder.curve(), folder.curve(), Dim, start.history.back().step,
                                   folder.system());
}

template <int Dim>
record::Frames frames_for(const record::RunFolder& folder, const scene::Scene& scene,
                          const RunStart<Dim>& start) {
  if (start.history.empty()) return {folder, scene.output, 0, std::nullopt};
  const record::CurveRow& last = start.history.back();
  return {folder, scene.output, last.step, time_of(last, scene)};
}

}  // namespace

template <int Dim>
Recorder<Dim>::Recorder(const RunRequest& request, const record::RunFolder& folder,
                        const model::Model<Dim>& model, const RunStart<Dim>& start,
                        model::State<Dim>& state, std::ostream& out)
    : scene_(request.scene),
      model_(model),
      state_(state),
      folder_(folder),
      history_(start.history),
      notes_(model::notes_for(request.scene)),
      previous_(make_room(folder, start)),
      log_(folder.log()),
      curve_(curve_for(folder, start)),
      frames_(frames_for(folder, request.scene, start)),
      progress_(out, program::progress_mode(request.quiet), program::terminal_width()) {
  notes_.versions = program::with_versions("fpm-run");
  files::create_folder(folder_.checkpoints(), folder_.system());
  if (previous_) say(fmt::format("results of an earlier run are now in {}", previous_->string()));
  if (!history_.empty()) {
    notes_.lineage = start.lineage;
    last_checkpoint_ = start.checkpoint;
    if (same_folder(folder, start)) checkpointed_step_ = history_.back().step;
    earlier_ = checkpointed_at_ = history_.back().wall;
    for (const record::CurveRow& row : history_) {
      cuts_ += row.cuts;
      re_searched_ += row.re_searched_rows;
    }
    return;
  }
  history_.push_back(row_of(stepping::StepRecord{}, scene_, 0.0));
  curve_.append(history_.back());
  if (frames_.due(0)) write_frame();
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
void Recorder<Dim>::take(const stepping::StepRecord& record) {
  history_.push_back(row_of(record, scene_, elapsed()));
  cuts_ += record.cuts;
  re_searched_ += record.re_searched_rows;
  curve_.append(history_.back());
  progress_.update(status(record));
  constexpr std::size_t no_limit = 500;
  log_.info(progress_line(status(record), no_limit));
  // The frame first: a run that goes on from the checkpoint does not write it again.
  if (frames_.due(record.step)) write_frame();
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
  if (!interrupted && frames_.lacks(state_.programme.step)) write_frame();
  if (checkpointed_step_ != state_.programme.step) write_checkpoint(reason);
}

template <int Dim>
void Recorder<Dim>::write_failure(const stepping::StepResult& result) {
  auto fields = particle_fields(model_, state_, {});
  for (files::PointField& field : stepping::failure_fields(model_, result))
    fields.push_back(std::move(field));
  const record::CurveRow& row = history_.back();
  files::write_frame(folder_.failure(), row.step, time_of(row, scene_),
                     model::current_points(model_, state_), fields, scene_.output.compression,
                     folder_.system());
}

template <int Dim>
void Recorder<Dim>::say(const std::string& line) {
  progress_.say(line);
  log_.info(line);
}

template <int Dim>
void Recorder<Dim>::write_frame() {
  const record::CurveRow& row = history_.back();
  frames_.write(row.step, time_of(row, scene_), model::current_points(model_, state_),
                particle_fields(model_, state_, scene_.output.fields));
}

template <int Dim>
void Recorder<Dim>::write_checkpoint(const std::string& reason) {
  curve_.sync();
  notes_.reason = reason;
  notes_.created = files::time_stamp(folder_.system().time());
  notes_.history = history_;
  const std::int64_t step = state_.programme.step;
  const std::filesystem::path path = folder_.checkpoints() / record::checkpoint_name(step);
  model::write_checkpoint(path, model_, state_, notes_,
                          model::particle_fields(model_, state_, scene_.output.fields),
                          scene_.output.compression, folder_.system());
  last_checkpoint_ = path;
  checkpointed_step_ = step;
  checkpointed_at_ = elapsed();
  const record::Retention retention{scene_.output.checkpoints_kept,
                                    scene_.output.checkpoints_kept_every};
  record::remove_older(folder_.checkpoints(), step, retention, folder_.system());
}

template <int Dim>
program::ProgressStatus Recorder<Dim>::status(const stepping::StepRecord& record) const {
  program::ProgressStatus status;
  status.step = record.step;
  status.fraction = record.load;
  const bool displaced = scene_.drive.kind == scene::DriveKind::displacement;
  if (displaced && scene_.drive.reference_length) {
    status.settlement_over_B = history_.back().settlement_over_B;
  }
  if (displaced && scene_.drive.width) status.mean_pressure = record.mean_pressure;
  status.newton_iterations = record.newton_iterations;
  status.evaluations = record.evaluations;
  status.residual_ratio = record.residual_ratio;
  status.cuts = cuts_;
  status.yielding_share =
      static_cast<double>(record.plastic_particles) / static_cast<double>(model_.size());
  status.re_searched_rows = re_searched_;
  status.elapsed = history_.back().wall;
  return status;
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace run
