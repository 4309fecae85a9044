#include "forcing.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk::detail {

double ForcingSequence::next(double norm, double tolerance) {
  // Eisenstat & Walker 1996, choice 2: the safeguard holds while the former eta was not yet small.
  constexpr double safeguard_above = 0.1;
  double eta = rule_.initial;
  if (!first_ && rule_.rule == Forcing::Rule::eisenstat_walker2) {
    eta = rule_.gamma * std::pow(norm / previous_norm_, rule_.alpha);
    const double kept = rule_.gamma * std::pow(previous_eta_, rule_.alpha);
    if (kept > safeguard_above) eta = std::max(eta, kept);
  }
  first_ = false;
  previous_norm_ = norm;
  // The recurrence runs on eta before the end game, which would otherwise inflate later terms.
  eta = std::min(eta, rule_.maximum);
  previous_eta_ = eta;
  return std::min(std::max(eta, rule_.end_game * tolerance / norm), rule_.maximum);
}

}  // namespace jfnk::detail
