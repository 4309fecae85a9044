#pragma once

#include <functional>
#include <string>
#include <vector>

#include "small_footing.hpp"

namespace extremes {

/// One value on an axis, and the scene that has it.
struct Sample {
  std::string value;
  std::string scene;
  /// Within what the axis is said to hold: it must be right there. Beyond, it is right or refused.
  bool is_held = true;
};

/// A run whose answer is known, taken to the edges of one of its parameters.
struct Axis {
  std::string name;
  std::string problem;  // and what its answer is compared with
  /// Largest error that a right answer has, over the answer, and where that is from.
  double tolerance = 0.0;
  std::string source;
  std::vector<Sample> samples = {};
  /// The error of a finished run of a sample.
  std::function<double(PlaneRun& run, std::size_t sample)> error = {};
  /// Makes the run itself and returns its error, where it is not one step after the other to the
  /// end of the scene. What it throws is the reason why there is none.
  std::function<double(const verification::TestScene& scene, std::size_t sample)> course = {};
};

/// Runs all samples. One that is wrong, or held and not right, fails the test. Adds a row to the
/// table of share/doc/extremes.md where the environment names a file (EXTREMES_WRITE).
void sweep(const Axis& axis);

}  // namespace extremes
