#include "wiring/run_start.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "wiring/checkpoint.hpp"
#include "wiring/checkpoint_folder.hpp"
#include "wiring/state_file.hpp"

namespace wiring {

namespace {

std::filesystem::path newest_checkpoint(const std::filesystem::path& directory,
                                        std::vector<std::string>& objections) {
  const std::filesystem::path folder = directory / "checkpoints";
  if (const auto newest = newest_usable(folder, objections)) return *newest;
  throw FileError(folder, objections.empty() ? "there is no checkpoint to resume from"
                                             : fmt::format("no checkpoint is usable:\n  {}",
                                                           fmt::join(objections, "\n  ")));
}

std::string older_usable(const std::filesystem::path& checkpoint) {
  const auto step = step_of(checkpoint);
  if (!step) return "";
  std::vector<std::string> ignored;
  const auto folder = checkpoint.has_parent_path() ? checkpoint.parent_path() : ".";
  const auto older = newest_usable(folder, ignored, step);
  return older ? "; the next older usable one is " + older->string()
               : "; there is no older usable one";
}

std::vector<std::string> refusals_among(const std::vector<SceneChange>& changes) {
  std::vector<std::string> refusals;
  for (const SceneChange& change : changes) {
    if (change.allowed) continue;
    refusals.push_back(fmt::format("{}: the checkpoint has {}, the scene {}; it may not change",
                                   change.key, change.before, change.after));
  }
  return refusals;
}

std::vector<Ancestor> lineage_from(const std::filesystem::path& checkpoint,
                                   const CheckpointNotes& notes,
                                   const std::vector<SceneChange>& changes) {
  Ancestor parent{std::filesystem::absolute(checkpoint).lexically_normal().string(),
                  notes.history.back().step,
                  notes.created,
                  identity_of(notes.digest),
                  {}};
  for (const SceneChange& change : changes) parent.changed.push_back(change.text());
  std::vector<Ancestor> lineage = notes.lineage;
  lineage.push_back(std::move(parent));
  return lineage;
}

template <int Dim>
void resume(const std::filesystem::path& checkpoint, const Scene& scene, const Model<Dim>& model,
            RunStart<Dim>& start) {
  CheckpointNotes notes;
  const Hdf5File file = open_checkpoint(checkpoint, notes);
  const Scene former = scene_of(checkpoint, notes);
  start.checkpoint = checkpoint;
  start.changes = scene_changes(former, scene);
  start.refusals = refusals_among(start.changes);
  if (!start.refusals.empty()) return;
  start.state = read_state(file, model);
  start.lineage = lineage_from(checkpoint, notes, start.changes);
  start.history = std::move(notes.history);
  start.research_changed = former.research != scene.research;
  if (!adapt_programme(former, scene, start.state.programme)) {
    start.refusals.push_back(
        fmt::format("drive.target: the checkpoint is already at {} m, beyond the scene's {} m",
                    start.history.back().settlement, scene.drive.target));
  }
}

}  // namespace

template <int Dim>
RunStart<Dim> start_of(const RunRequest& request, const Model<Dim>& model) {
  RunStart<Dim> start;
  if (!request.resume) {
    start.state = initial_state(model, request.scene);
    return start;
  }
  const std::filesystem::path checkpoint =
      request.resume->checkpoint.empty() ? newest_checkpoint(request.directory, start.warnings)
                                         : request.resume->checkpoint;
  try {
    resume(checkpoint, request.scene, model, start);
  } catch (const FileError& failure) {
    throw FileError(failure.file(), failure.reason() + older_usable(checkpoint));
  }
  return start;
}

template RunStart<2> start_of<2>(const RunRequest&, const Model<2>&);
template RunStart<3> start_of<3>(const RunRequest&, const Model<3>&);

}  // namespace wiring
