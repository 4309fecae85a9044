#include "limit/bracket/attempt.hpp"

#include <cmath>
#include <limits>

namespace limit::bracket {

namespace {

// Much more than what rounding does to sums of some thousand terms, much less than a bracket.
constexpr double rounding = 1e-10;

}  // namespace

double Bracket::lower_bound() const {
  const double bound = lower.value().certificate.multiplier;
  return bound - rounding * std::abs(bound);
}

double Bracket::upper_bound() const {
  const double bound = upper.value().certificate.multiplier;
  return bound + rounding * std::abs(bound);
}

double Bracket::gap() const {
  if (!lower || !upper) return std::numeric_limits<double>::infinity();
  const double mean = (lower_bound() + upper_bound()) / 2.0;
  return mean > 0.0 ? (upper_bound() - lower_bound()) / mean
                    : std::numeric_limits<double>::infinity();
}

}  // namespace limit::bracket
