// fpm-study: runs of one scene over all combinations of some keys, their errors and what they cost.

#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <iostream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "program/child_process.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"
#include "study/accuracy.hpp"
#include "study/quality.hpp"
#include "study/study.hpp"

namespace {

namespace po = boost::program_options;
using program::ExitCode;
using program::texts;
using program::UsageError;
using Texts = std::vector<std::string>;

constexpr std::string_view usage =
    "Usage: fpm-study SCENE --vary KEY=V1,V2,... --quantity QUANTITY [options]\n"
    "       fpm-study SCENE --accuracy 2% [--budget 10min] [--quantity QUANTITY] [options]\n"
    "       fpm-study SCENE --quality draft|normal|fine [options]\n"
    "\n"
    "Runs a scene of fpm-run with every combination of the values of some keys, and says how far\n"
    "each is from a reference and what it cost: a table, study.csv, study.json, and study.svg,\n"
    "error over processor time with the front of those runs that none surpasses in both. What is\n"
    "finished is kept in the output folder and never run again, what was interrupted or killed\n"
    "goes on.\n"
    "\n"
    "With --accuracy, as fpm-run has it, a ladder of cheap runs of the scene finds the coarsest\n"
    "setting whose quantity is that accurate, and says the answer with its error bar and its "
    "parts:\n"
    "spacing, steps, tolerance, and with --far the box. --quality takes a setting without "
    "asking.\n";

constexpr std::string_view notes =
    "QUANTITY is one of\n"
    "  COLUMN               its last value in the curve, as mean_pressure_Pa; the unit may be "
    "left\n"
    "                       out, pressure is the mean one, d/B is settlement_over_B\n"
    "  max(COLUMN)          its largest\n"
    "  COLUMN@COLUMN=VALUE  interpolated where the other first comes to a value\n"
    "  FIELD@X,Y[,Z]        at the end, at a point [m] of the initial body: displacement_x,\n"
    "                       stress_xx and so on (that of the nearest particle), plastic_strain\n"
    "\n"
    "The last value of each --vary counts as its finest. Orders are of the keys whose values are\n"
    "all positive numbers: value = limit + a KEY^order, by least squares; safeguarded as the grid\n"
    "convergence index is, they say how far the finest value may be from the limit.\n"
    "\n"
    "Examples:\n"
    "  fpm-study share/scenes/beam.toml --vary geometry.spacing=0.25,0.125,0.0625 \\\n"
    "    --quantity displacement_y@5,0.5 --reference -0.024062794\n"
    "  fpm-study share/scenes/prandtl_phi0.toml --vary geometry.spacing=0.25,0.125,0.0625 \\\n"
    "    --vary solver.tolerance=1e-2,1e-3 --quantity pressure --reference limit\n"
    "  fpm-study share/scenes/footing.toml --vary geometry.spacing=0.0275,0.022,0.01375 \\\n"
    "    --quantity pressure@d/B=0.05\n"
    "\n"
    "Exit codes: 0 done, 1 internal error, 2 input refused, 3 some runs have no such value,\n"
    "4 file unusable, 75 interrupted; the same command goes on.\n";

po::options_description options() {
  po::options_description all("Options");
  all.add_options()  //
      ("vary", po::value<Texts>()->value_name("KEY=V1,V2,...")->composing(),
       "values of a key of the scene, coarsest first; may be repeated, all combinations are run")  //
      ("quantity", po::value<std::string>()->value_name("QUANTITY"), "what runs are judged by")  //
      ("reference", po::value<std::string>()->value_name("REF")->default_value("richardson"),
       "what errors are taken against: a number, a CSV file that has the quantity's columns, "
       "richardson (extrapolated along the first key of numbers, or along KEY by "
       "richardson:KEY), or limit (the bracket of fpm-limit)")  //
      ("accuracy", po::value<std::string>()->value_name("PART"),
       "how far the quantity may be off, as 2% or 0.02; without --quantity it is the mean "
       "pressure, "
       "the reaction or the largest displacement")  //
      ("budget", po::value<std::string>()->value_name("TIME"),
       "of --accuracy: processor time of the ladder, as 10min, 5h, 90s; default: none")  //
      ("far", po::value<std::string>()->value_name("SIDES"),
       "of --accuracy: sides, as left,bottom, that are only where the ground that is looked at "
       "ends; "
       "they are moved away to see what they do")  //
      ("quality", po::value<std::string>()->value_name("WORD"),
       "draft, normal or fine: coarser, as, or finer than the scene says (share/doc/trade.md)")  //
      ("only-say", po::bool_switch(),
       "with --accuracy and --quality: no run in the output folder in the end")  //
      ("set", po::value<Texts>()->value_name("KEY=VALUE")->composing(),
       "override a key of the scene in all runs; may be repeated")  //
      ("out", po::value<std::string>()->value_name("DIR"),
       "output folder; default: out/ and the scene's name and -study")  //
      ("jobs", po::value<int>()->value_name("N"),
       "runs at a time, fewer if memory is short; default: the processors over --threads")     //
      ("threads", po::value<int>()->value_name("N")->default_value(1), "threads of each run")  //
      ("quiet", po::bool_switch(), "no progress; the table only")                              //
      ("version", po::bool_switch(), "print the version")                                      //
      ("help", po::bool_switch(), "print this help");
  return all;
}

int count_of(const po::variables_map& values, const char* name, int otherwise) {
  if (values.count(name) == 0) return otherwise;
  const int count = values[name].as<int>();
  constexpr int most = 4096;
  if (count < 1 || count > most) {
    throw UsageError(
        fmt::format("--{}: found {}; allowed is a whole number 1 .. {}", name, count, most));
  }
  return count;
}

std::vector<study::Vary> varied_of(const po::variables_map& values) {
  std::vector<study::Vary> varied;
  std::set<std::string> keys;
  std::size_t runs = 1;
  for (const std::string& text : texts(values, "vary")) {
    const study::Vary& vary = varied.emplace_back(study::parse_vary(text));
    if (!keys.insert(vary.key).second) {
      throw UsageError(fmt::format("--vary {}: the key is varied already", vary.key));
    }
    runs *= vary.values.size();
    constexpr std::size_t most_runs = 10000;
    if (runs > most_runs) {
      throw UsageError(fmt::format("--vary: more than {} combinations", most_runs));
    }
  }
  if (varied.empty()) throw UsageError("--vary KEY=V1,V2,... is missing");
  return varied;
}

study::Request request_of(const po::variables_map& values) {
  const Texts scenes = texts(values, "scene");
  if (scenes.empty()) throw UsageError("SCENE is missing");
  if (scenes.size() > 1) throw UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  study::Request request;
  request.scene_file = scenes.front();
  request.settings = texts(values, "set");
  request.varied = varied_of(values);
  if (values.count("quantity") == 0) throw UsageError("--quantity QUANTITY is missing");
  request.quantity = study::parse_quantity(values["quantity"].as<std::string>());
  request.reference = values["reference"].as<std::string>();
  request.threads = count_of(values, "threads", 1);
  const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  request.jobs = count_of(values, "jobs", std::max(1, processors / request.threads));
  request.quiet = values["quiet"].as<bool>();
  request.folder = values.count("out") != 0 ? std::filesystem::path(values["out"].as<std::string>())
                                            : std::filesystem::path("out") /
                                                  (request.scene_file.stem().string() + "-study");
  request.programs = program::folder_of_this_program();
  return request;
}

study::AccuracyRequest accuracy_of(const po::variables_map& values) {
  const Texts scenes = texts(values, "scene");
  if (scenes.empty()) throw UsageError("SCENE is missing");
  if (scenes.size() > 1) throw UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  if (values.count("vary") != 0) throw UsageError("--vary: --accuracy says itself what it varies");
  study::AccuracyRequest request;
  request.scene_file = scenes.front();
  request.settings = texts(values, "set");
  request.accuracy = study::parse_accuracy(values["accuracy"].as<std::string>());
  if (values.count("budget") != 0) {
    request.budget = study::parse_budget(values["budget"].as<std::string>());
  }
  if (values.count("quantity") != 0) {
    request.quantity = study::parse_quantity(values["quantity"].as<std::string>());
  }
  if (values.count("out") != 0) request.folder = values["out"].as<std::string>();
  if (values.count("far") != 0) request.far = values["far"].as<std::string>();
  request.threads = count_of(values, "threads", 1);
  request.jobs = count_of(values, "jobs", 1);
  request.quiet = values["quiet"].as<bool>();
  request.only_say = values["only-say"].as<bool>();
  request.programs = program::folder_of_this_program();
  return request;
}

ExitCode take_quality(const po::variables_map& values) {
  const Texts scenes = texts(values, "scene");
  if (scenes.empty()) throw UsageError("SCENE is missing");
  if (scenes.size() > 1) throw UsageError(fmt::format("{}: one SCENE at a time", scenes[1]));
  for (const char* other : {"vary", "accuracy", "budget", "quantity", "far"}) {
    if (values.count(other) != 0) throw UsageError(fmt::format("--{}: not with --quality", other));
  }
  study::FinalRun run;
  run.scene_file = scenes.front();
  run.settings = texts(values, "set");
  if (values.count("out") != 0) run.folder = values["out"].as<std::string>();
  run.threads = count_of(values, "threads", 1);
  run.quiet = values["quiet"].as<bool>();
  run.programs = program::folder_of_this_program();
  return study::run_quality(std::move(run),
                            study::parse_quality(values["quality"].as<std::string>()),
                            values["only-say"].as<bool>(), std::cout, std::cerr);
}

ExitCode run(const Texts& arguments) {
  const po::variables_map values = program::parse(arguments, options(), "scene");
  if (values["help"].as<bool>()) {
    std::cout << usage << '\n' << options() << '\n' << notes;
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    std::cout << "fpm-study " << program::version << '\n';
    return ExitCode::done;
  }
  if (values.count("quality") != 0) return take_quality(values);
  if (values.count("accuracy") != 0) {
    return study::find_accuracy(accuracy_of(values), std::cout, std::cerr);
  }
  return study::make_study(request_of(values), std::cout, std::cerr);
}

}  // namespace

int main(int count, char** words) {
  const Texts arguments(words + 1, words + count);
  return program::to_int(
      program::run_program("fpm-study", std::cerr, [&] { return run(arguments); }));
}
