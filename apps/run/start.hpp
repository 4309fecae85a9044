#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "model/state.hpp"
#include "record/curve.hpp"
#include "record/lineage.hpp"
#include "run/request.hpp"
#include "scene/changes.hpp"
#include "stepping/staged_model.hpp"

namespace run {

/// What a run begins with, be it fresh or resumed; all else is made of it, the scene and the model.
template <int Dim>
struct RunStart {
  model::State<Dim> state;
  std::vector<std::string> measures;        // columns of the curve that the scene asks for
  std::vector<record::CurveRow> history;    // the curve so far; empty: a fresh run
  std::filesystem::path checkpoint;         // where the state is from; empty: a fresh run
  std::vector<record::Ancestor> lineage;    // of the state, its checkpoint last
  std::vector<scene::SceneChange> changes;  // since the checkpoint, all allowed
  std::vector<std::string> refusals;  // why the run may not go on; the state is then not to be used
  std::vector<std::string> warnings;  // newer checkpoints that are damaged; what older ones lack
  bool re_search_changed = false;
};

/// What a run begins with, before there is a model.
struct InForce {
  std::shared_ptr<const scene::Scene> scene;
  std::size_t stage = 0;
};

/// The scene of a request: with methods that it leaves to `auto` as the run to resume has them
/// (keep_methods); and the stage of that. What is wrong with the checkpoint is left for
/// `find_start` to say.
InForce scene_in_force(const RunRequest& request);

/// What to say of a wall that bore nothing when an older program began the run; nothing: "".
/// @param history  the run's curve so far
[[nodiscard]] std::string note_on_wall(std::int64_t schema, const scene::Scene& scene,
                                       const std::vector<record::CurveRow>& history);

/// The start of a run: the scene's initial state, or the state of the checkpoint that the request
/// names or, if it names none, of the newest usable one in the output folder.
/// @param stages  at the stage of `scene_in_force`
/// @param measures  columns of the curve that the scene asks for
/// @throws FileError if that checkpoint, or any if none is named, is unusable; it names the next
/// older usable one. There is no silent start from zero.
template <int Dim>
RunStart<Dim> find_start(const RunRequest& request, const stepping::StagedModel<Dim>& stages,
                         const std::vector<std::string>& measures);

}  // namespace run
