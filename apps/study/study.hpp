#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "program/exit_code.hpp"
#include "study/grid.hpp"
#include "study/quantity.hpp"

namespace study {

/// A study as asked for on the command line.
struct Request {
  std::filesystem::path scene_file;
  std::vector<std::string> settings;  // --set
  std::vector<Vary> varied;
  Quantity quantity;
  std::string reference = "richardson";
  std::filesystem::path folder;
  int jobs = 1;
  int threads = 1;
  bool quiet = false;
  std::filesystem::path programs;  // folder of fpm-run and fpm-limit
};

/// Makes the runs, judges them and writes study.csv, study.json and study.svg.
/// @throws UsageError for what cannot be asked for, FileError for files that cannot be used.
[[nodiscard]] program::ExitCode make_study(const Request& request, std::ostream& out,
                                           std::ostream& err);

}  // namespace study
