#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "files/system_calls.hpp"
#include "program/exit_code.hpp"
#include "support/temporary_folder.hpp"

namespace restart {

/// What a call of fpm-run came to.
struct Outcome {
  program::ExitCode code = program::ExitCode::bug;
  std::string out;
  std::string err;
};

/// A plane footing, a quarter of a second long, whose few particles shear enough for re-search.
extern const std::string footing;
/// The same on two soils.
extern const std::string layered;
/// The footing whole, under a load that does not act at its middle.
extern const std::string loaded_plate;
/// A plane slope over a tunnel, cut out of a box, whose weight grows.
extern const std::string tunnel;
/// A strip on a slope of two graded layers that was settled, pressed into it with re-search.
extern const std::string layered_slope;
/// A strip pressed into triangles of a mesh, with re-search.
extern const std::string triangles;
/// A block of tetrahedra of a mesh whose weight grows.
extern const std::string tetrahedra;
/// The footing pressed down, drawn back and pressed on.
extern const std::string staged;
/// The loaded plate, its load taken back in between.
extern const std::string staged_load;
/// A 3D elastic block whose weight grows.
extern const std::string block;

/// The program fpm-run with a scene that is written beside the output folder.
Outcome fpm_run_in(const std::filesystem::path& folder, const std::string& scene,
                   const std::vector<std::string>& arguments = {},
                   const files::SystemCalls& system = files::system_calls());

/// The checkpoint of the largest step in an output folder.
std::filesystem::path last_checkpoint(const std::filesystem::path& folder);
/// The checkpoint of one step in an output folder.
std::filesystem::path checkpoint_of(const std::filesystem::path& folder, int step);

/// Every dataset below /state whose bits differ between two checkpoints, or that one of them lacks.
std::vector<std::string> differing_fields(const std::filesystem::path& a,
                                          const std::filesystem::path& b);

/// The lines of a curve file without their last column, the wall time.
std::vector<std::string> curve_without_wall(const std::filesystem::path& folder);

/// Sum of a named column of a curve over the steps after `step`.
double column_sum_after(const std::filesystem::path& folder, const std::string& column, int step);

/// Content of a whole file.
std::string bytes_of_file(const std::filesystem::path& file);

}  // namespace restart
