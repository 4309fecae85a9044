#include "run/command_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <charconv>
#include <iterator>
#include <new>

#include "model/build.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/names.hpp"
#include "scene/print.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace run {

namespace {

namespace po = boost::program_options;

constexpr std::string_view usage =
    "Usage: fpm-run SCENE [options]\n"
    "\n"
    "Runs a scene of the Finite Particle Method and writes curve.csv, frames for ParaView,\n"
    "checkpoints and a log to its output folder.\n";

constexpr std::string_view examples =
    "Examples:\n"
    "  fpm-run share/scenes/footing.toml\n"
    "  fpm-run share/scenes/footing.toml --check\n"
    "  fpm-run share/scenes/prandtl_phi0.toml --accuracy 2% --budget 10min\n"
    "  fpm-run share/scenes/footing.toml --set geometry.spacing=0.005 --out out/fine\n"
    "  fpm-run share/scenes/footing.toml --resume --set re_search.enabled=true\n"
    "  fpm-run share/scenes/footing.toml --resume out/footing/checkpoints/step-000120.hdf \\\n"
    "    --out out/branch --set solver.tolerance=3e-4\n"
    "\n"
    "Exit codes: 0 done, 1 internal error, 2 input refused, 3 not converged,\n"
    "4 file or checkpoint unusable, 75 interrupted and resumable.\n";

po::options_description options() {
  po::options_description all("Options");
  all.add_options()  //
      ("set", po::value<std::vector<std::string>>()->value_name("KEY=VALUE")->composing(),
       "override a key of the scene, as geometry.spacing=0.02, material.0.cohesion=3e3 or "
       "material.soil.cohesion=3e3; may be repeated")  //
      ("out", po::value<std::string>()->value_name("DIR"),
       "output folder; default: output.directory of the scene, else out/ and the scene's name")  //
      ("check", po::bool_switch(), "validate all, say particles and memory, do not run")         //
      ("print-effective", po::bool_switch(),
       "print the scene with every key and the settings applied, do not run")  //
      ("resume", po::value<std::string>()->value_name("[CKPT]")->implicit_value(""),
       "go on from a checkpoint file, or from the newest one in that run's folder or the output "
       "folder")  //
      ("from-stage", po::value<std::string>()->value_name("NAME"),
       "go on with this stage, from the end of the one before in that run; it and later ones may "
       "have been changed")  //
      ("accuracy", po::value<std::string>()->value_name("PART"),
       "how far the answer may be off, as 2% or 0.02: a ladder of cheap runs (fpm-study) finds the "
       "coarsest setting that is as good, says the answer with its error bar, and that runs")  //
      ("budget", po::value<std::string>()->value_name("TIME"),
       "of --accuracy: processor time of the ladder, as 10min, 5h, 90s")  //
      ("quantity", po::value<std::string>()->value_name("QUANTITY"),
       "of --accuracy: what the answer is, as fpm-study --help says; default: the mean pressure, "
       "the reaction or the largest displacement")  //
      ("far", po::value<std::string>()->value_name("SIDES"),
       "of --accuracy: sides, as left,bottom, that are only where the ground that is looked at "
       "ends; "
       "what they do is part of the error bar")  //
      ("quality", po::value<std::string>()->value_name("WORD"),
       "draft, normal or fine: coarser, as, or finer than the scene says; share/doc/trade.md has "
       "what each costs and how far off it is")  //
      ("threads", po::value<int>()->value_name("N"),
       "threads, at least 1; results do not depend on it; default: OpenMP's choice")  //
      ("max-wall", po::value<std::string>()->value_name("TIME"),
       "stop resumably after this time: 5h, 30m, 90s, 1h30m")  //
      ("draw", po::value<std::string>()->value_name("FILE.svg"),
       "check the scene and draw it: particles, materials, what holds and loads them")  //
      ("quiet", po::bool_switch(), "no progress; warnings and errors only")             //
      ("scene-reference", po::bool_switch(), "print the reference of all keys")         //
      ("version", po::bool_switch(), "print the version")                               //
      ("help", po::bool_switch(), "print this help");
  return all;
}

/// Makes clear to Boost what --resume, whose value is optional, has for a value: the next word is
/// it unless it is another option or the scene, which Boost would take as well.
std::vector<std::string> with_clear_resume(std::span<const std::string> arguments) {
  std::vector<std::string> clear, last;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool has_word = arguments[i] == "--resume" && i + 1 < arguments.size() &&
                          !arguments[i + 1].starts_with("-");
    if (!has_word) {
      clear.push_back(arguments[i]);
    } else if (arguments[i + 1].ends_with(".toml")) {
      last.push_back(arguments[i]);
    } else {
      clear.push_back(arguments[i] + "=" + arguments[i + 1]);
      ++i;
    }
  }
  clear.insert(clear.end(), last.begin(), last.end());
  return clear;
}

std::filesystem::path output_folder(const po::variables_map& values, const scene::Scene& scene,
                                    const std::filesystem::path& file) {
  if (values.count("out") != 0) return values["out"].as<std::string>();
  if (scene.output.directory) return *scene.output.directory;
  return std::filesystem::path("out") / file.stem();
}

std::optional<AccuracyWish> accuracy_of(const po::variables_map& values) {
  const auto text = [&](const char* name) {
    return values.count(name) != 0 ? std::optional(values[name].as<std::string>()) : std::nullopt;
  };
  const auto accuracy = text("accuracy");
  for (const char* name : {"budget", "quantity", "far"}) {
    if (accuracy || values.count(name) == 0) continue;
    throw program::UsageError(fmt::format("--{}: it is one of --accuracy", name));
  }
  const auto quality = text("quality");
  if (!accuracy && !quality) return std::nullopt;
  if (accuracy && quality) {
    throw program::UsageError("--quality: --accuracy says itself how fine the scene runs");
  }
  if (values.count("resume") != 0 || values.count("max-wall") != 0 || values["check"].as<bool>()) {
    throw program::UsageError(fmt::format(
        "--{}: it goes with neither --resume, --max-wall nor --check; interrupted, the same "
        "command goes on",
        accuracy ? "accuracy" : "quality"));
  }
  if (quality) return std::nullopt;
  return AccuracyWish{*accuracy, text("budget"), text("quantity"), text("far")};
}

RunRequest request_of(const po::variables_map& values) {
  RunRequest request;
  const auto scenes = program::texts(values, "scene");
  if (scenes.empty()) throw program::UsageError("SCENE is missing");
  if (scenes.size() > 1)
    throw program::UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  request.scene_file = scenes.front();
  request.settings = program::texts(values, "set");
  if (values.count("resume") != 0) request.resume = ResumeFrom{values["resume"].as<std::string>()};
  request.accuracy = accuracy_of(values);
  if (values.count("quality") != 0) request.quality = values["quality"].as<std::string>();
  request.check_only = values["check"].as<bool>();
  if (values.count("draw") != 0) {
    request.drawing = values["draw"].as<std::string>();
    request.check_only = true;
  }
  request.quiet = values["quiet"].as<bool>();
  if (values.count("threads") != 0) {
    request.threads = values["threads"].as<int>();
    constexpr int most_threads = 4096;
    if (request.threads < 1 || request.threads > most_threads) {
      throw program::UsageError(fmt::format(
          "--threads: found {}; allowed is a whole number 1 .. {}", request.threads, most_threads));
    }
  }
  if (values.count("max-wall") != 0) {
    const auto text = values["max-wall"].as<std::string>();
    request.max_wall_s = parse_duration(text);
    if (!request.max_wall_s) {
      throw program::UsageError(
          fmt::format("--max-wall: found {}; allowed is a time such as 5h, 30m, 90s, 1h30m", text));
    }
  }
  return request;
}

/// Whether the stage to go on with is one.
bool take_stage(RunRequest& request, const po::variables_map& values, std::ostream& err) {
  if (values.count("from-stage") == 0) return true;
  const auto name = values["from-stage"].as<std::string>();
  const auto& stages = request.scene->stage;
  const auto found = std::ranges::find(stages, name, &scene::Stage::name);
  if (found != stages.begin() && found != stages.end()) {
    if (!request.resume) request.resume.emplace();
    request.resume->stage = static_cast<std::size_t>(found - stages.begin());
    return true;
  }
  std::string names;
  for (const scene::Stage& stage : stages) names += (names.empty() ? "" : ", ") + stage.name;
  err << fmt::format("error: --from-stage: found \"{}\"; {}\n", name,
                     stages.empty()            ? "the scene has no stages"
                     : found == stages.begin() ? "with the first stage a run begins: leave it out"
                                               : "stages are " + names);
  return false;
}

/// Reads the scene into the request; false, with every complaint, if it is refused.
bool take_scene(RunRequest& request, const po::variables_map& values, std::ostream& err) {
  scene::SceneReading reading = scene::read_scene(request.scene_file, request.settings);
  for (const tables::Complaint& complaint : reading.warnings)
    err << "warning: " << complaint.text() << '\n';
  for (const tables::Complaint& complaint : reading.errors)
    err << "error: " << complaint.text() << '\n';
  if (!reading.scene) return false;
  request.scene = std::move(reading.scene);
  request.directory = output_folder(values, *request.scene, request.scene_file);
  return take_stage(request, values, err);
}

program::ExitCode run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err,
                      const Runner& runner) {
  const po::variables_map values = program::parse(with_clear_resume(arguments), options(), "scene");
  if (values["help"].as<bool>()) {
    out << usage << '\n' << options() << '\n' << examples;
    return program::ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    out << "fpm-run " << program::version << '\n';
    return program::ExitCode::done;
  }
  if (values["scene-reference"].as<bool>()) {
    out << scene::scene_reference();
    return program::ExitCode::done;
  }
  RunRequest request = request_of(values);
  if (!take_scene(request, values, err)) return program::ExitCode::input_refused;
  if (values["print-effective"].as<bool>()) {
    out << scene::effective_toml(*request.scene);
    return program::ExitCode::done;
  }
  if (request.check_only) out << scene_summary(*request.scene);
  out.flush();
  const program::ExitCode code = runner(request);
  // Some errors show when the model is built only.
  if (request.check_only && code == program::ExitCode::done) {
    out << request.scene_file.string() << ": no errors\n";
    out.flush();
  }
  return code;
}

}  // namespace

std::optional<double> parse_duration(std::string_view text) {
  double seconds = 0.0;
  double last_unit = 1e300;  // units descend: 1h30m, not 30m1h
  if (text.empty()) return std::nullopt;
  while (!text.empty()) {
    double number = 0.0;
    const auto [stop, failure] =
        std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (failure != std::errc{} || stop == text.data() + text.size()) return std::nullopt;
    const double unit = *stop == 'h' ? 3600.0 : *stop == 'm' ? 60.0 : *stop == 's' ? 1.0 : 0.0;
    const bool plain = text.front() >= '0' && text.front() <= '9';  // no sign, inf, nan
    if (!plain || unit == 0.0 || unit >= last_unit) return std::nullopt;
    seconds += number * unit;
    last_unit = unit;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()) + 1);
  }
  return seconds > 0.0 ? std::optional<double>(seconds) : std::nullopt;
}

namespace {

template <int Dim>
std::string graded_text(const scene::Scene& scene) {
  const fpm::Cells<Dim> cells = model::cells_of<Dim>(scene);
  double widest = 0.0;
  for (fpm::Index a = 0; a < cells.size(); ++a) widest = std::max(widest, cells.width(a));
  return fmt::format("{} (graded, spacing {} to {} m)", cells.size(), scene.geometry.spacing,
                     widest);
}

std::string particles_text(const scene::Scene& scene) {
  if (scene::has_elements(scene)) {
    return fmt::format("{} (elements of a mesh, the finest {:.4g} m apart)",
                       model::particle_count(scene), scene.geometry.spacing);
  }
  if (scene::is_cut(scene)) {
    return fmt::format("{} ({}cut to shape, spacing {} m)", model::particle_count(scene),
                       scene.grading.enabled ? "graded, " : "", scene.geometry.spacing);
  }
  if (scene.grading.enabled) {
    return scene.geometry.dimension == 2 ? graded_text<2>(scene) : graded_text<3>(scene);
  }
  const auto counts = scene::lattice_counts(scene.geometry);
  std::string lattice = fmt::format("{} x {}", counts[0], counts[1]);
  if (scene.geometry.dimension == 3) lattice += fmt::format(" x {}", counts[2]);
  return fmt::format("{} ({}, spacing {} m)", scene::particle_count(scene.geometry), lattice,
                     scene.geometry.spacing);
}

}  // namespace

std::string scene_summary(const scene::Scene& scene) {
  std::string out;
  const auto line = [&out](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(out), "  {:<12} {}\n", name, value);
  };
  if (!scene.title.empty()) line("title", scene.title);
  line("particles", particles_text(scene));
  for (const scene::Material& material : scene.material) {
    line("material", fmt::format("{}: {}", material.name, material.model));
  }
  line("kinematics", std::string(scene::name_of(scene.approximation.kinematics)));
  line("hourglass",
       fmt::format("{}, stiffness ratio {}", scene::name_of(scene::resolve_control(scene)),
                   scene::resolve_stiffness_ratio(scene)));
  std::string drives;
  for (const scene::NamedDrive& drive : scene::drives_of(scene)) {
    const bool unused = drive.drive->kind == scene::DriveKind::none;
    if (unused && scene::has_stage_drives(scene)) continue;
    if (!drives.empty()) drives += ", ";
    drives += scene::name_of(drive.drive->kind);
    if (scene::has_stage_drives(scene)) drives += fmt::format(" \"{}\"", drive.name);
  }
  line("drive", fmt::format("{}, {} steps", drives, scene::planned_steps(scene)));
  const scene::SolverSettings solver = scene::resolve_solver(scene);
  line("solver", fmt::format("{}, {} Jacobian, {} preconditioner, tolerance {}",
                             scene::name_of(solver.method), scene::name_of(solver.jacobian),
                             scene::name_of(solver.preconditioner), solver.tolerance));
  line("re-search", scene.re_search.enabled ? "on" : "off");
  return out;
}

program::ExitCode fpm_run(std::span<const std::string> arguments, std::ostream& out,
                          std::ostream& err, const Runner& runner) {
  return program::run_program("fpm-run", err, [&] {
    try {
      return run(arguments, out, err, runner);
    } catch (const std::bad_alloc&) {
      err << "error: out of memory; --check says how much a scene needs\n";
      return program::ExitCode::bug;
    }
  });
}

}  // namespace run
