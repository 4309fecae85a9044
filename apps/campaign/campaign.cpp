#include "campaign/campaign.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

#include "campaign/word.hpp"
#include "files/durable_file.hpp"
#include "program/child_process.hpp"
#include "program/exit_code.hpp"
#include "record/checkpoint_folder.hpp"
#include "scene/print.hpp"
#include "scene/scene.hpp"

namespace campaign {

using Stage = Status::Stage;
using Clock = std::chrono::steady_clock;

namespace {

constexpr std::chrono::milliseconds pause{10};
constexpr double look_every = 0.5;  // [s] at the curve of a run at work

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Waits for a child's end, however long it takes.
int end_of(program::ChildProcess& child) {
  while (true) {
    if (const auto code = child.exit_code()) return *code;
    std::this_thread::sleep_for(pause);
  }
}

/// Memory that may be had without swapping [bytes]; a large number where the system does not say.
double memory_free() {
  constexpr double plenty = 1e18;
  const auto pages = ::sysconf(_SC_AVPHYS_PAGES), size = ::sysconf(_SC_PAGESIZE);
  try {
    // What the page cache holds can be had as well, and only this file counts it.
    const std::string text = files::read_text("/proc/meminfo");
    if (const auto kib = number_after(text, "MemAvailable:")) return 1024.0 * *kib;
  } catch (const files::FileError&) {
    // not Linux's /proc
  }
  return pages > 0 && size > 0 ? static_cast<double>(pages) * static_cast<double>(size) : plenty;
}

Outcome outcome_now(const std::filesystem::path& home, const std::string& digest) {
  Outcome fresh;
  fresh.digest = digest;
  return read_outcome(home / "outcome.json", digest).value_or(fresh);
}

bool may_go_on(const std::filesystem::path& run) {
  std::vector<std::string> objections;
  std::error_code failure;
  return std::filesystem::is_directory(run / "checkpoints", failure) &&
         record::newest_usable(run / "checkpoints", objections).has_value();
}

}  // namespace

struct Campaign::Process {
  Process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
          const std::filesystem::path& output)
      : child(program, arguments, output) {}

  program::ChildProcess child;
  Clock::time_point begin = Clock::now();
  double looked = 0.0;  // [s] when at its curve
};

std::string task_scene(const scene::Scene& scene) {
  scene::Scene bare = scene;
  bare.output = {};
  bare.output.frames_every = 0;
  bare.output.checkpoints_every = 0;
  bare.output.checkpoints_every_minutes = 5.0;
  bare.output.checkpoints_kept = 1;
  bare.limit = {};
  return scene::effective_toml(bare);
}

std::optional<double> time_left(const std::vector<Status>& all, int jobs) {
  // What a run needs grows with its steps and a little faster than its particles.
  constexpr double growth = 1.25;
  const auto weight = [](const Status& one) {
    return std::pow(static_cast<double>(std::max<std::int64_t>(one.bytes, 1)), growth) *
           static_cast<double>(std::max<std::int64_t>(one.steps, 1));
  };
  double spent = 0.0, weighed = 0.0, waiting = 0.0, left = 0.0;
  for (const Status& one : all) {
    if (one.stage == Stage::waiting) {
      waiting += weight(one);
    } else if (one.stage == Stage::running) {
      constexpr double first = 0.01;
      if (one.fraction < first) {
        waiting += weight(one);
        continue;
      }
      left += one.elapsed * (1.0 - one.fraction) / one.fraction;
      spent += one.elapsed;
      weighed += weight(one) * one.fraction;
    } else if (one.outcome.cost.complete && one.outcome.cost.wall > 0.0) {
      spent += one.outcome.cost.wall;
      weighed += weight(one);
    }
  }
  if (waiting > 0.0 && !(weighed > 0.0)) return std::nullopt;
  if (waiting > 0.0) left += waiting * spent / weighed;
  return left / std::max(jobs, 1);
}

Campaign::Campaign(std::vector<Task> tasks, Settings settings)
    : tasks_(std::move(tasks)), settings_(std::move(settings)), processes_(tasks_.size()) {
  files::create_folder(settings_.folder);
  lock_ = std::make_unique<record::RunLock>(settings_.folder);
  for (const Task& task : tasks_) {
    Status& status = status_.emplace_back();
    const std::string digest = digest_of(task.scene, settings_.program);
    status.outcome.digest = digest;
    const auto folder = home(status_.size() - 1);
    status.folder = folder / "run";
    status.outcome = outcome_now(folder, digest);
    if (!status.outcome.finished()) continue;
    status.was_there = true;
    status.fraction = 1.0;
    status.stage = status.outcome.exit_code == 0 ? Stage::finished : Stage::failed;
    if (status.stage == Stage::failed) status.complaint = program::last_word(folder / "output.txt");
  }
}

Campaign::~Campaign() = default;

std::filesystem::path Campaign::home(std::size_t task) const {
  return settings_.folder / status_[task].outcome.digest;
}

bool Campaign::check() {
  bool good = true;
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    const auto folder = home(i);
    files::create_folder(folder);
    const auto scene = folder / "scene.toml", output = folder / "check.txt";
    files::write_text_durably(scene, tasks_[i].scene);
    program::ChildProcess child(settings_.program, {scene.string(), "--check"}, output);
    const int code = end_of(child);
    const std::string text = files::read_text(output);
    if (code != 0) {
      status_[i].complaint = program::last_word(output);
      good = false;
    }
    constexpr double mebi = 1024.0 * 1024.0;
    if (const auto memory = number_after(text, "\n  memory ")) {
      status_[i].bytes = static_cast<std::int64_t>(*memory * mebi);
    }
    if (const auto steps = number_after(text, "\n  steps ")) {
      status_[i].steps = static_cast<std::int64_t>(*steps);
    }
  }
  return good;
}

bool Campaign::may_start(std::size_t task) const {
  if (status_[task].stage != Stage::waiting) return false;
  // One that a killed campaign has left at work is waited for.
  if (record::lock_owner(status_[task].folder).alive) return false;
  const auto running = std::ranges::count(status_, Stage::running, &Status::stage);
  if (running == 0) return true;
  // The solver's vectors come on top of what --check says.
  constexpr double with_vectors = 2.0;
  return running < settings_.jobs &&
         with_vectors * static_cast<double>(status_[task].bytes) < memory_free();
}

void Campaign::start(std::size_t task) {
  Status& status = status_[task];
  const auto folder = home(task);
  files::create_folder(folder);
  files::write_text_durably(folder / "scene.toml", tasks_[task].scene);
  std::vector<std::string> arguments{
      (folder / "scene.toml").string(),    "--out", status.folder.string(), "--quiet", "--threads",
      fmt::format("{}", settings_.threads)};
  if (may_go_on(status.folder)) arguments.emplace_back("--resume");
  if (status.outcome.at_work) status.outcome.cost.complete = false;
  status.outcome.at_work = true;
  status.outcome.exit_code.reset();
  write_outcome(folder / "outcome.json", status.outcome);
  processes_[task] = std::make_unique<Process>(settings_.program, arguments, folder / "output.txt");
  status.stage = Stage::running;
}

void Campaign::look_at(std::size_t task) {
  Process& process = *processes_[task];
  Status& status = status_[task];
  status.elapsed = seconds_since(process.begin);
  if (const auto code = process.child.exit_code()) return end(task, *code);
  if (status.elapsed < process.looked + look_every) return;
  process.looked = status.elapsed;
  status.cpu = process.child.cpu_so_far();
  status.fraction = fraction_reached(status.folder / "curve.csv");
}

void Campaign::end(std::size_t task, int exit_code) {
  Status& status = status_[task];
  Cost& cost = status.outcome.cost;
  const program::ResourceUse& use = processes_[task]->child.use();
  cost.wall += status.elapsed;
  cost.cpu += use.cpu;
  cost.peak_bytes = std::max(cost.peak_bytes, use.peak_bytes);
  status.outcome.at_work = false;
  status.outcome.exit_code = exit_code;
  write_outcome(home(task) / "outcome.json", status.outcome);
  const bool interrupted = exit_code == to_int(program::ExitCode::interrupted);
  status.stage = exit_code == 0 ? Stage::finished : interrupted ? Stage::waiting : Stage::failed;
  if (status.stage == Stage::finished) status.fraction = 1.0;
  if (status.stage == Stage::failed)
    status.complaint = program::last_word(home(task) / "output.txt");
  processes_[task].reset();
}

void Campaign::stop_all() {
  for (const auto& process : processes_) {
    if (process) process->child.ask_to_stop();
  }
  for (std::size_t i = 0; i < tasks_.size(); ++i) {
    while (processes_[i]) {
      look_at(i);
      std::this_thread::sleep_for(pause);
    }
  }
}

void Campaign::run(const std::function<bool(const std::vector<Status>&)>& watch) {
  const auto under_way = [](const Status& one) {
    return one.stage == Stage::waiting || one.stage == Stage::running;
  };
  // The cheapest first: they say soonest how long the others take.
  std::vector<std::size_t> order(tasks_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [this](std::size_t i) { return status_[i].bytes; });
  while (std::ranges::any_of(status_, under_way)) {
    for (std::size_t i = 0; i < tasks_.size(); ++i) {
      if (processes_[i]) look_at(i);
    }
    if (!watch(status_)) return stop_all();
    for (const std::size_t i : order) {
      if (may_start(i)) start(i);
    }
    std::this_thread::sleep_for(pause);
  }
  (void)watch(status_);
}

}  // namespace campaign
