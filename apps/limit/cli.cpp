#include "limit/cli.hpp"

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "limit/report.hpp"
#include "wiring/durable_file.hpp"
#include "wiring/nearest_name.hpp"
#include "wiring/version.hpp"

namespace limit {

namespace {

namespace po = boost::program_options;
using wiring::ExitCode;

constexpr double degree = std::numbers::pi / 180.0;

constexpr std::string_view usage =
    "Usage: fpm-limit --strip [options]\n"
    "\n"
    "Brackets the collapse load of a strip footing by finite-element limit analysis: a lower and\n"
    "an upper bound, both certified, refined until they are as close as asked for.\n";

constexpr std::string_view examples =
    "Examples:\n"
    "  fpm-limit --strip --c 2.5e3 --phi 20 --gamma 18150 --half-width 0.22 --rough\n"
    "  fpm-limit --strip --c 1e4 --smooth --gap 1% --json limit.json\n"
    "\n"
    "Any consistent units do: with kPa, m and kN/m3 the answer is in kPa.\n"
    "\n"
    "Exit codes: 0 certified and as close as asked, 1 internal error, 2 input refused,\n"
    "3 certified but wider than asked (the bounds are printed), or not certified.\n";

po::options_description options() {
  const BracketOptions defaults;
  po::options_description all("Options");
  all.add_options()                                                                       //
      ("strip", po::bool_switch(), "a rigid strip footing on level, homogeneous ground")  //
      ("c", po::value<double>()->value_name("PA")->default_value(0.0, "0"), "cohesion")   //
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
      ("box-width", po::value<double>()->value_name("N"),
       "modelled ground from the axis, in half widths; default: room for Prandtl's mechanism")  //
      ("box-depth", po::value<double>()->value_name("N"), "and below the surface")              //
      ("gap", po::value<std::string>()->value_name("GAP")->default_value("2%"),
       "refine until (upper - lower) / mean is no more, as 2% or 0.02")  //
      ("max-triangles", po::value<int>()->value_name("N")->default_value(defaults.max_triangles),
       "largest mesh to refine")  //
      ("max-seconds", po::value<double>()->value_name("S")->default_value(defaults.max_seconds),
       "processor time after which no refinement begins")                                      //
      ("json", po::value<std::string>()->value_name("FILE"), "write the answer to FILE, too")  //
      ("verbose", po::bool_switch(), "say each attempt as it ends (to standard error)")        //
      ("version", po::bool_switch(), "print the version")                                      //
      ("help", po::bool_switch(), "print this help");
  return all;
}

/// The command line cannot be understood, or asks for what does not exist.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

po::variables_map parse(std::span<const std::string> arguments) {
  const po::options_description all = options();
  namespace style = po::command_line_style;
  // No abbreviations: a script must not change its meaning when an option is added.
  const int strict = style::unix_style & ~style::allow_guessing;
  po::variables_map values;
  try {
    const std::vector<std::string> words(arguments.begin(), arguments.end());
    po::store(po::command_line_parser(words)
                  .options(all)
                  .positional(po::positional_options_description())
                  .style(strict)
                  .run(),
              values);
  } catch (const po::unknown_option& unknown) {
    std::vector<std::string> names;
    for (const auto& option : all.options()) names.push_back("--" + option->long_name());
    const std::string nearest =
        wiring::nearest_name(unknown.get_option_name(), {names.begin(), names.end()});
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

BracketOptions bracket_options(const po::variables_map& values) {
  BracketOptions chosen;
  chosen.gap = gap_of(values["gap"].as<std::string>());
  chosen.max_triangles = values["max-triangles"].as<int>();
  chosen.max_seconds = values["max-seconds"].as<double>();
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

Strip strip_of(const po::variables_map& values) {
  if (values["rough"].as<bool>() && values["smooth"].as<bool>()) {
    throw UsageError("--rough and --smooth exclude each other");
  }
  Strip strip;
  strip.soil.cohesion = values["c"].as<double>();
  strip.soil.friction_angle = values["phi"].as<double>() * degree;
  strip.soil.unit_weight = values["gamma"].as<double>();
  strip.surcharge = values["surcharge"].as<double>();
  strip.half_width = values["half-width"].as<double>();
  strip.rough = !values["smooth"].as<bool>();
  return strip;
}

std::optional<Box> box_of(const po::variables_map& values, const Strip& strip) {
  if (values.count("box-width") == 0 && values.count("box-depth") == 0) return std::nullopt;
  Box box = box_of(strip);
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

ExitCode run(std::span<const std::string> arguments, std::ostream& out, std::ostream& err) {
  const po::variables_map values = parse(arguments);
  if (values["help"].as<bool>()) {
    out << usage << '\n' << options() << '\n' << examples;
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    out << "fpm-limit " << wiring::version << '\n';
    return ExitCode::done;
  }
  if (!values["strip"].as<bool>()) throw UsageError("--strip is missing");
  const BracketOptions chosen = bracket_options(values);
  const Strip strip = strip_of(values);
  const Case problem = strip_case(strip, box_of(values, strip));
  std::optional<Case> reduced;
  if (values.count("psi") != 0) {
    const double psi = values["psi"].as<double>() * degree;
    if (!(psi >= 0.0) || psi > strip.soil.friction_angle) {
      throw UsageError(fmt::format("--psi: found {:g}; allowed is 0 .. phi", psi / degree));
    }
    if (psi < strip.soil.friction_angle) {
      Strip weaker = strip;
      weaker.soil = davis_reduced(strip.soil, psi);
      reduced = strip_case(weaker, box_of(values, strip));
      // Both in the same units, for one report.
      reduced->units = problem.units;
    }
  }
  const auto watch = [&](const Attempt& attempt) {
    if (values["verbose"].as<bool>()) err << attempt_line(attempt, problem.units.stress) << '\n';
  };
  Answer answer{bracket(problem, chosen, watch), std::nullopt};
  if (reduced) answer.davis = bracket(*reduced, chosen, watch);
  out << text_report(problem, answer, chosen);
  if (values.count("json") != 0) {
    wiring::write_text_durably(values["json"].as<std::string>(),
                               json_report(problem, answer, chosen));
  }
  return answer.bracket.reached ? ExitCode::done : ExitCode::not_converged;
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
  } catch (const wiring::FileError& failure) {
    err << "error: " << failure.what() << '\n';
    return ExitCode::checkpoint_unusable;
  } catch (const std::exception& failure) {
    err << "internal error: " << failure.what() << "\nThis is a bug: please report it.\n";
    return ExitCode::bug;
  }
}

}  // namespace limit
