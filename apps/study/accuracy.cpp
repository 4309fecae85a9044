#include "study/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>

#include "campaign/campaign.hpp"
#include "files/durable_file.hpp"
#include "program/command_line.hpp"
#include "program/stop_signals.hpp"
#include "scene/derived.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "study/final_run.hpp"
#include "study/ladder.hpp"
#include "study/levels.hpp"
#include "study/results.hpp"
#include "study/varied_scene.hpp"

namespace study {

namespace {

struct Interrupted {};

/// Makes the runs of the ladder and remembers what they said.
class Runs {
 public:
  Runs(const AccuracyRequest& request, Quantity quantity, const scene::Scene& base,
       std::vector<double> spacings, std::filesystem::path folder, std::ostream& out,
       std::ostream& err)
      : request_(request),
        quantity_(std::move(quantity)),
        base_(base),
        far_(request.far.empty() ? std::vector<scene::Side>{} : parse_far(request.far, base)),
        spacings_(std::move(spacings)),
        folder_(std::move(folder)),
        out_(out),
        err_(err) {}

  /// Settings of the scene, as --set takes them.
  [[nodiscard]] std::vector<std::string> settings_of(const Fineness& fineness) const {
    std::vector<std::string> settings{
        fmt::format("geometry.spacing={}", spacings_[fineness.level])};
    for (std::string& setting : widened(base_, far_, fineness.box)) {
      settings.push_back(std::move(setting));
    }
    const auto plain = read_varied(request_.scene_file, request_.settings, settings, err_);
    if (!plain) throw program::UsageError("no run with such a spacing");
    const auto steps = static_cast<double>(scene::nominal_steps(*plain)) * fineness.steps;
    settings.push_back(fmt::format("programme.steps={}", std::llround(steps)));
    const double tolerance = scene::resolve_solver(*plain).tolerance * fineness.tolerance;
    settings.push_back(fmt::format("solver.tolerance={}", tolerance));
    if (fineness.tolerance != 1.0) {
      // A tighter tolerance takes more of them, and must not be stopped by a limit made for less.
      settings.push_back(fmt::format("solver.max_evaluations_per_step={}",
                                     10 * plain->solver.max_evaluations_per_step));
    }
    if (fineness.control != 1.0) {
      settings.push_back(fmt::format("hourglass.stiffness_ratio={}",
                                     scene::resolve_stiffness_ratio(*plain) * fineness.control));
    }
    return settings;
  }

  std::vector<std::optional<Reply>> operator()(const std::vector<Fineness>& asked) {
    std::vector<campaign::Task> tasks;
    for (const Fineness& one : asked) {
      const auto scene =
          read_varied(request_.scene_file, request_.settings, settings_of(one), err_);
      if (!scene) throw program::UsageError("a run of the ladder is refused");
      std::string name = fmt::format("spacing {}, steps x {}, tolerance x {}, control x {}",
                                     spacings_[one.level], one.steps, one.tolerance, one.control);
      if (one.box != 1.0) name += fmt::format(", box x {}", one.box);
      tasks.push_back({std::move(name), campaign::task_scene(with_measure(*scene, quantity_))});
    }
    campaign::Campaign campaign(
        tasks, {request_.programs / "fpm-run", folder_ / "runs", request_.jobs, request_.threads});
    campaign.run([&](const auto&) { return signals_.received() == 0; });
    if (signals_.received() != 0) throw Interrupted{};
    std::vector<std::optional<Reply>> replies;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const Result result = result_of(campaign.status()[i], quantity_);
      replies.push_back(
          result.value ? std::optional(Reply{*result.value, result.cost.cpu, result.evaluations})
                       : std::nullopt);
      if (said_.insert(tasks[i].name).second) say(tasks[i].name, result);
    }
    return replies;
  }

 private:
  void say(const std::string& name, const Result& result) {
    if (request_.quiet) return;
    const std::string value = result.value
                                  ? fmt::format("{:.7g}, {:.2f} s", *result.value, result.cost.cpu)
                                  : result.obstacle;
    out_ << fmt::format("  {}: {}", name, value) << std::endl;
  }

  const AccuracyRequest& request_;
  Quantity quantity_;
  const scene::Scene& base_;
  std::vector<scene::Side> far_;
  std::vector<double> spacings_;
  std::filesystem::path folder_;
  std::ostream& out_;
  std::ostream& err_;
  std::set<std::string> said_;
  program::StopSignals signals_;
};

std::string percent(double error, double value) {
  return value == 0.0 ? fmt::format("{:.3g}", error)
                      : fmt::format("{:.3f} %", 100.0 * error / std::abs(value));
}

std::string answer_text(const AccuracyRequest& request, const Quantity& quantity,
                        const Answer& answer, const std::vector<std::string>& settings) {
  std::string text =
      fmt::format("{} = {:.7g} +- {:.2g} ({}); asked for {}\n", quantity.text, answer.value,
                  answer.bar, percent(answer.bar, answer.value), percent(request.accuracy, 1.0));
  for (const Part& part : answer.parts) {
    fmt::format_to(std::back_inserter(text), "  {:<10} +- {}: {}\n", part.source,
                   percent(part.error, answer.value), part.words);
  }
  if (request.far.empty()) {
    text += "  box        not looked at: --far names sides beyond which there is more ground\n";
  }
  if (answer.control) {
    fmt::format_to(std::back_inserter(text),
                   "  {:<10} {} at a coarse spacing, of the spacing's: {}\n", "control",
                   percent(answer.control->error, answer.value), answer.control->words);
  }
  fmt::format_to(std::back_inserter(text),
                 "  {:.3g} s of processor time; the setting:", answer.seconds);
  for (const std::string& setting : settings) text += " --set " + setting;
  return text + "\n";
}

std::string answer_json(const AccuracyRequest& request, const Quantity& quantity,
                        const Answer& answer, const std::vector<std::string>& settings,
                        const std::string& effective) {
  nlohmann::json all = {{"scene", request.scene_file.string()},
                        {"quantity", quantity.text},
                        {"asked", request.accuracy},
                        {"reached", answer.reached},
                        {"value", answer.value},
                        {"bar", answer.bar},
                        {"parts", nlohmann::json::array()},
                        {"settings", settings},
                        {"effective", effective},
                        {"cpu_s", answer.seconds},
                        {"evaluations", answer.evaluations},
                        {"obstacle", answer.obstacle}};
  for (const Part& part : answer.parts) {
    all["parts"].push_back({{"source", part.source}, {"error", part.error}, {"words", part.words}});
  }
  return all.dump(1) + "\n";
}

}  // namespace

double parse_accuracy(const std::string& text) {
  const bool in_percent = text.ends_with('%');
  const char* end = text.data() + text.size() - (in_percent ? 1 : 0);
  double value = 0.0;
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  if (in_percent) value /= 100.0;
  if (failure != std::errc{} || stop != end || !(value > 0.0 && value < 1.0)) {
    throw program::UsageError(
        fmt::format("--accuracy: found {}; allowed is a part of the value, as 2% or 0.02", text));
  }
  return value;
}

double parse_budget(const std::string& text) {
  double seconds = 0.0, last_unit = 1e300;
  std::string_view rest = text;
  while (!rest.empty()) {
    double number = 0.0;
    const auto [stop, failure] =
        std::from_chars(rest.data(), rest.data() + rest.size(), number, std::chars_format::fixed);
    rest.remove_prefix(static_cast<std::size_t>(stop - rest.data()));
    const std::string_view name = rest.starts_with("min") ? "min" : rest.substr(0, 1);
    const double unit = name == "h"                    ? 3600.0
                        : name == "m" || name == "min" ? 60.0
                        : name == "s"                  ? 1.0
                                                       : 0.0;
    const bool good = failure == std::errc{} && number >= 0.0 && unit > 0.0 && unit < last_unit;
    if (!good) {
      seconds = 0.0;
      break;
    }
    seconds += number * unit;
    last_unit = unit;
    rest.remove_prefix(name.size());
  }
  if (!(seconds > 0.0) || !std::isfinite(seconds)) {
    throw program::UsageError(
        fmt::format("--budget: found {}; allowed is a time such as 10min, 5h, 90s, 1h30m", text));
  }
  return seconds;
}

Quantity quantity_of(const scene::Scene& scene) {
  if (scene.drive.kind == scene::DriveKind::displacement) {
    if (scene.drive.width) return parse_quantity("mean_pressure_Pa");
    return parse_quantity(scene.geometry.dimension == 2 ? "reaction_N_per_m" : "reaction_N");
  }
  for (const scene::Measure& measure : scene::resolve_measures(scene)) {
    if (measure.kind != scene::MeasureKind::max_displacement) continue;
    return parse_quantity(measure.name + "_max_displacement_m");
  }
  throw program::UsageError(
      "--quantity is missing: the scene measures several things, and any of them may be meant");
}

double formal_order(const scene::Scene& scene) {
  const bool between = std::ranges::any_of(scene.support, [&](const scene::Support& support) {
    return !support.at.empty() && scene.geometry.layout == scene::Layout::cell;
  });
  return between || std::ranges::any_of(scene.material, scene::yields) ? 1.0 : 2.0;
}

program::ExitCode find_accuracy(const AccuracyRequest& request, std::ostream& out,
                                std::ostream& err) {
  const auto base = read_varied(request.scene_file, request.settings, {}, err);
  if (!base) return program::ExitCode::input_refused;
  const Quantity quantity = request.quantity ? *request.quantity : quantity_of(*base);
  Wish wish;
  wish.accuracy = request.accuracy;
  wish.budget = request.budget;
  wish.spacings = spacings_on_offer(*base);
  wish.formal = formal_order(*base);
  wish.box = !request.far.empty();
  wish.growth = base->geometry.dimension + 1.0;
  if (wish.spacings.size() < 3) {
    throw program::UsageError(
        "--accuracy: fewer than three spacings keep the scene's places whole; it is known of a "
        "ladder of them");
  }
  const std::filesystem::path folder = output_folder(request.folder, request.scene_file, *base);
  std::optional<Answer> answer;
  std::vector<std::string> settings;
  try {
    Runs runs(request, quantity, *base, wish.spacings, folder / "accuracy", out, err);
    answer = climb(wish, [&](const std::vector<Fineness>& asked) { return runs(asked); });
    settings = runs.settings_of(answer->fineness);
  } catch (const Interrupted&) {
    err << "interrupted; the same command goes on, what is finished is not run again\n";
    return program::ExitCode::interrupted;
  }
  // The run says the bar again if its scene is this one.
  const auto final_scene = read_varied(request.scene_file, request.settings, settings, err);
  const std::string effective = final_scene ? scene::effective_toml(*final_scene) : "";
  files::write_text_durably(folder / "accuracy.json",
                            answer_json(request, quantity, *answer, settings, effective));
  if (!answer->parts.empty()) out << answer_text(request, quantity, *answer, settings);
  if (!answer->reached) {
    err << "error: not as accurate as asked for: " << answer->obstacle << '\n';
    return program::ExitCode::not_converged;
  }
  if (request.only_say) return program::ExitCode::done;
  return become_run({request.scene_file, request.settings, folder, request.threads, request.quiet,
                     request.programs},
                    settings, out);
}

}  // namespace study
