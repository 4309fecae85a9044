// fpm-material: element tests of a material of libconstitutive.

#include <fmt/format.h>

#include <boost/program_options.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "files/durable_file.hpp"
#include "material/element_test.hpp"
#include "material/error_map.hpp"
#include "material/path.hpp"
#include "material/report.hpp"
#include "program/command_line.hpp"
#include "program/version.hpp"

namespace {

namespace po = boost::program_options;
using program::ExitCode;
using program::texts;
using program::UsageError;

constexpr std::string_view usage =
    "Usage: fpm-material PATH [options]\n"
    "       fpm-material --error-maps DIR\n"
    "\n"
    "Takes one point of a material along a path of strains and stresses, stage by stage: triaxial\n"
    "compression and extension, plane strain, oedometer, simple shear, isotropic, or any mix of\n"
    "prescribed strains and stresses. Writes path.csv, path.svg (deviatoric stress) and\n"
    "path-volume.svg, and holds the consistent tangent of every step against differences.\n";

constexpr std::string_view notes =
    "Examples:\n"
    "  fpm-material share/paths/triaxial.toml\n"
    "  fpm-material share/paths/triaxial.toml --set material.model=drucker_prager \\\n"
    "    --set material.match=compression_cone\n"
    "\n"
    "Exit codes: 0 done, 1 internal error, 2 input refused, 3 the material cannot follow the path\n"
    "(what it could is written), 4 file unusable.\n";

po::options_description options() {
  po::options_description all("Options");
  all.add_options()  //
      ("set", po::value<std::vector<std::string>>()->value_name("KEY=VALUE")->composing(),
       "override a key of the path, as material.cohesion=5e3; may be repeated")  //
      ("out", po::value<std::string>()->value_name("DIR"),
       "output folder; default: out/ and the path's name")  //
      ("error-maps", po::value<std::string>()->value_name("DIR"),
       "maps of the error of one step of every surface, as pictures and CSV; prints a table of "
       "them")("path-reference", po::bool_switch(), "print the reference of all keys")  //
      ("version", po::bool_switch(), "print the version")                               //
      ("help", po::bool_switch(), "print this help");
  return all;
}

ExitCode follow(const std::filesystem::path& file, const po::variables_map& values) {
  const material::PathReading reading =
      material::read_path(files::read_text(file), file.string(), texts(values, "set"));
  for (const tables::Complaint& complaint : reading.errors) {
    std::cerr << "error: " << complaint.text() << '\n';
  }
  if (!reading.path) return ExitCode::input_refused;
  const constitutive::Material made =
      constitutive::make_material(material::parameters_of(*reading.path));
  const material::Course course = material::follow(made, *reading.path);
  const std::filesystem::path folder = values.count("out") != 0
                                           ? std::filesystem::path(values["out"].as<std::string>())
                                           : std::filesystem::path("out") / file.stem();
  files::create_folder(folder);
  files::write_text_durably(folder / "path.csv", material::csv_text(course));
  files::write_text_durably(folder / "path.svg", material::shear_picture(*reading.path, course));
  files::write_text_durably(folder / "path-volume.svg",
                            material::volume_picture(*reading.path, course));
  std::cout << material::summary(*reading.path, course)
            << fmt::format("  written: {}, path.svg, path-volume.svg\n",
                           (folder / "path.csv").string());
  if (course.obstacle.empty()) return ExitCode::done;
  std::cerr << "error: " << file.string() << ": " << course.obstacle << '\n';
  return ExitCode::not_converged;
}

ExitCode draw_error_maps(const std::filesystem::path& folder) {
  files::create_folder(folder);
  std::vector<material::ErrorMap> maps;
  for (const material::ErrorMapCase& one : material::error_map_cases()) {
    maps.push_back(material::error_map(one));
    const std::string name = "error-map-" + one.name;
    files::write_text_durably(folder / (name + ".csv"), material::csv_text(maps.back()));
    files::write_text_durably(folder / (name + ".svg"), material::map_picture(maps.back()));
  }
  std::cout << material::table_of(maps);
  return ExitCode::done;
}

ExitCode run(const std::vector<std::string>& arguments) {
  const po::variables_map values = program::parse(arguments, options(), "path");
  if (values["help"].as<bool>()) {
    std::cout << usage << '\n' << options() << '\n' << notes;
    return ExitCode::done;
  }
  if (values["version"].as<bool>()) {
    std::cout << "fpm-material " << program::version << '\n';
    return ExitCode::done;
  }
  if (values["path-reference"].as<bool>()) {
    std::cout << material::path_reference();
    return ExitCode::done;
  }
  const std::vector<std::string> paths = texts(values, "path");
  if (values.count("error-maps") != 0) {
    if (!paths.empty()) throw UsageError("--error-maps takes no PATH");
    return draw_error_maps(values["error-maps"].as<std::string>());
  }
  if (paths.empty()) throw UsageError("PATH is missing");
  if (paths.size() > 1) throw UsageError(fmt::format("{}: one PATH at a time", paths[1]));
  return follow(paths.front(), values);
}

}  // namespace

int main(int count, char** words) {
  const std::vector<std::string> arguments(words + 1, words + count);
  return program::to_int(
      program::run_program("fpm-material", std::cerr, [&] { return run(arguments); }));
}
