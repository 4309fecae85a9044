#include "study/expense.hpp"

#include <algorithm>
#include <cmath>

namespace study {

bool Expense::note(const Fineness& fineness, double seconds) {
  if (knows(fineness)) return false;
  paid_.push_back({fineness, seconds});
  spent_ += seconds;
  return true;
}

bool Expense::knows(const Fineness& fineness) const {
  return std::ranges::find(paid_, fineness, &Paid::fineness) != paid_.end();
}

/// More steps take their number's ratio at most, since shorter ones are easier; a tenth of the
/// tolerance took up to twice the time on the problems of share/doc/trade.md.
double Expense::ratio(const Fineness& to, const Fineness& from) const {
  constexpr double of_a_tenth = 2.0;
  return std::pow(spacings_[from.level] / spacings_[to.level], growth_) * (to.steps / from.steps) *
         std::pow(of_a_tenth, std::log10(from.tolerance / to.tolerance)) *
         std::pow(to.box / from.box, growth_ - 1.0);
}

double Expense::expected(const Fineness& fineness) const {
  // A run of the same tolerance and steps tells more than one of the same spacing.
  constexpr double of_tolerance = 10.0, of_steps = 3.0;
  const auto far = [](double one, double other) { return std::abs(std::log(one / other)); };
  double best = 0.0, seconds = 0.0;
  for (const Paid& paid : paid_) {
    const double distance = of_tolerance * far(paid.fineness.tolerance, fineness.tolerance) +
                            of_steps * far(paid.fineness.steps, fineness.steps) +
                            far(paid.fineness.box, fineness.box) +
                            far(spacings_[paid.fineness.level], spacings_[fineness.level]);
    if (paid.seconds == 0.0) continue;  // it was refused
    if (seconds > 0.0 && distance > best) continue;
    best = distance;
    seconds = paid.seconds * ratio(fineness, paid.fineness);
  }
  return seconds;
}

}  // namespace study
