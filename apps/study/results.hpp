#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "campaign/campaign.hpp"
#include "convergence/convergence.hpp"
#include "study/grid.hpp"
#include "study/quantity.hpp"

namespace study {

/// What errors are taken against.
struct Reference {
  double value = 0.0;
  double uncertainty = 0.0;  // on both sides; an error below it says no more than that
  std::string words;         // where it comes from
};

/// One run of a study.
struct Result {
  Combination combination;
  std::string words;  // see words_for
  std::string digest;
  std::optional<int> exit_code;
  std::optional<double> value;
  std::string obstacle;         // why there is no value
  bool no_such_column = false;  // and no run of the scene has one
  std::optional<double> error;  // value - reference
  campaign::Cost cost;
  std::int64_t steps = 0;
  std::int64_t evaluations = 0;
  bool on_front = false;
};

/// The result of a run, read from its curve. One that did not converge has a value if it passed
/// what is asked for before, or if the failure itself is what is asked for.
[[nodiscard]] Result result_of(const campaign::Status& status, const Quantity& quantity);

/// The reference by Richardson's extrapolation along a key, the others at their last values.
/// @throws UsageError if fewer than two of these runs have a value.
[[nodiscard]] Reference richardson_reference(const std::vector<Vary>& varied, std::size_t key,
                                             const std::vector<Result>& results);

/// Gives each result its error and finds the front: the runs that none surpasses in both error and
/// processor time.
void judge(std::vector<Result>& results, const Reference& reference);

/// How the values go along one key, the others as they are.
struct Order {
  std::string key;
  std::string others;  // in words
  convergence::Extrapolation extrapolation;
  std::optional<convergence::Slope> slope;  // of the errors
};

/// The orders along every key of positive numbers, of each series with two values at least.
/// @param independent  whether the reference is none of these runs' own: else errors have no slope
[[nodiscard]] std::vector<Order> orders_of(const std::vector<Vary>& varied,
                                           const std::vector<Result>& results, bool independent);

}  // namespace study
