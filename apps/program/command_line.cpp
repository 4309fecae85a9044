#include "program/command_line.hpp"

#include <fmt/format.h>

#include <new>

#include "files/file_error.hpp"
#include "tables/nearest_name.hpp"

namespace program {

namespace po = boost::program_options;

namespace {

/// The name of the option that is nearest to an unknown one, as a question; "" if none is near.
std::string suggestion(const std::string& unknown, const po::options_description& all) {
  std::vector<std::string> names;
  for (const auto& option : all.options()) names.push_back("--" + option->long_name());
  const std::string nearest = tables::nearest_name(unknown, {names.begin(), names.end()});
  return nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?";
}

}  // namespace

po::variables_map parse(std::span<const std::string> arguments, const po::options_description& all,
                        const char* positional) {
  po::options_description with_words;
  with_words.add(all).add_options()(positional, po::value<std::vector<std::string>>());
  po::positional_options_description words;
  words.add(positional, -1);
  const int strict = po::command_line_style::unix_style & ~po::command_line_style::allow_guessing;
  po::variables_map values;
  try {
    const std::vector<std::string> copied(arguments.begin(), arguments.end());
    po::store(
        po::command_line_parser(copied).options(with_words).positional(words).style(strict).run(),
        values);
  } catch (const po::unknown_option& unknown) {
    const std::string name = unknown.get_option_name();
    throw UsageError(fmt::format("{}: no such option{}", name, suggestion(name, all)));
  } catch (const po::error& failure) {
    throw UsageError(failure.what());
  }
  return values;
}

std::vector<std::string> texts(const po::variables_map& values, const char* name) {
  if (values.count(name) == 0) return {};
  return values[name].as<std::vector<std::string>>();
}

ExitCode run_program(std::string_view name, std::ostream& err,
                     const std::function<ExitCode()>& run) {
  try {
    return run();
  } catch (const UsageError& failure) {
    err << "error: " << failure.what() << "\nTry " << name << " --help.\n";
    return ExitCode::input_refused;
  } catch (const files::FileError& failure) {
    err << "error: " << failure.what() << '\n';
    return ExitCode::checkpoint_unusable;
  } catch (const std::bad_alloc&) {
    err << "error: out of memory\n";
    return ExitCode::bug;
  } catch (const std::exception& failure) {
    err << "internal error: " << failure.what() << "\nThis is a bug: please report it.\n";
    return ExitCode::bug;
  }
}

}  // namespace program
