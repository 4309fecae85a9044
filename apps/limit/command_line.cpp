#include "limit/command_line.hpp"

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "files/durable_file.hpp"
#include "limit/bracket/solve.hpp"
#include "limit/bracket/strength_reduction.hpp"
#include "limit/fields.hpp"
#include "limit/footing/scene_case.hpp"
#include "limit/ground/ground_case.hpp"
#include "limit/report.hpp"
#include "program/version.hpp"
#include "record/curve_file.hpp"
#include "scene/reader.hpp"
#include "tables/nearest_name.hpp"
#include "tables/reader.hpp"

namespace limit {

namespace {

namespace po = boost::program_options;
using program::ExitCode;

constexpr double degree = std::numbers::pi / 180.0;

constexpr std::string_view usage =
    "Usage: fpm-limit SCENE [options]\n"
    "       fpm-limit --strip [options]\n"
    "\n"
    "Brackets the collapse load of a strip footing by finite-element limit analysis: a lower and\n"
    "an upper bound, both certified, refined until they are as close as asked for. The footing is\n"
    "that of a scene of fpm-run, or described by options. A scene of fpm-limit's own, of polygons\n"
    "(share/scenes/limit), has other loads, too: pressures, gravity, the strength itself.\n";

constexpr std::string_view examples =
    "Examples:\n"
    "  fpm-limit share/scenes/footing.toml\n"
    "  fpm-limit share/scenes/footing.toml --set material.soil.cohesion=3e3\n"
    "  fpm-limit --strip --c 2.5e3 --phi 20 --gamma 18150 --half-width 0.22 --rough\n"
    "  fpm-limit --strip --c 1e4 --smooth --gap 1% --json limit.json\n"
    "  fpm-limit share/scenes/limit/slope_safety.toml --set material.soil.cohesion=12e3\n"
    "\n"
    "Any consistent units do: with kPa, m and kN/m3 the answer is in kPa.\n"
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
       "half the width of the footing")                                        //
      ("rough", po::bool_switch(), "base with the soil's strength (default)")  //
      ("smooth", po::bool_switch(), "base without shear stress")               //
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

/// The command line cannot be understood, or asks for what does not exist.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

po::variables_map parse(std::span<const std::string> arguments) {
  po::options_description all = options();
  all.add_options()("scene", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("scene", -1);
  namespace style = po::command_line_style;
  // No abbreviations: a script must not change its meaning when an option is added.
  const int strict = style::unix_style & ~style::allow_guessing;
  po::variables_map values;
  try {
    const std::vector<std::string> words(arguments.begin(), arguments.end());
    po::store(
        po::command_line_parser(words).options(all).positional(positional).style(strict).run(),
        values);
  } catch (const po::unknown_option& unknown) {
    std::vector<std::string> names;
    const po::options_description known = options();
    for (const auto& option : known.options()) names.push_back("--" + option->long_name());
    const std::string nearest =
        tables::nearest_name(unknown.get_option_name(), {names.begin(), names.end()});
    throw UsageError(fmt::format("{}: no such option{}", unknown.get_option_name(),
                                 nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  } catch (const po::error& failure) {
    throw UsageError(failure.what());
  }
  return values;
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
  return strip;
}

std::optional<problem::Box> box_of(const po::variables_map& values, const problem::Strip& strip) {
  if (values.count("box-width") == 0 && values.count("box-depth") == 0) return std::nullopt;
  problem::Box box = problem::box_of(strip);
  if (values.count("box-width") != 0) box.width = values["box-width"].as<double>();
  if (values.count("box-depth") != 0) box.depth = values["box-depth"].as<double>();
  if (!(box.width > 1.0) || !(box.depth > 0.0)) {
    throw UsageError(
        fmt::format("box: found {:g} x {:g} half widths; allowed is wider than 1 and "
                    "deeper than 0",
                    box.width, box.depth));
  }
  return box;
}

footing::SceneCase case_of_strip(const po::variables_map& values) {
  if (values.count("set") != 0) throw UsageError("--set belongs to a SCENE");
  const problem::Strip strip = strip_of(values);
  const std::optional<problem::Box> box = box_of(values, strip);
  footing::SceneCase result{problem::strip_case(strip, box), std::nullopt, std::nullopt};
  if (values.count("psi") == 0) return result;
  const double psi = values["psi"].as<double>() * degree;
  if (!(psi >= 0.0) || psi > strip.soil.friction_angle) {
    throw UsageError(fmt::format("--psi: found {:g}; allowed is 0 .. phi", psi / degree));
  }
  if (psi == strip.soil.friction_angle) return result;
  problem::Strip weaker = strip;
  weaker.soil = problem::davis_reduced(strip.soil, psi);
  result.davis = problem::strip_case(weaker, box);
  // Both in the same units, for one report.
  result.davis->units = result.associated.units;
  return result;
}

void say_errors(const std::vector<tables::Problem>& errors, std::ostream& err) {
  for (const tables::Problem& one : errors) err << "error: " << one.text() << '\n';
}

std::optional<footing::SceneCase> case_of_ground(const std::string& file, const std::string& text,
                                                 std::span<const std::string> settings,
                                                 std::ostream& err) {
  tables::Diagnosis diagnosis(file);
  std::optional<tables::Problem> unreadable;
  const auto scene = ground::read_ground_scene(text, settings, diagnosis, unreadable);
  if (unreadable) say_errors({*unreadable}, err);
  std::optional<footing::SceneCase> result;
  if (scene) result = ground::ground_case(*scene, diagnosis);
  say_errors(diagnosis.errors(), err);
  return result;
}

/// Nothing, with every problem said, if the scene is refused by its reader.
std::optional<footing::SceneCase> case_of(const po::variables_map& values, std::ostream& err) {
  if (values.count("scene") == 0) {
    if (!values["strip"].as<bool>()) throw UsageError("SCENE or --strip is missing");
    return case_of_strip(values);
  }
  const auto scenes = values["scene"].as<std::vector<std::string>>();
  if (scenes.size() > 1) throw UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  for (const char* name : {"strip", "c", "phi", "psi", "gamma", "surcharge", "half-width", "rough",
                           "smooth", "box-width", "box-depth"}) {
    if (values.count(name) == 0 || values[name].defaulted()) continue;
    throw UsageError(fmt::format("--{} and a SCENE exclude each other", name));
  }
  const auto settings = values.count("set") != 0 ? values["set"].as<std::vector<std::string>>()
                                                 : std::vector<std::string>{};
  const auto text = tables::text_of(scenes.front());
  if (const auto* problem = std::get_if<tables::Problem>(&text)) {
    say_errors({*problem}, err);
    return std::nullopt;
  }
  const bool tension = !values["no-tension"].as<bool>();
  if (ground::is_ground_scene(std::get<std::string>(text))) {
    if (!tension) {
      throw UsageError(
          "--no-tension: a scene of polygons has the key tension in its footing's side");
    }
    return case_of_ground(scenes.front(), std::get<std::string>(text), settings, err);
  }
  const scene::SceneReading reading =
      scene::parse_scene(std::get<std::string>(text), scenes.front(), settings);
  for (const tables::Problem& one : reading.warnings) err << "warning: " << one.text() << '\n';
  say_errors(reading.errors, err);
  if (!reading.scene) return std::nullopt;
  return footing::scene_case(*reading.scene, tension);
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
  const po::variables_map values = parse(arguments);
  if (values["help"].as<bool>()) {
    out << usage << '\n' << options() << '\n' << examples;
    out << "\nKeys of a scene of polygons:\n" << ground::ground_scene_keys();
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    out << "fpm-limit " << program::version << '\n';
    return ExitCode::done;
  }
  const bracket::BracketOptions chosen = bracket_options(values);
  const std::optional<footing::SceneCase> problem = case_of(values, err);
  if (!problem) return ExitCode::input_refused;
  std::vector<record::CurveRow> curve;
  if (values.count("curve") != 0) {
    if (!problem->scene) throw UsageError("--curve belongs to a SCENE of fpm-run");
    // Read first: a bracket is not computed in vain for a file that cannot be read.
    curve = record::read_curve(values["curve"].as<std::string>());
  }
  const auto watch = [&](const bracket::Attempt& attempt) {
    if (values["verbose"].as<bool>()) err << attempt_line(problem->associated, attempt) << '\n';
  };
  Answer answer{bracket::solution_of(problem->associated, chosen, watch), std::nullopt,
                std::nullopt};
  if (problem->davis) answer.davis = bracket::solution_of(*problem->davis, chosen, watch);
  if (values.count("curve") != 0 && answer.found.lower && answer.found.upper) {
    answer.run =
        bounds::check_plateau(curve, *problem->scene, *answer.found.lower, *answer.found.upper);
  }
  out << text_report(problem->associated, answer, chosen);
  if (values.count("json") != 0) {
    files::write_text_durably(values["json"].as<std::string>(),
                              json_report(problem->associated, answer, chosen));
  }
  if (values.count("fields") != 0) {
    write_all_fields(values["fields"].as<std::string>(), problem->associated, answer.found);
  }
  return answer.found.bracket.reached ? ExitCode::done : ExitCode::not_converged;
}

}  // namespace

ExitCode fpm_limit(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  try {
    return run(arguments, out, err);
  } catch (const UsageError& failure) {
    err << "error: " << failure.what() << "\nTry fpm-limit --help.\n";
    return ExitCode::input_refused;
  } catch (const std::invalid_argument& failure) {
    err << "error: " << failure.what() << '\n';
    return ExitCode::input_refused;
  } catch (const files::FileError& failure) {
    err << "error: " << failure.what() << '\n';
    return ExitCode::checkpoint_unusable;
  } catch (const std::exception& failure) {
    err << "internal error: " << failure.what() << "\nThis is a bug: please report it.\n";
    return ExitCode::bug;
  }
}

}  // namespace limit
