#pragma once

#include <string>
#include <vector>

#include "measure.hpp"

namespace verification {

/// Collapse loads N_c of a strip on weightless, associated soil (Prandtl 1920, Reissner 1924):
/// 2 + pi for phi = 0, else (e^{pi tan phi} tan^2(45 + phi/2) - 1) cot phi; cohesion 1 kPa.
constexpr double exact_pressure_phi0 = 5141.593;
constexpr double exact_pressure_phi20 = 14834.712;

/// The scenes' accuracy targets by resolution.
constexpr double target_at_16 = 0.013;
constexpr double target_at_32 = 0.007;

struct LimitLoad {
  double raw = 0.0;        // relative error of the load at the end of the programme
  double corrected = 0.0;  // likewise, of the energy-corrected load
};

inline LimitLoad limit_load(const std::string& scene, double exact, int particles,
                            const Settings& more = {}) {
  Settings settings = {"geometry.spacing=" + std::to_string(1.0 / particles)};
  settings.insert(settings.end(), more.begin(), more.end());
  Run<2> run(shipped_scene(scene, settings));
  const stepping::StepRecord last = run.complete().back();
  const LimitLoad load = {last.mean_pressure / exact - 1.0, last.corrected_pressure / exact - 1.0};
  report("raw_error_at_" + std::to_string(particles), load.raw);
  report("corrected_error_at_" + std::to_string(particles), load.corrected);
  return load;
}

}  // namespace verification
