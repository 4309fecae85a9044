#include "study/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ostream>

#include "campaign/campaign.hpp"
#include "files/durable_file.hpp"
#include "program/command_line.hpp"
#include "program/progress.hpp"
#include "program/stop_signals.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "study/reference.hpp"
#include "study/report.hpp"
#include "study/results.hpp"
#include "study/varied_scene.hpp"

namespace study {

namespace {

using campaign::Status;
using Stage = Status::Stage;

/// Says how the campaign goes: each end in a line, and now and then what is under way.
class Watch {
 public:
  Watch(const std::vector<campaign::Task>& tasks, int jobs, bool quiet, std::ostream& out)
      : tasks_(tasks), jobs_(jobs), quiet_(quiet), out_(out), said_(tasks.size(), false) {}

  bool operator()(const std::vector<Status>& all) {
    if (!quiet_) say(all);
    return signals_.received() == 0;
  }

  [[nodiscard]] std::string stopped_by() const { return std::string(signals_.name()); }

 private:
  void say(const std::vector<Status>& all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Status& one = all[i];
      if (said_[i] || (one.stage != Stage::finished && one.stage != Stage::failed)) continue;
      said_[i] = true;
      out_ << line_of(all, i) << std::endl;
    }
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begin_;
    constexpr double interval = 10.0;  // [s]
    if (now.count() < last_ + interval) return;
    last_ = now.count();
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (all[i].stage != Stage::running) continue;
      out_ << fmt::format("  at work: {}, {:.0f} %, {}", tasks_[i].name, 100.0 * all[i].fraction,
                          program::duration_text(all[i].elapsed))
           << left(all) << std::endl;
    }
  }

  [[nodiscard]] std::string left(const std::vector<Status>& all) const {
    const auto seconds = campaign::time_left(all, jobs_);
    return seconds && *seconds > 0.0
               ? fmt::format("; {} left in all", program::duration_text(*seconds))
               : "";
  }

  std::string line_of(const std::vector<Status>& all, std::size_t i) const {
    const auto ended = std::ranges::count_if(all, [](const Status& one) {
      return one.stage == Stage::finished || one.stage == Stage::failed;
    });
    std::string line = fmt::format("[{}/{}] {}: ", ended, all.size(), tasks_[i].name);
    if (all[i].stage == Stage::failed) return line + all[i].complaint;
    line += all[i].was_there ? "finished before" : program::duration_text(all[i].elapsed);
    return line + left(all);
  }

  const std::vector<campaign::Task>& tasks_;
  int jobs_;
  bool quiet_;
  std::ostream& out_;
  std::vector<bool> said_;
  double last_ = 0.0;  // [s] when what is under way was said
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  program::StopSignals signals_;
};

std::size_t richardson_key(const Request& request, const std::string& wanted) {
  for (std::size_t k = 0; k < request.varied.size(); ++k) {
    const Vary& vary = request.varied[k];
    if (!wanted.empty() && vary.key != wanted) continue;
    if (vary.numbers.size() >= 2) return k;
  }
  throw program::UsageError(
      wanted.empty()
          ? "--reference richardson: no key is varied over two positive numbers or more"
          : fmt::format("--reference richardson:{0}: {0} is not varied over two positive "
                        "numbers or more",
                        wanted));
}

Reference reference_of(const Request& request, const ReferenceWish& wish, std::size_t key,
                       const scene::Scene& base, const std::vector<Result>& results) {
  if (wish.kind == ReferenceWish::Kind::richardson) {
    return richardson_reference(request.varied, key, results);
  }
  if (wish.kind == ReferenceWish::Kind::limit) {
    return limit_reference(base, request.folder, request.programs / "fpm-limit");
  }
  return wish.reference;
}

std::vector<Result> results_of(const Request& request, const std::vector<Combination>& all,
                               const std::vector<Status>& status) {
  std::vector<Result> results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    Result& result = results.emplace_back(result_of(status[i], request.quantity));
    result.combination = all[i];
    result.words = words_for(request.varied, all[i]);
  }
  return results;
}

void write(const Request& request, const Findings& findings, std::ostream& out) {
  const auto csv = request.folder / "study.csv", json = request.folder / "study.json",
             svg = request.folder / "study.svg";
  files::write_text_durably(csv, csv_text(findings));
  files::write_text_durably(json, json_text(findings));
  files::write_text_durably(svg, picture_text(findings));
  out << table_text(findings) << "written: " << csv.string() << ", study.json, study.svg\n";
}

/// The tasks of all combinations; nothing if a scene is refused.
std::optional<std::vector<campaign::Task>> tasks_of(const Request& request,
                                                    const std::vector<Combination>& all,
                                                    std::ostream& err) {
  std::vector<campaign::Task> tasks;
  for (const Combination& combination : all) {
    const auto scene = read_varied(request.scene_file, request.settings,
                                   settings_of(request.varied, combination), err);
    if (!scene) return std::nullopt;
    check_quantity(*scene, request.quantity);
    tasks.push_back({words_for(request.varied, combination),
                     campaign::task_scene(with_measure(*scene, request.quantity))});
  }
  return tasks;
}

program::ExitCode judged(const Request& request, const ReferenceWish& wish, std::size_t key,
                         const scene::Scene& base, std::vector<Result> results, std::ostream& out) {
  Findings findings{request.scene_file.string(), request.varied, request.quantity, {}, {}, {}};
  findings.reference = reference_of(request, wish, key, base, results);
  judge(results, findings.reference);
  findings.orders =
      orders_of(request.varied, results, wish.kind != ReferenceWish::Kind::richardson);
  findings.results = std::move(results);
  write(request, findings, out);
  const bool all = std::ranges::all_of(findings.results,
                                       [](const Result& one) { return one.value.has_value(); });
  return all ? program::ExitCode::done : program::ExitCode::not_converged;
}

}  // namespace

program::ExitCode make_study(const Request& request, std::ostream& out, std::ostream& err) {
  const ReferenceWish wish = parse_reference(request.reference, request.quantity);
  const std::size_t key =
      wish.kind == ReferenceWish::Kind::richardson ? richardson_key(request, wish.key) : 0;
  const std::vector<Combination> all = all_combinations(request.varied);
  const auto base = read_varied(request.scene_file, request.settings,
                                settings_of(request.varied, all.back()), err);
  if (!base) return program::ExitCode::input_refused;
  const auto tasks = tasks_of(request, all, err);
  if (!tasks) return program::ExitCode::input_refused;

  campaign::Campaign campaign(*tasks, {request.programs / "fpm-run", request.folder / "runs",
                                       request.jobs, request.threads});
  if (!campaign.check()) {
    for (std::size_t i = 0; i < tasks->size(); ++i) {
      const std::string& complaint = campaign.status()[i].complaint;
      if (!complaint.empty()) err << (*tasks)[i].name << ": " << complaint << '\n';
    }
    return program::ExitCode::input_refused;
  }
  Watch watch(*tasks, request.jobs, request.quiet, out);
  campaign.run([&](const std::vector<Status>& status) { return watch(status); });
  if (!watch.stopped_by().empty()) {
    err << "interrupted by " << watch.stopped_by()
        << "; the same command goes on, what is finished is not run again\n";
    return program::ExitCode::interrupted;
  }
  return judged(request, wish, key, *base, results_of(request, all, campaign.status()), out);
}

}  // namespace study
