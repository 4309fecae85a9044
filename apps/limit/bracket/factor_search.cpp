#include "limit/bracket/factor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limit::bracket {

namespace {

// A factor changes by no more at once where the root is not enclosed.
const double farthest = std::log(3.0);

}  // namespace

void FactorSearch::saw(double factor, double multiplier, bool has_no_end) {
  if (!(multiplier > 0.0) || !(factor > 0.0)) return;
  const Seen now{std::log(factor), std::log(multiplier), has_no_end};
  for (const std::optional<Seen>& other : {carried_, failed_}) {
    if (!other || other->has_no_end || has_no_end || std::abs(now.x - other->x) < 1e-9) continue;
    // Less strength bears less: at least in proportion, but for the solver's digits.
    slope_ = std::min(-1.0, (now.y - other->y) / (now.x - other->x));
  }
  const double before = width();
  std::optional<Seen>& same = now.y >= 0.0 ? carried_ : failed_;
  std::optional<Seen>& other = now.y >= 0.0 ? failed_ : carried_;
  same = now;
  // Solvers have digits: what contradicts the last one goes.
  if (other && (now.y >= 0.0) == (now.x >= other->x)) other.reset();
  constexpr double hardly = 0.6;
  stalled_ = width() > hardly * before ? stalled_ + 1 : 0;
}

void FactorSearch::begin_anew(double shift) {
  first_ = root() * shift;
  carried_.reset();
  failed_.reset();
  stalled_ = 0;
}

double FactorSearch::root() const {
  if (carried_ && failed_) return enclosed_root();
  if (!carried_ && !failed_) return first_;
  const Seen& known = carried_ ? *carried_ : *failed_;
  const double step = known.has_no_end ? farthest : -known.y / slope_;
  return std::exp(known.x + std::clamp(step, -farthest, farthest));
}

double FactorSearch::root_towards(bool carried, double share) const {
  if (!carried_ || !failed_) return root();
  const double end = carried ? carried_->x : failed_->x;
  return std::exp((1.0 - share) * std::log(root()) + share * end);
}

double FactorSearch::width() const {
  if (!carried_ || !failed_) return std::numeric_limits<double>::infinity();
  return (failed_->x - carried_->x) / 2.0;
}

double FactorSearch::enclosed_root() const {
  double share = carried_->y / (carried_->y - failed_->y);
  // Between a multiplier of about one and one of next to nothing a secant says nothing.
  const double far = std::log(2.0);
  const bool is_far = carried_->has_no_end || carried_->y > far || failed_->y < -far;
  constexpr double least = 0.2;
  if (is_far) share = std::clamp(share, least, 1.0 - least);
  if (stalled_ > 1) share = 0.5;
  return std::exp(carried_->x + share * (failed_->x - carried_->x));
}

}  // namespace limit::bracket
