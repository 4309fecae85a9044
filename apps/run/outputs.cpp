#include "run/outputs.hpp"

#include "files/durable_file.hpp"
#include "record/checkpoint_folder.hpp"
#include "scene/scene.hpp"

namespace run {

namespace {

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
void cut_back(const record::RunFolder& folder, const RunStart<Dim>& start) {
  std::error_code ignored;
  std::filesystem::remove(folder.failure(), ignored);  // of a run that now goes on
  record::set_aside_later(folder.checkpoints(), start.state.programme.step, folder.system());
}

template <int Dim>
record::CurveFile curve_for(const record::RunFolder& folder, const RunStart<Dim>& start) {
  const record::CurveColumns columns(Dim, start.measures);
  if (start.history.empty()) {
    return record::CurveFile::create(folder.curve(), columns, folder.system());
  }
  files::write_text_durably(folder.curve(), record::curve_text(columns, start.history),
                            folder.system());
  return record::CurveFile::resume(folder.curve(), folder.curve(), columns,
                                   start.history.back().step, folder.system());
}

template <int Dim>
record::Frames frames_for(const record::RunFolder& folder, const scene::Scene& scene,
                          const RunStart<Dim>& start) {
  const int every = scene.output.frames_every, deflate = scene.output.compression;
  if (start.history.empty()) return {folder, every, deflate, 0, std::nullopt};
  const record::CurveRow& last = start.history.back();
  return {folder, every, deflate, last.step, time_of(last, scene)};
}

}  // namespace

template <int Dim>
Outputs prepare(const record::RunFolder& folder, const scene::Scene& scene,
                const RunStart<Dim>& start) {
  const bool goes_on = same_folder(folder, start);
  std::optional<std::filesystem::path> previous;
  if (goes_on) {
    cut_back(folder, start);
  } else {
    previous = folder.set_previous_aside();
  }
  program::Log log(folder.log());
  record::CurveFile curve = curve_for(folder, start);
  record::Frames frames = frames_for(folder, scene, start);
  files::create_folder(folder.checkpoints(), folder.system());
  return {std::move(previous), goes_on, std::move(log), std::move(curve), std::move(frames)};
}

double time_of(const record::CurveRow& row, const scene::Scene& scene) {
  if (!scene.stage.empty()) return static_cast<double>(row.step);
  return scene.drive.kind == scene::DriveKind::displacement ? row.settlement : row.load_parameter;
}

template Outputs prepare<2>(const record::RunFolder&, const scene::Scene&, const RunStart<2>&);
template Outputs prepare<3>(const record::RunFolder&, const scene::Scene&, const RunStart<3>&);

}  // namespace run
