#include "study/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace study {

namespace {

constexpr double share = 0.25;           // of the wish that steps, and the tolerance, may take each
constexpr std::size_t first_levels = 3;  // spacings without which nothing is known of an order
constexpr std::size_t more_levels = 4;   // and without which one that is not seen is not believed
constexpr double cautious = 3.0;         // times the range of values that do not settle

/// Whether the finest values say where they go.
bool settles(convergence::Course course) {
  return course == convergence::Course::still || course == convergence::Course::monotone;
}

double range_of(const std::vector<double>& values) {
  const auto [least, largest] = std::ranges::minmax(values);
  return largest - least;
}

class Climb {
 public:
  Climb(const Wish& wish, const Ask& ask) : wish_(wish), ask_(ask) {}

  Answer operator()() {
    // Of three levels the middle one is fine enough to behave as finer ones do.
    fineness_.level = 1;
    const bool known = settle_steps() && settle_tolerance() && settle_box() && look_at_control();
    if (known) descend();
    answer_.seconds = spent_;
    return answer_;
  }

 private:
  std::optional<double> value(const Fineness& fineness) {
    const auto reply = ask_({fineness}).front();
    if (!reply) {
      answer_.obstacle = "a run of the ladder has no such value";
      return std::nullopt;
    }
    note(fineness, *reply);
    return reply->value;
  }

  void note(const Fineness& fineness, const Reply& reply) {
    if (std::ranges::find(seen_, fineness) != seen_.end()) return;
    seen_.push_back(fineness);
    spent_ += reply.seconds;
    answer_.evaluations += reply.evaluations;
  }

  bool within_budget(double seconds) {
    if (!wish_.budget || spent_ + seconds <= *wish_.budget) return true;
    if (seconds == 0.0) {
      answer_.obstacle = fmt::format(
          "the budget of {:.3g} s was spent, {:.3g} s, before steps and tolerance were fine enough",
          *wish_.budget, spent_);
      return false;
    }
    answer_.obstacle = fmt::format(
        "the budget of {:.3g} s does not allow a finer run, which takes some {:.3g} s "
        "after {:.3g} s spent",
        *wish_.budget, seconds, spent_);
    return false;
  }

  /// Doubles the steps until what they leave is small: the error of implicit steps is of first
  /// order. Where the last three values do not settle, three of a course that goes astray may lie
  /// near each other: then all that the steps have changed so far counts.
  bool settle_steps() {
    constexpr double most = 64.0;
    std::vector<double> all;
    while (true) {
      Fineness twice = fineness_, four = fineness_;
      twice.steps *= 2.0;
      four.steps *= 4.0;
      const auto now = value(fineness_), finer = value(twice), finest = value(four);
      if (!now || !finer || !finest) return false;
      const convergence::Extrapolation found =
          convergence::extrapolate({{4.0, *now}, {2.0, *finer}, {1.0, *finest}}, 1.0);
      all.insert(all.end(), {*now, *finer, *finest});
      // It speaks of the finest of the three; this run's is farther by what lies between.
      Part part{"steps", found.uncertainty + std::abs(*now - *finest),
                fmt::format("{}, twice and four times as many", name_of(found.course))};
      if (!settles(found.course)) part.error = std::max(part.error, cautious * range_of(all));
      steps_ = {part, *now};
      if (part.error <= share * wish_.accuracy * std::abs(*now) || fineness_.steps >= most) {
        return true;
      }
      fineness_.steps *= 2.0;
      if (!within_budget(0.0)) return false;
    }
  }

  /// Tightens the tolerance until what it leaves is small.
  bool settle_tolerance() {
    constexpr double tighter = 0.1, least = 1e-5;
    while (true) {
      Fineness finer = fineness_;
      finer.tolerance *= tighter;
      const auto now = value(fineness_), then = value(finer);
      if (!now || !then) return false;
      // An error in proportion to the tolerance is 1 / (1 - 0.1) of the change; three times that
      // for one that is not quite.
      tolerance_ = {{"tolerance", 3.0 / (1.0 - tighter) * std::abs(*now - *then),
                     "three times what a tenth of it changes"},
                    *now};
      const bool good = tolerance_.part.error <= share * wish_.accuracy * std::abs(*now);
      if (good || fineness_.tolerance <= least) return true;
      fineness_.tolerance *= tighter;
      if (!within_budget(0.0)) return false;
    }
  }

  /// Widens the box until what lies beyond its far sides is small. What they do falls with their
  /// distance, with first order at least: that of a load in the plane does in its stresses.
  bool settle_box() {
    if (!wish_.box) return true;
    constexpr double wider = 1.5, most = 6.0;
    while (true) {
      Fineness once = fineness_, twice = fineness_;
      once.box *= wider;
      twice.box *= wider * wider;
      const auto now = value(fineness_), then = value(once), widest = value(twice);
      if (!now || !then || !widest) return false;
      const convergence::Extrapolation found =
          convergence::extrapolate({{wider * wider, *now}, {wider, *then}, {1.0, *widest}}, 1.0);
      const Part part{"box", found.uncertainty + std::abs(*now - *widest),
                      fmt::format("{}, far sides {}, {} and {} times as far", name_of(found.course),
                                  fineness_.box, once.box, twice.box)};
      box_ = {part, *now};
      const bool good = part.error <= share * wish_.accuracy * std::abs(*now);
      if (good || fineness_.box >= most) return true;
      fineness_.box *= wider;
      if (!within_budget(0.0)) return false;
    }
  }

  bool look_at_control() {
    Fineness half = fineness_;
    half.control = 0.5;
    const auto now = value(fineness_);
    if (!now) return false;
    const auto other = ask_({half}).front();
    if (!other) return true;  // a control without a stiffness
    note(half, *other);
    control_ = {{"control", 2.0 * std::abs(*now - other->value), "twice what half of it changes"},
                *now};
    return true;
  }

  /// Falling spacings until the wish is met.
  void descend() {
    std::vector<convergence::Sample> samples;
    double last_seconds = 0.0;
    for (std::size_t level = 0; level < wish_.spacings.size(); ++level) {
      Fineness fineness = fineness_;
      fineness.level = level;
      if (level >= first_levels) {
        const double ratio = wish_.spacings[level - 1] / wish_.spacings[level];
        if (!within_budget(last_seconds * std::pow(ratio, wish_.growth))) {
          if (answer_.bar <= wish_.accuracy * std::abs(answer_.value)) {
            answer_.obstacle +=
                "; the bar is as small as asked for, but of so few spacings that do "
                "not settle it is not believed";
          }
          return;
        }
      }
      const auto reply = ask_({fineness}).front();
      if (!reply) {
        answer_.obstacle =
            fmt::format("the run with spacing {} has no such value", wish_.spacings[level]);
        return;
      }
      note(fineness, *reply);
      last_seconds = reply->seconds;
      samples.push_back({wish_.spacings[level], reply->value});
      if (level + 1 < first_levels) continue;
      const bool settled = settles(judge(fineness, samples));
      answer_.reached = answer_.reached && (settled || samples.size() >= more_levels);
      if (answer_.reached) return;
    }
    answer_.obstacle = fmt::format("the finest spacing on offer is {}", wish_.spacings.back());
  }

  /// What the runs so far say of the last of them, and how they go.
  convergence::Course judge(const Fineness& fineness,
                            const std::vector<convergence::Sample>& samples) {
    constexpr std::size_t most = 4;  // coarser ones belong to another regime
    const auto from = samples.end() - static_cast<std::ptrdiff_t>(std::min(most, samples.size()));
    const convergence::Extrapolation found =
        convergence::extrapolate({from, samples.end()}, wish_.formal);
    answer_.fineness = fineness;
    answer_.value = samples.back().value;
    std::string words = std::string(name_of(found.course));
    if (found.order) words += fmt::format(", order {:.2f}", *found.order);
    answer_.parts = {{"spacing", found.uncertainty, words}, scaled(steps_), scaled(tolerance_)};
    if (box_) answer_.parts.push_back(scaled(*box_));
    answer_.bar = 0.0;
    for (const Part& part : answer_.parts) answer_.bar += part.error;
    if (control_) answer_.control = scaled(*control_);
    answer_.reached = answer_.bar <= wish_.accuracy * std::abs(answer_.value);
    return found.course;
  }

  /// A part known at the coarse level, of the answer's size.
  struct Known {
    Part part;
    double of = 1.0;  // the value there
  };
  [[nodiscard]] Part scaled(const Known& known) const {
    Part part = known.part;
    if (known.of != 0.0) part.error *= std::abs(answer_.value / known.of);
    return part;
  }

  const Wish& wish_;
  const Ask& ask_;
  Answer answer_;
  Fineness fineness_;
  Known steps_, tolerance_;
  std::optional<Known> control_, box_;
  std::vector<Fineness> seen_;
  double spent_ = 0.0;  // [s]
};

}  // namespace

Answer climb(const Wish& wish, const Ask& ask) {
  return Climb(wish, ask)();
}

}  // namespace study
