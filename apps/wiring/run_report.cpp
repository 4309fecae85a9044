#include "wiring/run_report.hpp"

#include <fmt/format.h>

#include <iterator>

#include "wiring/progress.hpp"
#include "wiring/scene_derived.hpp"

namespace wiring {

namespace {

double mebibytes(std::size_t bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

// The one setting that is most likely to help.
std::string advice(const Scene& scene, const StepResult& result, double max_plastic_strain) {
  const bool finite = scene.approximation.kinematics == KinematicsKind::finite_strain;
  if (!scene.research.enabled && finite && max_plastic_strain > scene.research.trigger) {
    return "neighbourhoods are strained beyond research.trigger: resume with --set "
           "research.enabled=true";
  }
  if (result.status == jfnk::Status::evaluation_limit) {
    return fmt::format("resume with --set solver.max_evaluations_per_step={}",
                       4 * scene.solver.max_evaluations_per_step);
  }
  if (scene.drive.kind == DriveKind::load) {
    return "the load may be beyond what the body carries: drive a displacement instead";
  }
  return fmt::format("resume with --set programme.minimum_increment_ratio={:.2g}",
                     scene.programme.minimum_increment_ratio / 64.0);
}

}  // namespace

std::string check_report(const Scene& scene, std::size_t particles, std::size_t ghosts,
                         std::size_t bytes, std::size_t state_bytes) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  const double per_particle = static_cast<double>(bytes) / static_cast<double>(particles);
  line("model", fmt::format("{} particles, {} mirror ghosts", particles, ghosts));
  line("memory", fmt::format("{:.1f} MiB, {:.0f} bytes per particle, the solver's vectors apart",
                             mebibytes(bytes), per_particle));
  line("checkpoint", fmt::format("at least {:.1f} MiB each", mebibytes(state_bytes)));
  line("steps", fmt::format("{} planned", nominal_steps(scene)));
  return out;
}

template <int Dim>
std::string failure_report(const Scene& scene, const Model<Dim>& model, const State<Dim>& state,
                           const StepResult& result, double max_plastic_strain) {
  std::string where;
  if (result.worst_particle >= 0) {
    const Eigen::Matrix<double, 1, Dim> now = model.particles.position.row(result.worst_particle) +
                                              state.displacement.row(result.worst_particle);
    where = fmt::format(" Worst at particle {}, now at ({:.6g}) m.", result.worst_particle,
                        fmt::join(now.data(), now.data() + Dim, ", "));
  }
  return fmt::format(
      "no convergence at the smallest increment after load {:.6g}: {}.{} Advice: {}.",
      state.programme.load, result.reason, where, advice(scene, result, max_plastic_strain));
}

std::string end_report(const Scene& scene, const std::vector<CurveRow>& history, double elapsed,
                       const RunFolder& folder, const std::filesystem::path& checkpoint) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  const CurveRow& last = history.back();
  std::int64_t evaluations = 0;
  for (const CurveRow& row : history) evaluations += row.evaluations;
  std::string load = fmt::format("{:.6g} of the programme", last.load_parameter);
  if (scene.drive.kind == DriveKind::displacement) {
    load += fmt::format(", settlement {:.6g} m", last.settlement);
    if (scene.drive.reference_length) load += fmt::format(", d/B {:.6g}", last.settlement_over_B);
    line("load", load);
    line("pressure", scene.drive.width ? fmt::format("{:.6g} Pa mean, {:.6g} Pa energy-corrected",
                                                     last.mean_pressure, last.corrected_pressure)
                                       : fmt::format("reaction {:.6g} {}", last.reaction,
                                                     scene.geometry.dimension == 2 ? "N/m" : "N"));
  } else {
    line("load", load);
  }
  const double steps = static_cast<double>(std::max<std::int64_t>(last.step, 1));
  line("steps", fmt::format("{}, {:.1f} evaluations each, in {}", last.step,
                            static_cast<double>(evaluations) / steps, duration_text(elapsed)));
  line("curve", folder.curve().string());
  if (scene.output.frames_every > 0) {
    line("frames", fmt::format("paraview {}", folder.series().string()));
  }
  line("checkpoint", checkpoint.string());
  out.pop_back();  // whoever says it ends the line
  return out;
}

template std::string failure_report<2>(const Scene&, const Model<2>&, const State<2>&,
                                       const StepResult&, double);
template std::string failure_report<3>(const Scene&, const Model<3>&, const State<3>&,
                                       const StepResult&, double);

}  // namespace wiring
