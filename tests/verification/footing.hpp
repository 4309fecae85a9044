#pragma once

#include "measure.hpp"

namespace verification {

/// Where the footing's pressure belongs: the finite-strain finite-element curves of
/// share/references, extrapolated to zero element size (59.0 / 61.2 / 62.8 kPa), with room for
/// their uncertainty and for a particle's resolution.
struct PressureWindow {
  double settlement;  // over B
  double lowest;      // [Pa]
  double highest;     // [Pa]
};
constexpr PressureWindow footing_windows[] = {
    {0.01, 56e3, 62e3}, {0.03, 58e3, 63e3}, {0.047, 60e3, 65e3}};

/// Settlement over B and mean pressure [Pa] of converged steps.
using FootingCurve = std::vector<std::vector<double>>;

struct Footing {
  FootingCurve curve;
  double settlement = 0.0;  // over B, reached
  double raw = 0.0;         // [Pa] mean pressure at the end
  double corrected = 0.0;   // [Pa] less what the hourglass control took
  std::int64_t re_searches = 0;
  std::int64_t cuts = 0;
};

/// Runs the footing's scene to its end, or to the step that does not converge.
inline Footing pushed_footing(const Settings& settings) {
  Run<2> run(shipped_scene("footing.toml", settings));
  const double B = reference_length_of(run.scene);
  Footing footing;
  footing.curve.push_back({0.0, 0.0});
  while (!run.stepper.finished()) {
    const stepping::StepResult result = run.stepper.advance();
    footing.cuts += result.record.cuts;
    if (result.outcome != stepping::StepOutcome::converged) break;
    footing.settlement = result.record.settlement / B;
    footing.raw = result.record.mean_pressure;
    footing.corrected = result.record.corrected_pressure;
    footing.curve.push_back({footing.settlement, footing.raw});
  }
  footing.re_searches = run.state.programme.re_searches;
  return footing;
}

inline void expect_in_windows(const FootingCurve& curve) {
  for (const PressureWindow& window : footing_windows) {
    const double p = interpolated(curve, window.settlement);
    std::ostringstream name;
    name << "pressure_kPa_at_" << 100.0 * window.settlement << "_per_cent";
    report(name.str(), 1e-3 * p);
    EXPECT_GT(p, window.lowest) << name.str();
    EXPECT_LT(p, window.highest) << name.str();
  }
}

}  // namespace verification
