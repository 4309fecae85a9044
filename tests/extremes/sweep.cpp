#include "sweep.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <cstdlib>
#include <exception>
#include <optional>

#include "scene/reader.hpp"
#include "scene/scene.hpp"

namespace extremes {
namespace {

/// What became of a sample: an error of its answer, or words in its stead.
struct Outcome {
  std::optional<double> error;
  std::string refusal;
};

Outcome outcome_of(const Axis& axis, std::size_t k) {
  const scene::SceneReading reading = scene::parse_scene(axis.samples[k].scene, "scene");
  if (!reading.scene) return {{}, reading.errors.front().text()};
  try {
    if (axis.course) return {axis.course(verification::TestScene(*reading.scene), k), ""};
    PlaneRun run{verification::TestScene(*reading.scene)};
    while (!run.stepper.finished()) {
      const stepping::StepResult result = run.stepper.advance();
      if (result.outcome != stepping::StepOutcome::converged)
        return {{}, "run ends: " + result.reason};
    }
    expect_finite(run);
    return {axis.error(run, k), ""};
  } catch (const std::exception& refusal) {
    return {{}, refusal.what()};
  }
}

// The first of each kind of refusal is shown; what differs is in numbers.
std::string shortened(std::string text) {
  constexpr std::size_t most = 150;
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) {
    text.replace(at, 1, "\\|");
  }
  const std::size_t end = text.find('\n');
  if (end != std::string::npos) text.resize(end);
  if (text.size() > most) text = text.substr(0, most) + " …";
  return text;
}

void write(const std::string& row) {
  const char* const to = std::getenv("EXTREMES_WRITE");
  if (to != nullptr) std::ofstream(to, std::ios::app) << row << '\n';
}

}  // namespace

void sweep(const Axis& axis) {
  omp_set_num_threads(1);  // so few particles keep no more of them busy
  std::string right, beyond;
  double largest = 0.0;
  for (std::size_t k = 0; k < axis.samples.size(); ++k) {
    const Sample& sample = axis.samples[k];
    SCOPED_TRACE(axis.name + " " + sample.value);
    const Outcome outcome = outcome_of(axis, k);
    if (outcome.error) {
      EXPECT_LE(*outcome.error, axis.tolerance) << "silently wrong";
      largest = std::max(largest, *outcome.error);
      right += (right.empty() ? "" : ", ") + sample.value;
      continue;
    }
    EXPECT_FALSE(sample.is_held) << outcome.refusal;
    if (beyond.find(shortened(outcome.refusal)) != std::string::npos) continue;
    beyond += fmt::format("{}{}: {}", beyond.empty() ? "" : "; ", sample.value,
                          shortened(outcome.refusal));
  }
  write(fmt::format("| {} | {} | {} | {:.0e} (bound {:.0e}: {}) | {} |", axis.name, axis.problem,
                    right, largest, axis.tolerance, axis.source, beyond.empty() ? "–" : beyond));
}

}  // namespace extremes
