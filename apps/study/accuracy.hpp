#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "program/exit_code.hpp"
#include "study/quantity.hpp"

namespace scene {
struct Scene;
}

namespace study {

/// A wish for an accuracy as the command line has it.
struct AccuracyRequest {
  std::filesystem::path scene_file;
  std::vector<std::string> settings;  // --set
  double accuracy = 0.02;             // of the quantity
  std::optional<double> budget;       // [s] of processor time
  std::optional<Quantity> quantity;   // absent: see quantity_of
  std::string far;                    // sides that are only where the ground ends; see parse_far
  std::filesystem::path folder;       // of the output; empty: the scene's own, as fpm-run has it
  int jobs = 1;
  int threads = 1;
  bool quiet = false;
  bool only_say = false;           // the ladder only, no run in the output folder
  std::filesystem::path programs;  // folder of fpm-run
};

/// A part or a percentage: 0.02, 2%.
/// @throws UsageError unless it is in (0, 1).
[[nodiscard]] double parse_accuracy(const std::string& text);

/// A time such as 10min, 5h, 30m, 90s, 1h30m [s].
/// @throws UsageError if it is none.
[[nodiscard]] double parse_budget(const std::string& text);

/// What a scene is run for: the mean pressure of a footing, the reaction of another displacement,
/// what strength is divided by when it no longer bears, the largest displacement of a load.
/// @throws UsageError if the scene measures something else: then the user must say, and is told
/// what there is.
[[nodiscard]] Quantity quantity_of(const scene::Scene& scene);

/// The order with which a spacing's error can be trusted to fall: displacements of what is elastic
/// converge with second order, but the load of a plate on what yields only with first, however fast
/// it seems to come down to it at first, since its edge is known to half a spacing; and so does
/// whatever hangs on a support at a point between particles. What yields without such an edge is in
/// between, for the kinks where yielding begins. A plastic strain is that of a particle up to
/// half a spacing off its point, and a stress is extrapolated up to a face.
[[nodiscard]] double formal_order(const scene::Scene& scene, const Quantity& quantity);

/// Finds the cheapest setting that meets the wish, says the answer with its error bar and the parts
/// of it, writes accuracy.json, and becomes the run of that setting in the output folder.
/// @throws UsageError for what cannot be asked for, FileError for files that cannot be used.
[[nodiscard]] program::ExitCode find_accuracy(const AccuracyRequest& request, std::ostream& out,
                                              std::ostream& err);

}  // namespace study
