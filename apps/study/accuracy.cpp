#include "study/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <sstream>

#include "campaign/campaign.hpp"
#include "files/durable_file.hpp"
#include "program/command_line.hpp"
#include "program/stop_signals.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/names.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "study/failure.hpp"
#include "study/final_run.hpp"
#include "study/ladder.hpp"
#include "study/levels.hpp"
#include "study/results.hpp"
#include "study/varied_scene.hpp"

namespace study {

namespace {

struct Interrupted {};

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// Makes the runs of the ladder and remembers what they said.
class Runs {
 public:
  Runs(const AccuracyRequest& request, Quantity quantity, const scene::Scene& base,
       std::vector<double> spacings, std::filesystem::path folder, std::ostream& out)
      : request_(request),
        quantity_(std::move(quantity)),
        base_(base),
        far_(request.far.empty() ? std::vector<scene::Side>{} : parse_far(request.far, base)),
        spacings_(std::move(spacings)),
        folder_(std::move(folder)),
        out_(out) {}

  /// Settings of the scene, as --set takes them; nothing, and why, where it is refused.
  [[nodiscard]] std::optional<std::vector<std::string>> settings_of(const Fineness& fineness,
                                                                    std::string& refusal) const {
    std::vector<std::string> settings = settings_of_spacing(base_, spacings_[fineness.level]);
    for (std::string& setting : widened(base_, far_, fineness.box)) {
      settings.push_back(std::move(setting));
    }
    std::ostringstream complaints;
    const auto plain = read_varied(request_.scene_file, request_.settings, settings, complaints);
    if (!plain) {
      refusal = first_line(complaints.str());
      return std::nullopt;
    }
    for (std::string& setting : settings_of_steps(*plain, fineness.steps)) {
      settings.push_back(std::move(setting));
    }
    const double tolerance = scene::resolve_solver(*plain).tolerance * fineness.tolerance;
    settings.push_back(fmt::format("solver.tolerance={}", tolerance));
    // A tighter tolerance takes more of them, and must not be stopped by a limit made for less; how
    // far a failure is followed depends on the limit, which is one for all runs, then.
    constexpr std::int64_t more = 10;
    constexpr std::int64_t largest = std::numeric_limits<int>::max();
    const bool raises = fineness.tolerance != 1.0 || is_of_a_failure(quantity_);
    const std::int64_t most = std::min<std::int64_t>(
        largest, (raises ? more : 1) * plain->solver.max_evaluations_per_step);
    if (raises) {
      settings.push_back(fmt::format("solver.max_evaluations_per_step={}", most));
    }
    // Steps that are halved where they are hard, and grow again, would differ from run to run, and
    // the load with them.
    const scene::Programme& programme = plain->programme;
    settings.push_back(fmt::format(
        "programme.hard_evaluations={}",
        std::max({most, static_cast<std::int64_t>(programme.hard_evaluations),
                  std::min<std::int64_t>(largest, std::int64_t{1} + programme.easy_evaluations)})));
    if (fineness.control != 1.0) {
      settings.push_back(fmt::format("hourglass.stiffness_ratio={}",
                                     scene::resolve_stiffness_ratio(*plain) * fineness.control));
    }
    return settings;
  }

  Reply operator()(const Fineness& one, double allowance) {
    Reply reply;
    std::ostringstream complaints;
    auto settings = settings_of(one, reply.obstacle);
    if (!settings) return reply;
    // The failure that is sought ends a run; one without it has no answer.
    const bool failing = is_of_a_failure(quantity_);
    if (failing) {
      // Nor one that was only given up: that is not known to the smallest increment.
      settings->emplace_back("programme.stop_at_failure=true");
      settings->emplace_back("programme.patience=0");
    }
    const auto scene = read_varied(request_.scene_file, request_.settings, *settings, complaints);
    if (!scene) {
      reply.obstacle = first_line(complaints.str());
      return reply;
    }
    const std::string name = name_of(one);
    campaign::Campaign campaign(
        {{name, campaign::task_scene(with_measure(*scene, quantity_))}},
        {request_.programs / "fpm-run", folder_ / "runs", request_.jobs, request_.threads});
    // With what it took before it was stopped, if it was.
    const auto in_time = [&](const campaign::Status& run) {
      return run.outcome.cost.cpu + run.cpu < allowance;
    };
    campaign.run([&](const auto& all) { return signals_.received() == 0 && in_time(all.front()); });
    if (signals_.received() != 0) throw Interrupted{};
    const Result result = result_of(campaign.status().front(), quantity_);
    reply.value = result.value;
    reply.seconds = result.cost.cpu;
    reply.evaluations = result.evaluations;
    reply.obstacle = result.obstacle;
    reply.of_any_run = result.no_such_column;
    reply.out_of_time = campaign.status().front().stage == campaign::Status::Stage::waiting;
    if (failing) judge_failure(*scene, result, reply);
    if (said_.insert(name).second) say(name, reply);
    return reply;
  }

 private:
  [[nodiscard]] std::string name_of(const Fineness& one) const {
    std::string name = fmt::format("spacing {:.4g}, steps x {}, tolerance x {:.3g}, control x {}",
                                   spacings_[one.level], one.steps, one.tolerance, one.control);
    if (one.box != 1.0) name += fmt::format(", box x {}", one.box);
    return name;
  }

  /// A failure is met in the smallest increments; what bears all of its load has none.
  void judge_failure(const scene::Scene& scene, const Result& result, Reply& reply) const {
    reply.resolution = failure_resolution(scene, quantity_);
    if (!result.value || result.exit_code != 0) return;
    reply.value.reset();
    reply.obstacle = fmt::format(
        "it bears all that it is loaded with, and {} = {} is where its programme ends, not where "
        "it fails",
        quantity_.text, *result.value);
  }

  void say(const std::string& name, const Reply& reply) {
    if (request_.quiet) return;
    const std::string words = reply.value
                                  ? fmt::format("{:.7g}, {:.2f} s", *reply.value, reply.seconds)
                              : reply.out_of_time ? "stopped, the budget is spent"
                                                  : reply.obstacle;
    out_ << fmt::format("  {}: {}", name, words) << std::endl;
  }

  const AccuracyRequest& request_;
  Quantity quantity_;
  const scene::Scene& base_;
  std::vector<scene::Side> far_;
  std::vector<double> spacings_;
  std::filesystem::path folder_;
  std::ostream& out_;
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

/// Whether it is a stress or plastic strain at a point: of a particle, which is as far as half a
/// spacing off, or extrapolated up to a face.
bool is_of_particles_near(const scene::Scene& scene, const Quantity& quantity) {
  if (!quantity.field.empty()) return quantity.field != "displacement";
  return std::ranges::any_of(scene.measure, [&](const scene::Measure& measure) {
    const bool nearest = measure.kind == scene::MeasureKind::stress ||
                         measure.kind == scene::MeasureKind::particle_stress ||
                         measure.kind == scene::MeasureKind::plastic_strain;
    return nearest && quantity.column.starts_with(measure.name + "_");
  });
}

/// Whether something that is moved or loaded ends on a side.
bool has_an_edge(const scene::Scene& scene) {
  const auto drives = scene::all_drives(scene);
  return std::ranges::any_of(drives,
                             [](const scene::Drive* drive) {
                               return !drive->range_min.empty() || scene::is_rigid_body(*drive);
                             }) ||
         std::ranges::any_of(
             scene.traction,
             [](const scene::Traction& traction) { return !traction.range_min.empty(); }) ||
         std::ranges::any_of(scene.side, [](const scene::OutlineSide& side) {
           return side.kind == scene::OutlineKind::footing ||
                  side.kind == scene::OutlineKind::loaded;
         });
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
  if (scene.drive.kind == scene::DriveKind::strength) return parse_quantity("strength_reduction");
  std::string measured;
  for (const scene::Measure& measure : scene::resolve_measures(scene)) {
    if (measure.kind == scene::MeasureKind::max_displacement) {
      return parse_quantity(measure.name + "_max_displacement_m");
    }
    measured += fmt::format(", {} of its measure {}",
                            scene::names_of(measure.kind)[static_cast<std::size_t>(measure.kind)],
                            measure.name);
  }
  throw program::UsageError(fmt::format(
      "--quantity is missing: several may be meant{}; load_parameter, where what grows fails; or a "
      "field at a point, as displacement_y@1,0",
      measured));
}

double formal_order(const scene::Scene& scene, const Quantity& quantity) {
  if (is_of_particles_near(scene, quantity)) return 1.0;
  const bool between = std::ranges::any_of(scene.support, [&](const scene::Support& support) {
    return !support.at.empty() && scene.geometry.layout == scene::Layout::cell;
  });
  if (between) return 1.0;
  constexpr double of_kinks = 1.5;
  if (std::ranges::none_of(scene.material, scene::yields)) return 2.0;
  return has_an_edge(scene) ? 1.0 : of_kinks;
}

program::ExitCode find_accuracy(const AccuracyRequest& request, std::ostream& out,
                                std::ostream& err) {
  const auto base = read_varied(request.scene_file, request.settings, {}, err);
  if (!base) return program::ExitCode::input_refused;
  const Quantity quantity = request.quantity ? *request.quantity : quantity_of(*base);
  check_quantity(*base, quantity);
  Wish wish;
  wish.accuracy = request.accuracy;
  wish.budget = request.budget;
  wish.spacings = spacings_of_a_ladder(*base, request.budget.has_value());
  wish.formal = formal_order(*base, quantity);
  wish.box = !request.far.empty();
  // The residual of what neither yields nor slides is proportional to its error, and tells of it.
  if (std::ranges::any_of(base->material, scene::yields) || scene::may_give_way(*base)) {
    wish.unbalanced = scene::resolve_solver(*base).tolerance;
  }
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
    Runs runs(request, quantity, *base, wish.spacings, folder / "accuracy", out);
    answer =
        climb(wish, [&](const Fineness& one, double allowance) { return runs(one, allowance); });
    std::string refusal;
    settings = runs.settings_of(answer->fineness, refusal).value_or(std::vector<std::string>{});
    if (is_of_a_failure(quantity)) settings.emplace_back("programme.stop_at_failure=false");
  } catch (const Interrupted&) {
    err << "interrupted; the same command goes on, what is finished is not run again\n";
    return program::ExitCode::interrupted;
  }
  // The run says the bar again if its scene is this one.
  const auto final_scene = read_varied(request.scene_file, request.settings, settings, err);
  const std::string effective = final_scene ? scene::effective_toml(*final_scene) : "";
  files::create_folder(folder);  // which no run has made if all were refused
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
