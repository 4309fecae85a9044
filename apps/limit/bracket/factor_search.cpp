#include "limit/bracket/factor_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limit::bracket {

namespace {

// A factor changes by no more at once where the root is not enclosed; so close is the next mesh's
// root; and so much further, to that power, each look goes than the last one.
constexpr double farthest = 3.0, next_mesh = 1.03, further = 3.0;

}  // namespace

void FactorSearch::saw(double factor, double multiplier, bool has_no_end) {
  if (!(multiplier > 0.0) || !(factor > 0.0)) return;
  const Seen now{factor, 1.0 / multiplier, has_no_end};
  learn_slope(now);
  const bool is_carried = now.inverse <= 1.0;
  std::optional<Seen>& same = is_carried ? carried_ : failed_;
  std::optional<Seen>& other = is_carried ? failed_ : carried_;
  if (same && !other) reach_ = std::min(farthest, std::pow(reach_, further));
  again_ = same && other && is_carried == was_carried_ ? again_ + 1 : 0;
  was_carried_ = is_carried;
  same = now;
  // Solvers have digits: what contradicts the last one goes.
  if (other && is_carried == (factor >= other->factor)) other.reset();
}

void FactorSearch::learn_slope(const Seen& now) {
  for (const std::optional<Seen>& other : {carried_, failed_}) {
    if (!other || other->has_no_end || now.has_no_end) continue;
    const double step = now.factor - other->factor;
    if (std::abs(step) < 1e-9 * now.factor) continue;
    const double rise = (now.inverse - other->inverse) / step;
    // Less strength bears less: at least in proportion, but for the solver's digits.
    constexpr double most = 0.999;
    without_end_ =
        rise > 0.0 ? std::clamp(1.0 - now.inverse / (rise * now.factor), 0.0, most) : 0.0;
  }
}

void FactorSearch::begin_anew(double shift) {
  first_ = root() * shift;
  // Where nothing but a multiplier without end was seen, the root may be as far as before.
  if (failed_ || !carried_ || !carried_->has_no_end) reach_ = next_mesh;
  carried_.reset();
  failed_.reset();
  again_ = 0;
}

double FactorSearch::root() const {
  if (carried_ && failed_) return enclosed_root();
  if (!carried_ && !failed_) return first_;
  const Seen& known = carried_ ? *carried_ : *failed_;
  const double step =
      known.has_no_end ? reach_ : without_end_ + (1.0 - without_end_) / known.inverse;
  return known.factor * std::clamp(step, 1.0 / reach_, reach_);
}

double FactorSearch::root_towards(bool carried, double share) const {
  if (!carried_ || !failed_) return root();
  const double end = carried ? carried_->factor : failed_->factor;
  return std::pow(root(), 1.0 - share) * std::pow(end, share);
}

double FactorSearch::width() const {
  if (!carried_ || !failed_) return std::numeric_limits<double>::infinity();
  return std::log(failed_->factor / carried_->factor) / 2.0;
}

double FactorSearch::enclosed_root() const {
  double above = failed_->inverse - 1.0, below = 1.0 - carried_->inverse;
  // An end that stays where it is counts for less each time (the Illinois rule).
  (was_carried_ ? above : below) *= std::pow(0.5, again_);
  double share = below / (above + below);
  // Where the multiplier has no end at one end, or is next to nothing at the other, a secant says
  // little.
  constexpr double next_to_nothing = 5.0, least = 0.2;
  const bool is_far = carried_->has_no_end || failed_->inverse > next_to_nothing;
  // Two mechanisms, and with the second one the multiplier falls off: where, is for neither end to
  // say.
  if (again_ > 1) return std::sqrt(carried_->factor * failed_->factor);
  if (is_far) share = std::clamp(share, least, 1.0 - least);
  return carried_->factor + share * (failed_->factor - carried_->factor);
}

}  // namespace limit::bracket
