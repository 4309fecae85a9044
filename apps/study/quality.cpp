#include "study/quality.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string_view>

#include "program/command_line.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "study/levels.hpp"
#include "study/varied_scene.hpp"

namespace study {

namespace {

constexpr std::array<std::string_view, 3> names{"draft", "normal", "fine"};

/// What the front says: error is bought with the spacing; steps buy next to nothing, and at a
/// coarse spacing the tolerance does not either.
constexpr double coarser = 2.0, finer = 0.5;
constexpr double looser = 10.0, loosest = 0.01;

/// Whether a looser tolerance decides little: not where what gives way is borne until it no longer
/// is. A failure is met late then: 11 % of the weight of share/scenes/slope.toml at a tolerance of
/// 0.01 instead of 0.001, 27 % of the factor that the strength of excavation.toml is divided by.
bool may_be_loose(const scene::Scene& scene) {
  return !scene::may_give_way(scene);
}

}  // namespace

Quality parse_quality(const std::string& text) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (text == names[i]) return static_cast<Quality>(i);
  }
  throw program::UsageError(
      fmt::format("--quality: found {}; allowed are {}", text, fmt::join(names, ", ")));
}

std::vector<std::string> settings_of(Quality quality, const scene::Scene& scene) {
  if (quality == Quality::normal) return {};
  const double own = scene.geometry.spacing;
  const double wanted = own * (quality == Quality::draft ? coarser : finer);
  std::optional<double> best;
  constexpr double the_same = 1.01;
  for (const double spacing : spacings_on_offer(scene)) {
    const bool on_that_side =
        quality == Quality::draft ? spacing > the_same * own : spacing * the_same < own;
    if (!on_that_side) continue;
    const auto off = [&](double one) { return std::abs(std::log(one / wanted)); };
    if (!best || off(spacing) < off(*best)) best = spacing;
  }
  std::vector<std::string> settings;
  if (best) settings = settings_of_spacing(scene, *best);
  if (quality == Quality::draft && may_be_loose(scene)) {
    const double tolerance = scene::resolve_solver(scene).tolerance;
    settings.push_back(
        fmt::format("solver.tolerance={}", std::clamp(looser * tolerance, tolerance, loosest)));
  }
  return settings;
}

program::ExitCode run_quality(FinalRun run, Quality quality, bool only_say, std::ostream& out,
                              std::ostream& err) {
  const auto scene = read_varied(run.scene_file, run.settings, {}, err);
  if (!scene) return program::ExitCode::input_refused;
  const std::vector<std::string> settings = settings_of(quality, *scene);
  const std::string_view name = names[static_cast<std::size_t>(quality)];
  const auto is_spacing = [](const std::string& one) {
    return one.starts_with("geometry.spacing");
  };
  if (quality != Quality::normal && std::ranges::none_of(settings, is_spacing)) {
    err << fmt::format(
        "warning: --quality {}: no other spacing keeps the scene's places a whole number of "
        "cells\n",
        name);
  }
  if (!run.quiet || only_say) {
    out << fmt::format("quality {}:", name);
    for (const std::string& setting : settings) out << " --set " << setting;
    out << (settings.empty() ? " the scene as it is\n" : "\n");
  }
  if (only_say) return program::ExitCode::done;
  run.folder = output_folder(run.folder, run.scene_file, *scene);
  return become_run(run, settings, out);
}

}  // namespace study
