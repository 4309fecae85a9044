#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "convergence/convergence.hpp"
#include "study/fineness.hpp"

namespace study {

/// What a run says.
struct Reply {
  std::optional<double> value;
  double seconds = 0.0;  // of processor time
  std::int64_t evaluations = 0;
  double resolution = 0.0;   // how far the value may be off, since a failure is met in increments
  std::string obstacle{};    // why there is no value
  bool of_any_run = false;   // and no other run will have one
  bool out_of_time = false;  // it was stopped when its allowance was spent
};

/// Makes a run within an allowance of processor time [s]; each is made once, however often it is
/// asked for.
using Ask = std::function<Reply(const Fineness&, double allowance)>;

struct Wish {
  double accuracy = 0.02;        // of the value
  std::optional<double> budget;  // [s] of processor time in all
  std::vector<double> spacings;  // [m] on offer, falling
  double formal = 2.0;           // the order that a spacing's error can be trusted with
  double growth = 3.0;           // a run costs (coarse / fine)^growth times as much
  bool box = false;              // whether sides are far
  double unbalanced = 0.0;  // share of the value that a step may leave, at the scene's tolerance
};

/// One source of error and what it leaves.
struct Part {
  std::string source;
  double error = 0.0;  // in the value's unit, on both sides
  std::string words;   // how it is known
};

struct Answer {
  bool reached = false;
  Fineness fineness;  // of the run that is the answer
  double value = 0.0;
  double bar = 0.0;             // sum of the parts, on both sides
  std::vector<Part> parts;      // that add up to it
  std::optional<Part> control;  // of what the spacing leaves: what the control's stiffness decides
  double seconds = 0.0;         // spent
  std::int64_t evaluations = 0;
  std::string obstacle;  // why it was not reached
};

/// Climbs the ladder: first the steps and the tolerance are made fine enough, and the box wide
/// enough, by runs at a coarse spacing, each to a half of what is wished at most; then spacings
/// fall until the rest of it is not exceeded by what Richardson's safeguarded extrapolation leaves
/// of them. A budget is kept: no run begins that is not expected to fit into what is left of it,
/// four spacings' worth of it, or three or two where there is no room for more, are kept back while
/// the rest is looked at, and a run that takes longer all the same is stopped.
[[nodiscard]] Answer climb(const Wish& wish, const Ask& ask);

}  // namespace study
