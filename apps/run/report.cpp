#include "run/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "model/model.hpp"
#include "model/standing_water.hpp"
#include "program/progress.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace run {

namespace {

double mebibytes(std::size_t bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

}  // namespace

std::string check_report(const scene::Scene& scene, std::size_t particles, std::size_t ghosts,
                         const std::vector<model::MemoryPart>& parts) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  const auto per_particle = [&](std::size_t bytes) {
    return static_cast<double>(bytes) / static_cast<double>(particles);
  };
  line("model", fmt::format("{} particles, {} ghosts", particles, ghosts));
  const std::size_t bytes = model::total(parts);
  line("memory", fmt::format("{:.1f} MiB, {:.0f} bytes per particle:", mebibytes(bytes),
                             per_particle(bytes)));
  for (const model::MemoryPart& part : parts) {
    if (part.bytes == 0) continue;
    line("", fmt::format("{:5.0f} {}", per_particle(part.bytes), part.name));
  }
  line("", "left out: set-up, a file being written, Krylov vectors beyond twenty");
  line("checkpoint", fmt::format("at least {:.1f} MiB each", mebibytes(parts.front().bytes)));
  line("steps", fmt::format("{} planned", scene::planned_steps(scene)));
  return out;
}

std::string size_note(const scene::Scene& scene, const std::vector<model::MemoryPart>& parts) {
  return fmt::format("{:.1f} MiB of memory, steps planned: {}", mebibytes(model::total(parts)),
                     scene::planned_steps(scene));
}

template <int Dim>
std::vector<std::string> joined_notes(const scene::Scene& scene, const model::Model<Dim>& model) {
  std::vector<std::string> notes;
  for (const model::JoinedFace& face : model.joined_faces) {
    notes.push_back(fmt::format(
        "\"{}\" and \"{}\" are one body, as if \"through\" joined them: at ({:.4g}, {:.4g}) m one "
        "of them runs out into a tip too thin for rows of its own",
        scene.material[static_cast<std::size_t>(face.first)].name,
        scene.material[static_cast<std::size_t>(face.second)].name, face.place.x(),
        face.place.y()));
  }
  for (const model::ThinLayer<Dim>& thin : model.thin_layers) {
    const std::string& layer = scene.material[static_cast<std::size_t>(thin.layer)].name;
    const std::string& beside = scene.material[static_cast<std::size_t>(thin.beside)].name;
    notes.push_back(fmt::format(
        "\"{0}\" is less than three particles thick, as at ({2:.4g}) m, and of one body with "
        "\"{1}\", as if \"through\" joined them: what jumps across it is smeared, and where it "
        "yields \"{1}\" bears what it cannot; use finer particles, or leave the layer out and give "
        "its strength to an [[interface]] between its neighbours",
        layer, beside, fmt::join(thin.place.begin(), thin.place.end(), ", ")));
  }
  return notes;
}

template std::vector<std::string> joined_notes<2>(const scene::Scene&, const model::Model<2>&);
template std::vector<std::string> joined_notes<3>(const scene::Scene&, const model::Model<3>&);

template <int Dim>
std::vector<std::string> water_notes(const scene::Scene& scene, const model::Model<Dim>& model) {
  std::vector<std::string> notes;
  const auto listed = [](const fpm::Vector<Dim>& v) {
    return fmt::format("({:.4g})", fmt::join(v.data(), v.data() + Dim, ", "));
  };
  for (const model::StandingWater<Dim>& water : model::standing_water(scene, model)) {
    notes.push_back(fmt::format(
        "water stands on {}: with up to {:.6g} Pa, at {} m, {:.3g} m deep; it presses with {} {}",
        water.on, water.pressure, listed(water.at), water.pressure / scene.water.unit_weight,
        listed(water.force), Dim == 2 ? "N/m" : "N"));
  }
  return notes;
}

template std::vector<std::string> water_notes<2>(const scene::Scene&, const model::Model<2>&);
template std::vector<std::string> water_notes<3>(const scene::Scene&, const model::Model<3>&);

std::string control_note(const scene::Scene& scene, const record::CurveRow& last) {
  if (last.max_plastic_strain <= 0.0 || !scene::is_controlled_for_collapse(scene)) return "";
  return fmt::format(
      "  {:<12} the ground yields, but bears its loads to the end: displacements beside what "
      "yields scatter less with hourglass.stiffness_ratio = 0.1; the {} of here is for what "
      "ends in a collapse",
      "control", scene::resolve_stiffness_ratio(scene));
}

std::string end_report(const scene::Scene& scene, const std::vector<std::string>& measures,
                       const std::vector<record::CurveRow>& history, double elapsed,
                       const record::RunFolder& folder, const std::filesystem::path& checkpoint) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  const record::CurveRow& last = history.back();
  std::int64_t evaluations = 0;
  for (const record::CurveRow& row : history) evaluations += row.evaluations;
  std::string load = fmt::format("{:.6g} of the programme", last.load_parameter);
  // What the last steps reported: the side that moves, or the one that was moved last and is held.
  const auto reported = scene::reported_drive(scene);
  if (reported) {
    const scene::Drive& drive = *reported->drive;
    const bool displaced = drive.kind == scene::DriveKind::displacement;
    load += fmt::format(", settlement {:.6g} m", last.settlement);
    if (drive.reference_length) load += fmt::format(", d/B {:.6g}", last.settlement_over_B);
    line("load", load);
    std::string pressure = fmt::format("reaction {:.6g} {}", last.reaction,
                                       scene.geometry.dimension == 2 ? "N/m" : "N");
    if (drive.width) {
      pressure = fmt::format("{:.6g} Pa mean", last.mean_pressure);
      if (displaced)
        pressure += fmt::format(", {:.6g} Pa energy-corrected", last.corrected_pressure);
    }
    line("pressure", pressure);
  } else {
    line("load", load);
  }
  for (std::size_t i = 0; i < measures.size(); ++i) {
    line(i == 0 ? "measured" : "", fmt::format("{} = {:.6g}", measures[i], last.measures[i]));
  }
  const double steps = static_cast<double>(std::max<std::int64_t>(last.step, 1));
  line("steps",
       fmt::format("{}, {:.1f} evaluations each, in {}", last.step,
                   static_cast<double>(evaluations) / steps, program::duration_text(elapsed)));
  line("curve", folder.curve().string());
  if (scene.output.frames_every > 0) {
    line("frames", fmt::format("paraview {}", folder.series().string()));
  }
  line("checkpoint", checkpoint.string());
  out.pop_back();  // whoever says it ends the line
  return out;
}

template <int Dim>
std::vector<std::string> lateral_notes(const scene::Scene& scene, const model::Model<Dim>& model) {
  // In the mean: near faces that are not level it is always another.
  constexpr double much = 0.25, least = 0.05;
  const scene::InitialStress& initial = scene.initial_stress;
  if (initial.kind != scene::InitialStressKind::gravity || !initial.K0) return {};
  const Eigen::VectorXd mean = model.initial_stress * model.particles.volume;
  const double ratio = mean[0] / mean[1];
  if (!(mean[1] < 0.0) || std::abs(ratio - *initial.K0) <= std::max(much * *initial.K0, least))
    return {};
  return {fmt::format(
      "initial_stress.K0 asks for {:.3g}; at rest the ground has {:.3g} times its vertical stress "
      "in the mean: what faces bear decides, where they are loaded or not level",
      *initial.K0, ratio)};
}

template std::vector<std::string> lateral_notes<2>(const scene::Scene&, const model::Model<2>&);
template std::vector<std::string> lateral_notes<3>(const scene::Scene&, const model::Model<3>&);

}  // namespace run
