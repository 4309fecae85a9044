#include "limit/command_line.hpp"

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <numbers>

#include "files/durable_file.hpp"
#include "limit/bracket/solve.hpp"
#include "limit/bracket/strength_reduction.hpp"
#include "limit/fields.hpp"
#include "limit/footing/scene_case.hpp"
#include "limit/ground/ground_case.hpp"
#include "limit/ground/ground_of_scene.hpp"
#include "limit/ground/regions_of_box.hpp"
#include "limit/report.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"
#include "record/curve_file.hpp"
#include "scene/reader.hpp"
#include "scene/scene.hpp"
#include "tables/reader.hpp"

namespace limit {

namespace {

namespace po = boost::program_options;
using program::ExitCode;
using program::UsageError;

constexpr double degree = std::numbers::pi / 180.0;

constexpr std::string_view usage =
    "Usage: fpm-limit SCENE [options]\n"
    "       fpm-limit --strip [options]\n"
    "\n"
    "Brackets the collapse load of a strip footing by finite-element limit analysis: a lower and\n"
    "an upper bound, both certified, refined until they are as close as asked for. The footing is\n"
    "that of a scene of fpm-run, or described by options. A scene of fpm-limit's own, of polygons\n"
    "(share/scenes/limit), has other loads, too: pressures, gravity, earthquakes, the strength "
    "itself.\n";

constexpr std::string_view examples =
    "Examples:\n"
    "  fpm-limit share/scenes/footing.toml\n"
    "  fpm-limit share/scenes/footing.toml --set material.soil.cohesion=3e3\n"
    "  fpm-limit --strip --c 2.5e3 --phi 20 --gamma 18150 --half-width 0.22 --rough\n"
    "  fpm-limit --strip --c 1e4 --smooth --gap 1% --json limit.json\n"
    "  fpm-limit share/scenes/limit/slope_safety.toml --set material.soil.cohesion=12e3\n"
    "\n"
    "Any consistent units do, nothing is converted: the table [units] of a scene of polygons and\n"
    "--units of --strip name those that are printed, Pa and m by default. Unit weights are stress\n"
    "over length: kPa/m is kN/m3, psf/ft is pcf.\n"
    "\n"
    "Exit codes: 0 certified and as close as asked, 1 internal error, 2 input refused,\n"
    "3 certified but wider than asked (the bounds are printed), or not certified.\n";

po::options_description options() {
  const bracket::BracketOptions defaults;
  po::options_description all("Options");
  all.add_options()  //
      ("set", po::value<std::vector<std::string>>()->value_name("KEY=VALUE")->composing(),
       "override a key of the scene; may be repeated")  //
      ("curve", po::value<std::string>()->value_name("FILE"),
       "compare the curve.csv of a run of the scene: does its plateau lie in the bracket?")  //
      ("strip", po::bool_switch(),
       "a rigid strip footing on level, homogeneous ground, by the options below")       //
      ("c", po::value<double>()->value_name("PA")->default_value(0.0, "0"), "cohesion")  //
      ("phi", po::value<double>()->value_name("DEG")->default_value(0.0, "0"),
       "friction angle, 0 .. 50")  //
      ("psi", po::value<double>()->value_name("DEG"),
       "dilation angle, 0 .. phi; less than phi: the bracket of Davis' reduced strength is given "
       "beside the other one; default: phi")                                                      //
      ("gamma", po::value<double>()->value_name("N/M3")->default_value(0.0, "0"), "unit weight")  //
      ("surcharge", po::value<double>()->value_name("PA")->default_value(0.0, "0"),
       "pressure on the surface beside the footing")  //
      ("half-width", po::value<double>()->value_name("M")->default_value(1.0, "1"),
       "half the width of the footing")  //
      ("units", po::value<std::string>()->value_name("STRESS,LENGTH")->default_value("Pa,m"),
       "what the numbers of --strip are in, to be printed; e.g. kPa,m or psf,ft")  //
      ("rough", po::bool_switch(), "base with the soil's strength (default)")      //
      ("smooth", po::bool_switch(), "base without shear stress")                   //
      ("no-tension", po::bool_switch(),
       "the footing (of --strip or of a scene of fpm-run) may lift off; default: the soil holds it "
       "down, up to its strength")  //
      ("box-width", po::value<double>()->value_name("N"),
       "modelled ground from the axis, in half widths; default: room for Prandtl's mechanism")  //
      ("box-depth", po::value<double>()->value_name("N"), "and below the surface")              //
      ("gap", po::value<std::string>()->value_name("GAP")->default_value("2%"),
       "refine until (upper - lower) / mean is no more, as 2% or 0.02")  //
      ("max-triangles", po::value<int>()->value_name("N")->default_value(defaults.max_triangles),
       "largest mesh to refine")  //
      ("max-seconds", po::value<double>()->value_name("S")->default_value(defaults.max_seconds),
       "processor time after which no refinement begins")  //
      ("solver", po::value<std::string>()->value_name("NAME")->default_value("interior-point"),
       "who is asked first: interior-point, or ipopt (some seven times slower); the other is the "
       "fall-back")                                                                            //
      ("json", po::value<std::string>()->value_name("FILE"), "write the answer to FILE, too")  //
      ("fields", po::value<std::string>()->value_name("PREFIX"),
       "write PREFIX-lower.hdf (stresses) and PREFIX-upper.hdf (velocities) for ParaView, and "
       "PREFIX-mechanism.svg")                                                           //
      ("verbose", po::bool_switch(), "say each attempt as it ends (to standard error)")  //
      ("version", po::bool_switch(), "print the version")                                //
      ("help", po::bool_switch(), "print this help");
  return all;
}

double gap_of(const std::string& text) {
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, failure] = std::from_chars(text.data(), end, value);
  const bool is_percent = stop + 1 == end && *stop == '%';
  const double gap = is_percent ? value / 100.0 : value;
  if (failure != std::errc{} || !(stop == end || is_percent) || !(gap > 0.0) || gap > 1.0) {
    throw UsageError(
        fmt::format("--gap: found {}; allowed is a share such as 2% or 0.02, up to 100%", text));
  }
  return gap;
}

bracket::BracketOptions bracket_options(const po::variables_map& values) {
  bracket::BracketOptions chosen;
  chosen.gap = gap_of(values["gap"].as<std::string>());
  chosen.max_triangles = values["max-triangles"].as<int>();
  chosen.max_seconds = values["max-seconds"].as<double>();
  const std::string solver = values["solver"].as<std::string>();
  if (solver != "interior-point" && solver != "ipopt") {
    throw UsageError(fmt::format("--solver: found {}; allowed is interior-point or ipopt", solver));
  }
  chosen.engine = solver == "ipopt" ? bracket::Engine::ipopt : bracket::Engine::interior_point;
  if (chosen.max_triangles < 1) {
    throw UsageError(
        fmt::format("--max-triangles: found {}; allowed is 1 or more", chosen.max_triangles));
  }
  if (!(chosen.max_seconds > 0.0)) {
    throw UsageError(
        fmt::format("--max-seconds: found {}; allowed is more than 0", chosen.max_seconds));
  }
  return chosen;
}

problem::Strip strip_of(const po::variables_map& values) {
  if (values["rough"].as<bool>() && values["smooth"].as<bool>()) {
    throw UsageError("--rough and --smooth exclude each other");
  }
  problem::Strip strip;
  strip.soil.cohesion = values["c"].as<double>();
  strip.soil.friction_angle = values["phi"].as<double>() * degree;
  strip.soil.unit_weight = values["gamma"].as<double>();
  strip.surcharge = values["surcharge"].as<double>();
  strip.half_width = values["half-width"].as<double>();
  strip.rough = !values["smooth"].as<bool>();
  strip.tension = !values["no-tension"].as<bool>();
  if (const auto objection = problem::objection_to(strip)) throw UsageError(objection->text());
  return strip;
}

problem::UnitNames unit_names(const po::variables_map& values) {
  const auto text = values["units"].as<std::string>();
  const auto comma = text.find(',');
  if (comma == 0 || comma == std::string::npos || comma + 1 == text.size()) {
    throw UsageError(fmt::format("--units: found {}; allowed is STRESS,LENGTH, e.g. kPa,m", text));
  }
  return {text.substr(0, comma), text.substr(comma + 1)};
}

std::optional<problem::Box> box_of(const po::variables_map& values, const problem::Strip& strip) {
  if (values.count("box-width") == 0 && values.count("box-depth") == 0) return std::nullopt;
  problem::Box box = problem::box_of(strip);
  if (values.count("box-width") != 0) box.width = values["box-width"].as<double>();
  if (values.count("box-depth") != 0) box.depth = values["box-depth"].as<double>();
  if (!(std::isfinite(box.width) && box.width > 1.0) ||
      !(std::isfinite(box.depth) && box.depth > 0.0)) {
    throw UsageError(
        fmt::format("box: found {:g} x {:g} half widths; allowed is wider than 1 and "
                    "deeper than 0",
                    box.width, box.depth));
  }
  return box;
}

/// What is to be bracketed, and the scene of fpm-run it comes from, if it does.
struct Input {
  problem::Cases cases;
  std::optional<scene::Scene> scene;
};

Input input_of_strip(const po::variables_map& values) {
  if (values.count("set") != 0) throw UsageError("--set belongs to a SCENE");
  const problem::Strip strip = strip_of(values);
  const std::optional<problem::Box> box = box_of(values, strip);
  Input input;
  input.cases.associated = problem::strip_case(strip, box, unit_names(values));
  if (values.count("psi") == 0) return input;
  const double psi = values["psi"].as<double>() * degree;
  if (!(psi >= 0.0) || psi > strip.soil.friction_angle) {
    throw UsageError(fmt::format("--psi: found {:g}; allowed is 0 .. phi", psi / degree));
  }
  if (psi == strip.soil.friction_angle) return input;
  problem::Strip weaker = strip;
  weaker.soil = problem::davis_reduced(strip.soil, psi);
  input.cases.davis = problem::strip_case(weaker, box, unit_names(values));
  // Both in the same units, for one report.
  input.cases.davis->units = input.cases.associated.units;
  return input;
}

/// Of a box: half a footing on ground of one strength and weight to a layer has a mesh of its own;
/// all else is ground of polygons.
std::optional<problem::Cases> cases_of_box(const scene::Scene& box, bool tension,
                                           tables::Diagnosis& diagnosis) {
  tables::Diagnosis of_footing = diagnosis;
  if (auto cases = footing::scene_case(box, tension, of_footing)) {
    diagnosis = std::move(of_footing);
    return cases;
  }
  const auto regions = ground::regions_of_box(box, tension, diagnosis);
  if (!regions) return std::nullopt;
  const auto ground = ground::ground_of_scene(*regions, diagnosis);
  if (!ground) return std::nullopt;
  return ground::ground_case(*ground, diagnosis);
}

/// Of polygons or of fpm-run; nothing if the diagnosis or `unreadable` has an error.
std::optional<Input> input_of_scene(const std::string& text, std::span<const std::string> settings,
                                    bool tension, tables::Diagnosis& diagnosis,
                                    std::optional<tables::Complaint>& unreadable) {
  std::optional<problem::Cases> cases;
  std::optional<scene::Scene> scene;
  if (ground::is_ground_scene(text)) {
    if (!tension) {
      throw UsageError(
          "--no-tension: a scene of polygons has the key tension in its footing's side");
    }
    std::optional<ground::GroundScene> ground;
    if (!ground::is_scene_of_both(text)) {
      ground = ground::read_ground_scene(text, settings, diagnosis, unreadable);
    } else if ((scene = scene::parse_scene(text, settings, diagnosis, unreadable))) {
      ground = ground::ground_of_scene(*scene, diagnosis);
    }
    if (ground) cases = ground::ground_case(*ground, diagnosis);
  } else {
    scene = scene::parse_scene(text, settings, diagnosis, unreadable);
    if (scene) cases = cases_of_box(*scene, tension, diagnosis);
  }
  if (!cases) return std::nullopt;
  return Input{std::move(*cases), std::move(scene)};
}

void say(const std::vector<tables::Complaint>& complaints, std::string_view kind,
         std::ostream& err) {
  for (const tables::Complaint& one : complaints) err << kind << ": " << one.text() << '\n';
}

/// Nothing, with every problem said, if the scene is refused.
std::optional<Input> input_of(const po::variables_map& values, std::ostream& err) {
  const std::vector<std::string> scenes = program::texts(values, "scene");
  if (scenes.empty()) {
    if (!values["strip"].as<bool>()) throw UsageError("SCENE or --strip is missing");
    return input_of_strip(values);
  }
  if (scenes.size() > 1) throw UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  for (const char* name : {"strip", "c", "phi", "psi", "gamma", "surcharge", "half-width", "rough",
                           "smooth", "box-width", "box-depth", "units"}) {
    if (values.count(name) == 0 || values[name].defaulted()) continue;
    throw UsageError(fmt::format("--{} and a SCENE exclude each other", name));
  }
  const auto text = scene::text_of(scenes.front());
  if (const auto* complaint = std::get_if<tables::Complaint>(&text)) {
    say({*complaint}, "error", err);
    return std::nullopt;
  }
  tables::Diagnosis diagnosis(scenes.front());
  std::optional<tables::Complaint> unreadable;
  std::optional<Input> input =
      input_of_scene(std::get<std::string>(text), program::texts(values, "set"),
                     !values["no-tension"].as<bool>(), diagnosis, unreadable);
  if (unreadable) say({*unreadable}, "error", err);
  say(diagnosis.warnings(), "warning", err);
  say(diagnosis.errors(), "error", err);
  return input;
}

/// The curve to compare, if one is given. Read first: a bracket is not computed in vain for a file
/// that cannot be read or a curve that cannot be compared.
std::vector<record::CurveRow> curve_of(const po::variables_map& values,
                                       const std::optional<scene::Scene>& scene) {
  if (values.count("curve") == 0) return {};
  if (!scene) throw UsageError("--curve belongs to a SCENE of fpm-run");
  if (!scene->drive.width) {
    throw UsageError(
        "--curve: the scene has no drive.width, without which the curve has no mean "
        "pressure");
  }
  const auto file = values["curve"].as<std::string>();
  std::vector<record::CurveRow> curve = record::read_curve(file);
  if (curve.empty() || !(curve.back().settlement > 0.0)) {
    throw UsageError(fmt::format("--curve: {} has no settlement", file));
  }
  return curve;
}

void write_all_fields(const std::string& prefix, problem::Case problem,
                      const bracket::Solution& found) {
  if (problem.seeks_strength && found.lower) {
    // The stresses are those of the soil with the strength that just carries the loads.
    for (problem::Soil& soil : problem.lower.soils) soil = bracket::weakened(soil, *found.lower);
  }
  const bracket::Bracket& bracket = found.bracket;
  if (bracket.lower) write_fields(prefix + "-lower.hdf", problem, *bracket.lower);
  if (bracket.upper) {
    write_fields(prefix + "-upper.hdf", problem, *bracket.upper);
    write_mechanism(prefix + "-mechanism.svg", problem, *bracket.upper);
  }
}

ExitCode run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  const po::variables_map values = program::parse(arguments, options(), "scene");
  if (values["help"].as<bool>()) {
    out << usage << '\n' << options() << '\n' << examples;
    out << "\nKeys of a scene of polygons:\n" << ground::ground_scene_keys();
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    out << "fpm-limit " << program::version << '\n';
    return ExitCode::done;
  }
  bracket::BracketOptions chosen = bracket_options(values);
  chosen.wants_mechanism = values.count("fields") != 0;
  const std::optional<Input> input = input_of(values, err);
  if (!input) return ExitCode::input_refused;
  const problem::Case& problem = input->cases.associated;
  const std::vector<record::CurveRow> curve = curve_of(values, input->scene);
  const auto watch = [&](const bracket::Attempt& attempt) {
    if (values["verbose"].as<bool>()) err << attempt_line(problem, attempt) << '\n';
  };
  Answer answer{bracket::solution_of(problem, chosen, watch), std::nullopt, std::nullopt};
  if (input->cases.davis) {
    answer.davis = bracket::solution_of(*input->cases.davis, chosen, watch);
  }
  if (values.count("curve") != 0 && answer.found.lower && answer.found.upper) {
    answer.run =
        bounds::check_plateau(curve, *input->scene, *answer.found.lower, *answer.found.upper);
  }
  out << text_report(problem, answer, chosen);
  if (values.count("json") != 0) {
    files::write_text_durably(values["json"].as<std::string>(),
                              json_report(problem, answer, chosen));
  }
  if (values.count("fields") != 0) {
    write_all_fields(values["fields"].as<std::string>(), problem, answer.found);
  }
  return answer.found.bracket.reached ? ExitCode::done : ExitCode::not_converged;
}

}  // namespace

ExitCode fpm_limit(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  return program::run_program("fpm-limit", err, [&] { return run(arguments, out, err); });
}

}  // namespace limit
