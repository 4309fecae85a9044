// fpm-bench-checkpoint: what checkpoints cost a run. Makes the run of one body with checkpoints as
// its scene asks for them, one of them besides at each degree of compression, and prints one row
// per degree as comma-separated values:
//   body, particles, compression, bytes per particle, milliseconds each, share of the run [%] at
//   the scene's frequency
// The run is timed without its checkpoints. All files go to a folder of their own in FOLDER, which
// is to be on the disk in question: most of the time is its fsync.

#include <omp.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "bodies.hpp"
#include "files/durable_file.hpp"
#include "model/build.hpp"
#include "model/checkpoint.hpp"
#include "model/particle_fields.hpp"
#include "record/checkpoint_folder.hpp"
#include "record/checkpoint_name.hpp"
#include "scene/scene.hpp"
#include "stepping/stepper.hpp"

namespace benchmarks {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* usage = "usage: fpm-bench-checkpoint BODY FOLDER\n";

/// One degree of compression, and what its checkpoints came to.
struct Degree {
  int deflate = 0;
  double seconds = 0.0;
  double bytes = 0.0;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

template <int Dim>
class Run {
 public:
  Run(const scene::Scene& scene, std::filesystem::path folder)
      : scene_(scene),
        model_(model::build_model<Dim>(scene)),
        state_(model::initial_state(model_)),
        stepper_(scene, model_, state_),
        notes_(model::notes_for(scene)),
        folder_(std::move(folder)) {}

  /// Goes to the end; checkpoints every so many steps as the scene says.
  void go(std::vector<Degree>& degrees) {
    while (!stepper_.finished()) {
      const auto start = Clock::now();
      const stepping::StepResult result = stepper_.advance();
      seconds_ += seconds_since(start);
      if (result.outcome != stepping::StepOutcome::converged)
        throw std::runtime_error(result.reason);
      record::CurveRow row;
      row.step = result.record.step;
      notes_.history.push_back(row);
      if (state_.programme.step % scene_.output.checkpoints_every != 0) continue;
      ++checkpoints_;
      for (Degree& degree : degrees) write(degree);
    }
  }

  [[nodiscard]] double seconds() const { return seconds_; }
  [[nodiscard]] long checkpoints() const { return checkpoints_; }
  [[nodiscard]] long particles() const { return static_cast<long>(model_.size()); }

 private:
  void write(Degree& degree) {
    const auto start = Clock::now();
    const auto path = folder_ / record::checkpoint_name(state_.programme.step);
    const auto fields = model::particle_fields(model_, state_, scene_.output.fields);
    model::write_checkpoint(path, model_, state_, notes_, fields, degree.deflate);
    degree.seconds += seconds_since(start);
    degree.bytes += static_cast<double>(std::filesystem::file_size(path));
    std::filesystem::remove(path);
  }

  const scene::Scene& scene_;
  model::Model<Dim> model_;
  model::State<Dim> state_;
  stepping::LoadStepper<Dim> stepper_;
  record::CheckpointNotes notes_;
  std::filesystem::path folder_;
  double seconds_ = 0.0;
  long checkpoints_ = 0;
};

template <int Dim>
void measure(const std::string& name, const scene::Scene& scene,
             const std::filesystem::path& folder) {
  std::vector<Degree> degrees{{.deflate = 0}, {.deflate = 1}, {.deflate = 6}};
  Run<Dim> run(scene, folder);
  run.go(degrees);
  if (run.checkpoints() == 0) throw std::runtime_error(name + " is too short for a checkpoint");
  const auto count = static_cast<double>(run.checkpoints());
  for (const Degree& degree : degrees) {
    std::printf("%s,%ld,%d,%.0f,%.1f,%.2f\n", name.c_str(), run.particles(), degree.deflate,
                degree.bytes / count / static_cast<double>(run.particles()),
                1e3 * degree.seconds / count, 100.0 * degree.seconds / run.seconds());
  }
}

int main_of(int count, char** arguments) {
  if (count != 3) throw std::invalid_argument(usage);
  const std::string name = arguments[1];
  const auto folder = std::filesystem::path(arguments[2]) / "fpm-bench-checkpoint";
  const auto scene = scene_of(body_named(name));
  omp_set_num_threads(1);
  files::create_folder(folder);
  std::printf("body,particles,compression,bytes_per_particle,ms_each,percent_of_run\n");
  if (dimension_of(*scene) == 2) measure<2>(name, *scene, folder);
  if (dimension_of(*scene) == 3) measure<3>(name, *scene, folder);
  std::filesystem::remove(folder);
  return 0;
}

}  // namespace
}  // namespace benchmarks

int main(int count, char** arguments) {
  try {
    return benchmarks::main_of(count, arguments);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "fpm-bench-checkpoint: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fpm-bench-checkpoint: %s\n", error.what());
    return 1;
  }
}
