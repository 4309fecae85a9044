// fpm-compare: the largest difference per field of two checkpoints, frames, curves or runs.

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <charconv>
#include <cmath>
#include <iostream>

#include "compare/difference.hpp"
#include "compare/report.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"

namespace {

namespace po = boost::program_options;
using namespace comparison;
using program::ExitCode;
using program::texts;
using program::UsageError;
using Texts = std::vector<std::string>;

constexpr std::string_view usage =
    "Usage: fpm-compare A B [options]\n"
    "\n"
    "Prints the largest difference per field of two checkpoints, frames (*.hdf), curves (*.csv) "
    "or\n"
    "output folders (their newest usable checkpoints, with the curve so far). Without a tolerance\n"
    "fields must be identical bit by bit; wall times are never compared, and with a tolerance the\n"
    "secant pairs of the solver are not, unless --only names them.\n";

constexpr std::string_view notes =
    "PATTERN is a field's name or its last part, with * and ? as in a shell. A difference passes "
    "if\n"
    "it is at most the absolute tolerance plus the relative one times the field's largest\n"
    "magnitude; of several for a field the last counts.\n"
    "\n"
    "Examples:\n"
    "  fpm-compare out/a out/b\n"
    "  fpm-compare a/curve.csv b/curve.csv --relative 1e-6 --ignore '*evaluations'\n"
    "  fpm-compare a.hdf b.hdf --only stress --absolute stress=1.0\n"
    "\n"
    "Exit codes: 0 all pass, 1 internal error, 2 wrong use, 3 different, 4 a file is unusable.\n";

po::options_description options() {
  po::options_description all("Options");
  all.add_options()  //
      ("relative", po::value<Texts>()->value_name("[PATTERN=]X")->composing(),
       "let differences up to X times the field's largest magnitude pass; may be repeated")  //
      ("absolute", po::value<Texts>()->value_name("[PATTERN=]X")->composing(),
       "let differences up to X, in the field's unit, pass; may be repeated")  //
      ("only", po::value<Texts>()->value_name("PATTERN")->composing(),
       "compare these fields only; may be repeated")  //
      ("ignore", po::value<Texts>()->value_name("PATTERN")->composing(),
       "do not compare these fields; may be repeated")                      //
      ("quiet", po::bool_switch(), "print nothing; the exit code says it")  //
      ("version", po::bool_switch(), "print the version")                   //
      ("help", po::bool_switch(), "print this help");
  return all;
}

std::vector<Tolerance> tolerances(const po::variables_map& values, const char* name) {
  std::vector<Tolerance> all;
  for (const std::string& text : texts(values, name)) {
    const std::size_t equals = text.rfind('=');
    Tolerance tolerance;
    if (equals != std::string::npos) tolerance.pattern = text.substr(0, equals);
    const std::string number = equals == std::string::npos ? text : text.substr(equals + 1);
    const char* end = number.data() + number.size();
    const auto [stop, failure] = std::from_chars(number.data(), end, tolerance.value);
    const bool sound = failure == std::errc{} && stop == end && std::isfinite(tolerance.value) &&
                       tolerance.value >= 0.0 && !tolerance.pattern.empty();
    if (!sound) {
      throw UsageError(
          fmt::format("--{}: found {}; allowed is a number >= 0, or PATTERN=number", name, text));
    }
    all.push_back(tolerance);
  }
  return all;
}

ExitCode compare(const po::variables_map& values) {
  const Texts files = texts(values, "file");
  if (files.size() != 2)
    throw UsageError(fmt::format("{} files given; two are compared", files.size()));
  const Request request{tolerances(values, "absolute"), tolerances(values, "relative"),
                        texts(values, "only"), texts(values, "ignore")};
  const Source a = open_source(files[0]), b = open_source(files[1]);
  const std::vector<Difference> all = differences(a, b, request);
  if (all.empty()) throw UsageError("there is no such field; without --only all are shown");
  if (!values["quiet"].as<bool>()) {
    std::cout << fmt::format("A: {}: {}\nB: {}: {}\n", files[0], a.what, files[1], b.what)
              << comparison_report(a, all);
  }
  for (const Difference& difference : all) {
    if (!difference.passes) return ExitCode::not_converged;
  }
  return ExitCode::done;
}

ExitCode run(const Texts& arguments) {
  const po::variables_map values = program::parse(arguments, options(), "file");
  if (values["help"].as<bool>()) {
    std::cout << usage << '\n' << options() << '\n' << notes;
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    std::cout << "fpm-compare " << program::version << '\n';
    return ExitCode::done;
  }
  return compare(values);
}

}  // namespace

int main(int count, char** words) {
  const Texts arguments(words + 1, words + count);
  return program::to_int(
      program::run_program("fpm-compare", std::cerr, [&] { return run(arguments); }));
}
