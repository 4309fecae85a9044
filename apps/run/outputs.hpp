#pragma once

#include <filesystem>
#include <optional>

#include "program/logging.hpp"
#include "record/curve.hpp"
#include "record/curve_file.hpp"
#include "record/frames.hpp"
#include "record/run_folder.hpp"
#include "run/start.hpp"

namespace scene {
struct Scene;
}

namespace run {

/// An output folder made ready for a run: what its recorder writes to.
struct Outputs {
  std::optional<std::filesystem::path> previous;  // where the results of an earlier run are now
  bool holds_start = false;                       // a checkpoint of the state the run begins with
  program::Log log;
  record::CurveFile curve;
  record::Frames frames;
};

/// Makes a folder ready for a start. First the results of another run move to `previous-1`, or, if
/// the run goes on in the folder of its checkpoint, later checkpoints are set aside; then log,
/// curve and frames begin anew or are cut back to the checkpoint, so that they have each step once.
/// @throws FileError
template <int Dim>
[[nodiscard]] Outputs prepare(const record::RunFolder& folder, const scene::Scene& scene,
                              const RunStart<Dim>& start);

/// Time in frames: what the user drives, so that it does not depend on the target; with stages,
/// which go there and back, the step.
[[nodiscard]] double time_of(const record::CurveRow& row, const scene::Scene& scene);

}  // namespace run
