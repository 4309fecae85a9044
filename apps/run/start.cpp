#include "run/start.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/measures.hpp"
#include "model/state_file.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/checkpoint_name.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace run {

namespace {

std::filesystem::path newest_checkpoint(const std::filesystem::path& directory,
                                        std::vector<std::string>& objections) {
  const std::filesystem::path folder = directory / "checkpoints";
  if (const auto newest = record::newest_usable(folder, objections)) return *newest;
  throw files::FileError(folder, objections.empty() ? "there is no checkpoint to resume from"
                                                    : fmt::format("no checkpoint is usable:\n  {}",
                                                                  fmt::join(objections, "\n  ")));
}

// The checkpoint at the end of the stage before another.
std::filesystem::path end_of_former_stage(const std::filesystem::path& newest, std::size_t stage) {
  record::CheckpointNotes notes;
  (void)record::open_checkpoint(newest, notes);
  const std::vector<std::int64_t> ends = model::stage_ends(notes.measures, notes.history);
  if (stage <= ends.size()) return newest.parent_path() / record::checkpoint_name(ends[stage - 1]);
  if (notes.stage + 1 == static_cast<std::int64_t>(stage) && notes.progress >= 1.0) return newest;
  throw files::FileError(
      newest,
      fmt::format("stage {} of the run is not at its end, which the next one begins with", stage));
}

std::filesystem::path checkpoint_of(const RunRequest& request,
                                    std::vector<std::string>& objections) {
  const std::filesystem::path& given = request.resume->checkpoint;
  const bool is_folder = given.empty() || std::filesystem::is_directory(given);
  if (!is_folder) return given;
  const auto newest = newest_checkpoint(given.empty() ? request.directory : given, objections);
  return request.resume->stage ? end_of_former_stage(newest, *request.resume->stage) : newest;
}

std::string older_usable(const std::filesystem::path& checkpoint) {
  const auto step = record::step_of(checkpoint);
  if (!step) return "";
  std::vector<std::string> ignored;
  const auto folder = checkpoint.has_parent_path() ? checkpoint.parent_path() : ".";
  const auto older = record::newest_usable(folder, ignored, step);
  return older ? "; the next older usable one is " + older->string()
               : "; there is no older usable one";
}

std::vector<std::string> refusals_among(const std::vector<scene::SceneChange>& changes) {
  std::vector<std::string> refusals;
  for (const scene::SceneChange& change : changes) {
    if (change.allowed) continue;
    refusals.push_back(fmt::format("{}: the checkpoint has {}, the scene {}; it may not change",
                                   change.key, change.before, change.after));
  }
  return refusals;
}

std::vector<record::Ancestor> lineage_from(const std::filesystem::path& checkpoint,
                                           const record::CheckpointNotes& notes,
                                           const std::vector<scene::SceneChange>& changes) {
  record::Ancestor parent{std::filesystem::absolute(checkpoint).lexically_normal().string(),
                          notes.history.back().step,
                          notes.created,
                          record::identity_of(notes.digest),
                          {}};
  for (const scene::SceneChange& change : changes) parent.changed.push_back(change.text());
  std::vector<record::Ancestor> lineage = notes.lineage;
  lineage.push_back(std::move(parent));
  return lineage;
}

template <int Dim>
void resume(const std::filesystem::path& checkpoint, const scene::Scene& scene,
            const model::Model<Dim>& model, RunStart<Dim>& start) {
  record::CheckpointNotes notes;
  const files::Hdf5File file = record::open_checkpoint(checkpoint, notes);
  const scene::Scene former = model::scene_of(checkpoint, notes);
  start.checkpoint = checkpoint;
  start.changes = scene::scene_changes(former, scene, static_cast<std::size_t>(notes.stage));
  start.refusals = refusals_among(start.changes);
  if (!start.refusals.empty()) return;
  start.state = model::read_state(file, model, notes.schema);
  const std::string of_wall = note_on_wall(notes.schema, scene, notes.history);
  if (!of_wall.empty()) start.warnings.push_back(of_wall);
  start.lineage = lineage_from(checkpoint, notes, start.changes);
  start.history = std::move(notes.history);
  record::change_measures(start.history, notes.measures, start.measures);
  start.re_search_changed = former.re_search != scene.re_search;
  if (!model::adapt_programme(former, scene, start.state.programme)) {
    start.refusals.push_back(
        fmt::format("drive.target: the checkpoint is already at {} m, beyond the scene's {} m",
                    start.history.back().settlement, scene.drive.target));
  }
}

}  // namespace

std::string note_on_wall(std::int64_t schema, const scene::Scene& scene,
                         const std::vector<record::CurveRow>& history) {
  // Before schema 4 nothing kept the initial stress at rest, nor does anything on resume.
  constexpr std::int64_t schema_of_balance = 4, schema_of_walls = 9;
  const scene::InitialStressKind kind = scene.initial_stress.kind;
  const bool is_at_rest =
      kind == scene::InitialStressKind::geostatic || kind == scene::InitialStressKind::gravity;
  if (schema < schema_of_balance || !is_at_rest || !scene::drives_wall(scene)) return "";
  // The first programs of that schema left out walls whose particles are moved themselves.
  const bool is_direct = scene::resolve_drive_method(scene) == scene::DriveMethod::direct;
  const bool bore_nothing = is_direct && !history.empty() && history.front().reaction == 0.0;
  if (schema >= schema_of_walls && !bore_nothing) return "";
  return fmt::format(
      "the checkpoint is of schema {}: what the drive moves bore nothing of the initial stress "
      "when the run began, and bears it from now on, so that its reaction jumps: begin the run "
      "anew",
      schema);
}

InForce scene_in_force(const RunRequest& request) {
  if (!request.resume) return {request.scene};
  try {
    std::vector<std::string> ignored;
    const std::filesystem::path checkpoint = checkpoint_of(request, ignored);
    record::CheckpointNotes notes;
    (void)record::open_checkpoint(checkpoint, notes);
    auto scene = std::make_shared<scene::Scene>(*request.scene);
    scene::keep_methods(model::scene_of(checkpoint, notes), *scene);
    // A stage that the scene no longer has is refused with what changed.
    const std::size_t last = scene::stage_count(*scene) - 1;
    return {scene, std::min(static_cast<std::size_t>(notes.stage), last)};
  } catch (const files::FileError&) {
    return {request.scene};
  }
}

template <int Dim>
RunStart<Dim> find_start(const RunRequest& request, const stepping::StagedModel<Dim>& stages,
                         const std::vector<std::string>& measures) {
  RunStart<Dim> start;
  start.measures = measures;
  if (!request.resume) {
    start.state = stages.initial_state();
    return start;
  }
  const std::filesystem::path checkpoint = checkpoint_of(request, start.warnings);
  try {
    resume(checkpoint, *request.scene, stages.model(), start);
  } catch (const files::FileError& failure) {
    throw files::FileError(failure.file(), failure.reason() + older_usable(checkpoint));
  }
  return start;
}

template RunStart<2> find_start<2>(const RunRequest&, const stepping::StagedModel<2>&,
                                   const std::vector<std::string>&);
template RunStart<3> find_start<3>(const RunRequest&, const stepping::StagedModel<3>&,
                                   const std::vector<std::string>&);

}  // namespace run
