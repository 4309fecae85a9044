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
  double best = 0.0, seconds = 0.0;
  for (const Paid& paid : paid_) {
    const double times = ratio(fineness, paid.fineness);
    const double distance = std::abs(std::log(times));
    if (seconds > 0.0 && distance > best) continue;
    best = distance;
    seconds = paid.seconds * times;
  }
  return seconds;
}

}  // namespace study
