#include "run/run_loop.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <exception>
#include <memory>
#include <thread>

#include "bounds/accuracy_note.hpp"
#include "bounds/limit_check.hpp"
#include "files/durable_file.hpp"
#include "fpm/rows.hpp"
#include "model/build.hpp"
#include "model/measures.hpp"
#include "model/refusal.hpp"
#include "model/state_file.hpp"
#include "program/stop_signals.hpp"
#include "program/version.hpp"
#include "record/run_lock.hpp"
#include "run/drawing.hpp"
#include "run/recorder.hpp"
#include "run/report.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "stepping/failure_report.hpp"
#include "stepping/settle.hpp"
#include "stepping/staged_model.hpp"
#include "stepping/stepper.hpp"

namespace run {

namespace {

/// Why a run is to stop before its end.
class StopReasons {
 public:
  explicit StopReasons(std::optional<double> max_wall) : max_wall_(max_wall) {}

  /// "" to go on.
  [[nodiscard]] std::string now() const {
    if (signals_.received() != 0) return fmt::format("interrupted by {}", signals_.name());
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin_;
    if (max_wall_ && wall.count() >= *max_wall_) return "interrupted by --max-wall";
    return "";
  }

 private:
  program::StopSignals signals_;
  std::optional<double> max_wall_;  // [s]
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

std::string what_is_left(const std::filesystem::path& checkpoint) {
  if (checkpoint.empty()) return "; there is no checkpoint yet";
  std::error_code failure;
  const bool exists = std::filesystem::exists(checkpoint, failure);
  return (exists ? "; the last good checkpoint is " : "; gone is the last checkpoint, ") +
         checkpoint.string();
}

/// A word as a shell reads it back.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("._-/=+,:@%").find(char(c)) != std::string::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? "'\\''" : std::string(1, c);
  return text + "'";
}

std::string command_to_resume(const RunRequest& request) {
  std::string command = "fpm-run " + quoted(request.scene_file.string());
  for (const std::string& setting : request.settings) command += " --set " + quoted(setting);
  return command + " --out " + quoted(request.directory.string()) + " --resume";
}

template <int Dim>
class Run {
 public:
  Run(const RunRequest& request, std::size_t stage, std::ostream& out, std::ostream& err,
      const files::SystemCalls& system)
      : request_(request),
        scene_(*request.scene),
        out_(out),
        err_(err),
        system_(system),
        stop_(request.max_wall_s),
        stages_(scene_, stage),
        measures_(std::make_unique<model::Measures<Dim>>(stages_.scene(), stages_.model())) {}

  program::ExitCode operator()() {
    // Held before its checkpoints are read: nobody else adds one meanwhile. A folder that is not
    // there is made only once the run is known to begin.
    std::optional<record::RunFolder> folder;
    std::exception_ptr no_folder;  // which a finished run does not need
    const bool exists = std::filesystem::is_directory(request_.directory);
    if (exists && !request_.check_only) no_folder = take(folder);
    RunStart<Dim> start = find_start(request_, stages_, measures_->columns());
    for (const std::string& refusal : start.refusals) err_ << "error: " << refusal << '\n';
    if (!start.refusals.empty()) return program::ExitCode::input_refused;
    stepper_ = stages_.stepper(start.state);
    if (start.history.empty() && !scene_.stage.empty()) begin_stage();
    if (request_.check_only) return check(start);
    if (stepper_->finished() && stages_.is_last()) return say_finished(start, folder);
    // What a stage to come is refused for is said before it is too late.
    if (!scene_.interface.empty()) static_cast<void>(joined_in_later_stages(start));
    if (no_folder) std::rethrow_exception(no_folder);

    if (!folder) folder.emplace(request_.directory, system_);
    Recorder<Dim> recorder(request_, *folder, stages_.model(), *measures_, start, start.state,
                           prepare(*folder, scene_, start), out_);
    record::CurveRow first;
    if (start.history.empty()) first = stepper_->at_rest();
    recorder.begin(first);
    try {
      introduce(start, *folder, recorder);
      if (start.re_search_changed && scene_.re_search.enabled) {
        // The rule is new: a state that no step leads on from must not wait for one.
        const Eigen::Index rows = stepper_->re_search();
        if (rows > 0) recorder.say(fmt::format("{} rows re-searched", rows));
      }
      recorder.begin_branch();
      return advance(start.state, recorder, *folder);
    } catch (const files::FileError& failure) {
      throw files::FileError(failure.file(),
                             failure.reason() + what_is_left(recorder.last_checkpoint()));
    }
  }

 private:
  /// @return why a folder to resume in, which nobody else has, cannot be written to
  std::exception_ptr take(std::optional<record::RunFolder>& folder) const {
    try {
      folder.emplace(request_.directory, system_);
    } catch (const files::FileError&) {
      if (!request_.resume || record::lock_owner(request_.directory).alive) throw;
      return std::current_exception();
    }
    return nullptr;
  }

  program::ExitCode check(RunStart<Dim>& start) {
    std::vector<model::MemoryPart> parts = {{"state", model::bytes_of(start.state)}};
    for (model::MemoryPart& part : stepper_->memory(true)) parts.push_back(std::move(part));
    const model::Model<Dim>& model = stages_.model();
    out_ << check_report(scene_, static_cast<std::size_t>(model.size()),
                         static_cast<std::size_t>(model.ghosts.size()), parts);
    for (const std::string& note : water_notes(stages_.scene(), model)) {
      out_ << fmt::format("  {:<12} {}\n", "water", note);
    }
    draw(parts);
    for (const std::string& note : joined_notes(scene_, model)) err_ << "warning: " << note << '\n';
    for (const std::string& note : joined_in_later_stages(start))
      err_ << "warning: " << note << '\n';
    for (const std::string& note : lateral_notes(scene_, model))
      err_ << "warning: " << note << '\n';
    for (const std::string& warning : start.warnings) err_ << "warning: " << warning << '\n';
    if (!start.checkpoint.empty()) out_ << resumed_line(start) << '\n';
    for (const scene::SceneChange& change : start.changes)
      out_ << "changed: " << change.text() << '\n';
    return program::ExitCode::done;
  }

  /// What is not said of the ground as it is, of that which stages to come make of it.
  /// @throws model::Refusal of a stage whose ground cannot be
  std::vector<std::string> joined_in_later_stages(const RunStart<Dim>& start) const {
    std::vector<std::string> notes;
    if (!scene::changes_ground(scene_)) return notes;
    std::vector<std::string> said = joined_notes(scene_, stages_.model());
    const auto next = static_cast<std::size_t>(start.state.programme.stage) + 1;
    for (std::size_t stage = next; stage < scene::stage_count(scene_); ++stage) {
      const auto later = model::build_model<Dim>(scene::scene_of_stage(scene_, stage));
      for (const std::string& note : joined_notes(scene_, later)) {
        if (std::ranges::count(said, note) > 0) continue;
        said.push_back(note);
        notes.push_back(fmt::format("{}: {}", scene::stage_title(scene_, stage), note));
      }
    }
    return notes;
  }

  void draw(const std::vector<model::MemoryPart>& parts) const {
    if (request_.drawing.empty()) return;
    files::write_text_durably(
        request_.drawing, drawing_of(scene_, stages_.model(), {size_note(scene_, parts)}), system_);
    out_ << fmt::format("  {:<12} {}\n", "drawn", request_.drawing.string());
  }

  program::ExitCode say_finished(const RunStart<Dim>& start,
                                 const std::optional<record::RunFolder>& folder) {
    const auto say = [&](const std::string& line) {
      if (!request_.quiet && !line.empty()) out_ << line << '\n';
    };
    say(fmt::format("{}: the run is finished at step {}; nothing to do", start.checkpoint.string(),
                    start.state.programme.step));
    if (folder) {
      bounds::LimitCheck limit(scene_, *folder, request_.limit_program);
      wait_for(limit, say);
      say(limit.verdict(start.history));
    }
    return program::ExitCode::done;
  }

  /// Says what there is to say of the bounds until all is said, or a stop is asked for.
  template <class Say>
  void wait_for(bounds::LimitCheck& limit, Say&& say) const {
    constexpr std::chrono::milliseconds pause{50};
    do {
      for (const std::string& line : limit.news()) say(line);
      if (!limit.pending()) break;
      std::this_thread::sleep_for(pause);
    } while (stop_.now().empty());
    for (const std::string& line : limit.news()) say(line);
  }

  static std::string resumed_line(const RunStart<Dim>& start) {
    return fmt::format("resuming from {}: step {}, load {:.6g}", start.checkpoint.string(),
                       start.state.programme.step, start.state.programme.load);
  }

  void introduce(const RunStart<Dim>& start, const record::RunFolder& folder,
                 Recorder<Dim>& recorder) {
    recorder.log().info(fmt::format("{}; scene {}, {} threads", program::with_versions("fpm-run"),
                                    request_.scene_file.string(), omp_get_max_threads()));
    recorder.say(fmt::format("{}: {} particles, {} steps planned, output in {}",
                             scene_.title.empty() ? request_.scene_file.string() : scene_.title,
                             stages_.model().size(), scene::planned_steps(scene_),
                             request_.directory.string()));
    if (!folder.dead_owner().empty()) {
      recorder.say(
          fmt::format("the last run here ({}) ended without a word: it was killed, or its "
                      "machine went down",
                      folder.dead_owner()));
    }
    warn_of_joined(recorder);
    say_water(recorder);
    for (const std::string& note : lateral_notes(scene_, stages_.model())) {
      recorder.log().warning(note);
    }
    for (const std::string& warning : start.warnings) recorder.log().warning(warning);
    if (!start.checkpoint.empty()) recorder.say(resumed_line(start));
    for (const scene::SceneChange& change : start.changes)
      recorder.say("changed: " + change.text());
  }

  // Where water stands, when that is news.
  void say_water(Recorder<Dim>& recorder) {
    std::vector<std::string> notes = water_notes(stages_.scene(), stages_.model());
    if (notes == said_of_water_) return;
    for (const std::string& note : notes) recorder.say(note);
    if (notes.empty()) recorder.say("no water stands on any side now");
    said_of_water_ = std::move(notes);
  }

  void warn_of_joined(Recorder<Dim>& recorder) const {
    for (const std::string& note : joined_notes(scene_, stages_.model())) {
      recorder.log().warning(note);
    }
  }

  /// @throws stepping::DoesNotSettle
  void begin_stage() {
    if (stepper_->begin_stage()) return;
    throw stepping::DoesNotSettle(
        fmt::format("{}: what it changes leaves particles inside out",
                    scene::stage_title(scene_, stages_.scene().course.stage)));
  }

  void go_on_to_next_stage(model::State<Dim>& state, Recorder<Dim>& recorder) {
    recorder.end_stage(scene::stage_title(scene_, stages_.scene().course.stage));
    stepper_.reset();
    measures_.reset();
    stages_.go_on(state);
    measures_ = std::make_unique<model::Measures<Dim>>(stages_.scene(), stages_.model());
    stepper_ = stages_.stepper(state);
    begin_stage();
    recorder.enter(stages_.model(), *measures_);
    recorder.say(fmt::format("{}: {} particles",
                             scene::stage_title(scene_, stages_.scene().course.stage),
                             stages_.model().size()));
    warn_of_joined(recorder);
    say_water(recorder);
  }

  program::ExitCode advance(model::State<Dim>& state, Recorder<Dim>& recorder,
                            const record::RunFolder& folder) {
    bounds::LimitCheck limit(scene_, folder, request_.limit_program);
    for (;;) {
      if (stepper_->finished()) {
        if (stages_.is_last()) break;
        go_on_to_next_stage(state, recorder);
      }
      for (const std::string& line : limit.news()) recorder.say(line);
      if (!stop_.now().empty()) return interrupt(recorder);
      const stepping::StepResult result =
          stepper_->advance([&](const jfnk::Iteration&) { return stop_.now().empty(); });
      if (result.outcome == stepping::StepOutcome::converged) {
        recorder.take(result.record);
        continue;
      }
      if (result.outcome == stepping::StepOutcome::stopped) return interrupt(recorder);
      return fail(state, result, recorder, folder, limit);
    }
    recorder.finish("end of the programme", false);
    report(recorder, folder, limit);
    const std::string note = control_note(scene_, recorder.history().back());
    if (!note.empty()) recorder.say(note);
    return program::ExitCode::done;
  }

  program::ExitCode interrupt(Recorder<Dim>& recorder) {
    const std::string why = stop_.now();
    recorder.finish(why, true);
    recorder.log().warning(fmt::format("{} at step {}; go on with: {}", why,
                                       recorder.history().back().step,
                                       command_to_resume(request_)));
    return program::ExitCode::interrupted;
  }

  program::ExitCode fail(const model::State<Dim>& state, const stepping::StepResult& result,
                         Recorder<Dim>& recorder, const record::RunFolder& folder,
                         bounds::LimitCheck& limit) {
    recorder.finish(
        result.outcome == stepping::StepOutcome::hopeless ? "no hope" : "no convergence", false);
    recorder.write_failure(result);
    const std::string why =
        failed_stage() + stepping::failure_report(stages_.scene(), stages_.model(), state, result) +
        "\n  fields: " + folder.failure().string();
    report(recorder, folder, limit);
    if (!scene_.programme.stop_at_failure) {
      recorder.say("the programme ends here, as programme.stop_at_failure = false asks: " + why);
      return program::ExitCode::done;
    }
    recorder.log().error(why);
    recorder.log().error(
        fmt::format("the last good checkpoint is {}", recorder.last_checkpoint().string()));
    return program::ExitCode::not_converged;
  }

  std::string failed_stage() const {
    if (scene_.stage.empty()) return "";
    return scene::stage_title(scene_, stages_.scene().course.stage) + ": ";
  }

  void report(Recorder<Dim>& recorder, const record::RunFolder& folder,
              bounds::LimitCheck& limit) const {
    recorder.say(end_report(stages_.scene(), measures_->columns(), recorder.history(),
                            recorder.elapsed(), folder, recorder.last_checkpoint()));
    const std::string accuracy = bounds::accuracy_note(folder.path(), scene_);
    if (!accuracy.empty()) recorder.say(fmt::format("  {:<12} {}", "accuracy", accuracy));
    if (limit.pending()) recorder.say("waiting for fpm-limit; it may be interrupted and resumed");
    wait_for(limit, [&](const std::string& line) { recorder.say(line); });
    const std::string verdict = limit.verdict(recorder.history());
    if (!verdict.empty()) recorder.say(verdict);
  }

  const RunRequest& request_;
  const scene::Scene& scene_;
  std::ostream& out_;
  std::ostream& err_;
  const files::SystemCalls& system_;
  StopReasons stop_;
  stepping::StagedModel<Dim> stages_;
  std::unique_ptr<model::Measures<Dim>> measures_;
  std::vector<std::string> said_of_water_;
  std::unique_ptr<stepping::LoadStepper<Dim>> stepper_;  // of the stage at hand
};

}  // namespace

int thread_count(int asked, std::int64_t particles) {
  // A smaller share per thread costs more in waiting for each other than it saves.
  constexpr std::int64_t particles_per_thread = 4000;
  if (asked > 0) return asked;
  return static_cast<int>(
      std::min<std::int64_t>(omp_get_max_threads(), particles / particles_per_thread + 1));
}

program::ExitCode run_programme(const RunRequest& request, std::ostream& out, std::ostream& err,
                                const files::SystemCalls& system) {
  RunRequest begun = request;
  const InForce in_force = scene_in_force(request);
  begun.scene = in_force.scene;
  omp_set_num_threads(thread_count(begun.threads, model::particle_count(*begun.scene)));
  try {
    if (begun.scene->geometry.dimension == 2) {
      return Run<2>(begun, in_force.stage, out, err, system)();
    }
    return Run<3>(begun, in_force.stage, out, err, system)();
  } catch (const model::Refusal& refused) {
    err << "error: "
        << scene::complaint_about(refused.key, refused.found, refused.allowed, request.scene_file,
                                  request.settings)
               .text()
        << '\n';
    return program::ExitCode::input_refused;
  } catch (const fpm::PoorNeighbourhood& failure) {
    err << "error: " << failure.what() << ": the particles there are too few or lie too unevenly; "
        << (scene::has_elements(*begun.scene)
                ? "refine the mesh there, or let its elements grow more slowly\n"
                : "of a corner sharper than some 35 degrees, cut the tip off by an edge of two "
                  "spacings; of a thin part, make geometry.spacing smaller\n");
    return program::ExitCode::input_refused;
  } catch (const stepping::DoesNotSettle& failure) {
    err << "error: " << failure.what() << '\n';
    return program::ExitCode::not_converged;
  }
}

}  // namespace run
