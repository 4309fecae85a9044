#include "forcing.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk::detail {

double next_forcing(const Forcing& rule, ForcingState& state, double norm, double tolerance) {
  // Eisenstat & Walker 1996, choice 2: the safeguard holds while the former eta was not yet small.
  constexpr double safeguard_above = 0.1;
  double eta = rule.initial;
  if (!state.first && rule.rule != Forcing::Rule::constant) {
    eta = rule.gamma * std::pow(norm / state.previous_norm, rule.alpha);
    const double kept = rule.gamma * std::pow(state.previous_eta, rule.alpha);
    if (kept > safeguard_above) eta = std::max(eta, kept);
  }
  state.first = false;
  state.previous_norm = norm;
  // The recurrence runs on eta before the end game, which would otherwise inflate later terms.
  eta = std::min(eta, rule.maximum);
  state.previous_eta = eta;
  return std::min(std::max(eta, rule.end_game * tolerance / norm), rule.maximum);
}

}  // namespace jfnk::detail
