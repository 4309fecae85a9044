#include "study/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/expense.hpp"

namespace study {

namespace {

constexpr double share = 0.25;           // of the wish that steps, and the tolerance, may take each
constexpr double most_share = 0.5;       // and steps where less takes many more of them
constexpr double tenth = 0.1;            // by which a tolerance is tightened
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

/// One way in which runs become finer, spacing apart.
struct Refinement {
  std::string source;
  double Fineness::*member;
  double ratio;  // from one run to the next
  double most;   // of it: the coarsest of three
  const char* words;
  const char* needed;  // for a bar that is narrower
};

class Climb {
 public:
  Climb(const Wish& wish, const Ask& ask)
      : wish_(wish), ask_(ask), expense_(wish.spacings, wish.growth) {}

  Answer operator()() {
    const bool known =
        find_first() &&
        settle({"steps", &Fineness::steps, 2.0, 64.0, "times as many", "more steps"}, steps_) &&
        settle_tolerance() && settle_box();
    if (known) {
      look_at_control();
      descend();
    }
    answer_.seconds = expense_.spent();
    return answer_;
  }

 private:
  /// A part known at the coarse level, of the answer's size.
  struct Known {
    Part part;
    double of = 1.0;  // the value there
  };
  using Samples = std::vector<convergence::Sample>;

  [[nodiscard]] double left() const {
    return wish_.budget ? *wish_.budget - expense_.spent() : std::numeric_limits<double>::max();
  }

  /// @return nothing if it has no value; why is in `reply_`
  std::optional<double> value(const Fineness& fineness) {
    reply_ = ask_(fineness, std::max(left(), 0.0));
    if (expense_.note(fineness, reply_.seconds)) answer_.evaluations += reply_.evaluations;
    if (reply_.out_of_time && wish_.budget) {
      reply_.obstacle = fmt::format(
          "the budget of {:.3g} s was spent in the run with spacing {:.4g}, which goes on from "
          "there if there is more of it",
          *wish_.budget, wish_.spacings[fineness.level]);
    }
    return reply_.value;
  }

  [[nodiscard]] Fineness at_level(std::size_t level) const {
    Fineness fineness = fineness_;
    fineness.level = level;
    return fineness;
  }

  /// What the first spacings of a fineness are expected to take still.
  [[nodiscard]] double descent(Fineness fineness) const {
    double seconds = 0.0;
    const std::size_t end = std::min(first_ + kept_levels_, wish_.spacings.size());
    for (fineness.level = first_; fineness.level < end; ++fineness.level) {
      if (!expense_.knows(fineness)) seconds += expense_.expected(fineness);
    }
    return seconds;
  }

  /// And the run that judges its tolerance.
  [[nodiscard]] double reserve(const Fineness& fineness) const {
    Fineness tighter = fineness;
    tighter.tolerance *= tenth;
    const bool judged = tolerance_ || expense_.knows(tighter);
    return descent(fineness) + (judged ? 0.0 : expense_.expected(tighter));
  }

  /// Whether a run to learn from leaves enough for the answer.
  [[nodiscard]] bool allowed(const Fineness& fineness, double kept) const {
    return !wish_.budget || expense_.knows(fineness) ||
           expense_.expected(fineness) + kept <= left();
  }

  /// The coarsest spacing that has a value, and the one at which the rest is looked at: the second,
  /// which is fine enough to behave as finer ones do, unless the budget is too short for it.
  bool find_first() {
    constexpr double runs = 10.0;  // of some steps and tolerances, over one as the scene has it
    const std::size_t count = wish_.spacings.size();
    std::string why;
    for (first_ = 0; first_ + 1 < count; ++first_) {
      // With a budget the coarsest is run first: it tells what others take.
      fineness_.level = wish_.budget ? first_ : first_ + 1;
      if (value(fineness_)) {
        if (!wish_.budget) return true;
        const Fineness second = at_level(first_ + 1);
        if (runs * expense_.expected(second) + descent(fineness_) <= left()) {
          fineness_ = second;
          if (!value(second)) fineness_.level = first_;
        }
        keep_levels();
        return true;
      }
      if (why.empty()) why = reply_.obstacle;
      if (reply_.of_any_run || reply_.out_of_time) break;
    }
    return give_up(reply_.out_of_time ? reply_.obstacle : why);
  }

  /// As many spacings as the budget has room for, up to the number of which an order is believed in
  /// any case: finer steps at too few spacings tell less than coarser ones at more.
  void keep_levels() {
    Fineness twice = fineness_;
    twice.steps *= 2.0;
    const double study = expense_.expected(twice);
    for (kept_levels_ = more_levels; kept_levels_ > 2; --kept_levels_) {
      if (study + reserve(fineness_) <= left()) return;
    }
  }

  bool give_up(const std::string& why) {
    answer_.obstacle = why.empty() ? "a run of the ladder has no such value" : why;
    return false;
  }
  bool too_short_for(const char* what) {
    return give_up(
        fmt::format("the budget of {:.3g} s leaves too little, after {:.3g} s spent, "
                    "for {} and {} spacings",
                    *wish_.budget, expense_.spent(), what, kept_levels_));
  }
  /// Goes on with what is known.
  bool without(const char* finer) {
    if (!wish_.budget) return true;
    if (!short_of_.empty()) short_of_ += ", nor ";
    short_of_ += finer;
    return true;
  }

  /// Refines in one way until what is left is small. The errors of implicit steps, and of a box
  /// that ends too early, are of first order at least. Three runs tell of each of them: the
  /// coarsest that is good enough is taken. Where they do not settle, three of a course that goes
  /// astray may lie near each other: then all that has changed so far counts.
  bool settle(const Refinement& way, std::optional<Known>& known) {
    std::vector<double> times, all;
    const Fineness before = fineness_;
    for (double now = 1.0;; now *= way.ratio) {
      Fineness next = before;
      next.*way.member = now;
      if (!all.empty() && !allowed(next, reserve(fineness_))) break;
      const auto found = value(next);
      if (!found && all.size() < 2) return give_up(reply_.obstacle);
      if (!found) break;
      if (all.empty()) resolution_ = reply_.resolution;
      times.push_back(now);
      all.push_back(*found);
      if (all.size() >= 3 && choose(way, times, all, known)) return true;
    }
    if (all.size() < 2) return too_short_for(way.needed);
    if (all.size() == 2) choose(way, times, all, known);
    return without(way.needed);
  }

  /// Takes the coarsest of the runs that is good enough, by what the last three say, or else the
  /// finest that can still be afforded at three spacings; the coarsest where they do not settle,
  /// since finer ones are no better then. What is a little too much is good enough where none of
  /// them is: spacings cost less then than more of the same.
  /// @return whether no more runs are needed, or would help
  bool choose(const Refinement& way, const std::vector<double>& times,
              const std::vector<double>& all, std::optional<Known>& known) {
    const std::size_t begin = times.size() - std::min<std::size_t>(times.size(), 3);
    Samples samples;
    for (std::size_t i = begin; i < times.size(); ++i) samples.push_back({1.0 / times[i], all[i]});
    const convergence::Extrapolation found = convergence::extrapolate(samples, 1.0);
    for (const double part : {share, most_share}) {
      for (std::size_t i = 0; i < times.size(); ++i) {
        Fineness one = fineness_;
        one.*way.member = times[i];
        if (i > 0 && (!settles(found.course) || reserve(one) > left())) break;
        // The extrapolation speaks of the finest; this run's is farther by all that lies between.
        const auto from = all.begin() + static_cast<std::ptrdiff_t>(i);
        double error = found.uncertainty + range_of({from, all.end()});
        if (!settles(found.course)) error = std::max(error, cautious * range_of(all));
        error += resolution_ / times[i];
        known = Known{{way.source, error,
                       fmt::format("{}, {:.3g} to {:.3g} {}", name_of(found.course), times[begin],
                                   times.back(), way.words)},
                      all[i]};
        fineness_ = one;
        if (error <= part * wish_.accuracy * std::abs(all[i])) return true;
      }
    }
    return times[begin] >= way.most;
  }

  /// Tightens the tolerance until what it leaves is small.
  bool settle_tolerance() {
    constexpr double least = 1e-5, half = 0.5;
    constexpr const char* needed = "a tighter tolerance";
    while (true) {
      Fineness now = fineness_, finer = fineness_;
      finer.tolerance *= tenth;
      if (!tolerance_ && !allowed(finer, descent(now))) {
        // The coarsest spacing tells of it as well, if less surely.
        now.level = finer.level = first_;
      }
      const auto of_now = value(now);
      if (!of_now) return give_up(reply_.obstacle);
      if (!allowed(finer, descent(now)))
        return tolerance_ ? without(needed) : too_short_for(needed);
      const auto of_finer = value(finer);
      if (!of_finer) return tolerance_ ? without(needed) : give_up(reply_.obstacle);
      const double change = std::abs(*of_now - *of_finer);
      const double enough = share * wish_.accuracy * std::abs(*of_now);
      // An error in proportion to the tolerance is 1 / (1 - 0.1) of the change; three times that
      // for one that is not quite. A tenth of the tolerance leaves a ninth of the change then, or
      // less than half of it if errors fall as its square root.
      tolerance_ = Known{left_by(now, 3.0 / (1.0 - tenth) * change,
                                 "three times what a tenth of it changes", *of_now),
                         *of_now};
      if (tolerance_->part.error <= enough || now.tolerance <= least) return true;
      if (descent(finer) > left()) return without(needed);
      tolerance_ =
          Known{left_by(finer, half * change, "half of what ten times as much changes", *of_finer),
                *of_finer};
      fineness_ = finer;
      if (tolerance_->part.error <= enough) return true;
    }
  }

  /// What a tolerance leaves, by what it changes; not less than what it lets a step leave, as two
  /// runs that agree by chance, or on coarse particles alone, do not say what finer ones do.
  [[nodiscard]] Part left_by(const Fineness& one, double error, const char* words,
                             double value) const {
    const double least = wish_.unbalanced * one.tolerance * std::abs(value);
    if (error < least) return {"tolerance", least, "what a step may leave unbalanced"};
    return {"tolerance", error, words};
  }

  bool settle_box() {
    return !wish_.box ||
           settle({"box", &Fineness::box, 1.5, 6.0, "times as far", "a wider box"}, box_);
  }

  /// Says what the control decides, where there is one with a stiffness and time for it.
  void look_at_control() {
    Fineness half = fineness_;
    half.control = 0.5;
    const auto now = value(fineness_);
    if (!now || !allowed(half, descent(fineness_))) return;
    const auto other = value(half);
    if (!other) return;
    control_ =
        Known{{"control", 2.0 * std::abs(*now - *other), "twice what half of it changes"}, *now};
  }

  /// Falling spacings until the wish is met.
  void descend() {
    Samples samples;
    for (std::size_t level = first_; level < wish_.spacings.size(); ++level) {
      const Fineness fineness = at_level(level);
      if (!samples.empty() && wish_.budget && !expense_.knows(fineness) &&
          expense_.expected(fineness) > left()) {
        return end(samples,
                   fmt::format("the budget of {:.3g} s does not allow a finer run, which "
                               "takes some {:.3g} s after {:.3g} s spent",
                               *wish_.budget, expense_.expected(fineness), expense_.spent()));
      }
      if (!value(fineness)) {
        // Too coarse for the body: the ladder begins with the next.
        if (samples.empty() && !reply_.out_of_time && !reply_.of_any_run) continue;
        return end(samples, reply_.out_of_time
                                ? reply_.obstacle
                                : fmt::format("the run with spacing {:.4g} has no such value: {}",
                                              wish_.spacings[level], reply_.obstacle));
      }
      samples.push_back({wish_.spacings[level], *reply_.value});
      answer_.fineness = fineness;
      if (samples.size() < first_levels) continue;
      const bool settled = settles(judge(samples));
      answer_.reached = answer_.reached && (settled || samples.size() >= more_levels);
      if (answer_.reached) return;
    }
    end(samples, fmt::format("the finest spacing on offer is {:.4g}", wish_.spacings.back()));
  }

  /// The ladder ends without what was asked for.
  void end(const Samples& samples, std::string obstacle) {
    if (samples.size() == 2) judge(samples);
    answer_.reached = false;
    answer_.obstacle = std::move(obstacle);
    if (!short_of_.empty()) answer_.obstacle += fmt::format(", nor {}", short_of_);
    if (!answer_.parts.empty() && answer_.bar <= wish_.accuracy * std::abs(answer_.value)) {
      answer_.obstacle +=
          "; the bar is as small as asked for, but of so few spacings that do not settle it is not "
          "believed";
    }
  }

  /// What the runs so far say of the last of them, and how they go.
  convergence::Course judge(const Samples& samples) {
    constexpr std::size_t most = 4;  // coarser ones belong to another regime
    const auto from = samples.end() - static_cast<std::ptrdiff_t>(std::min(most, samples.size()));
    const convergence::Extrapolation found =
        convergence::extrapolate({from, samples.end()}, wish_.formal);
    answer_.value = samples.back().value;
    std::string words = std::string(name_of(found.course));
    if (found.order) words += fmt::format(", order {:.2f}", *found.order);
    answer_.parts = {{"spacing", found.uncertainty, words}};
    answer_.bar = found.uncertainty;
    for (const auto& known : {steps_, tolerance_, box_}) {
      if (!known) continue;
      answer_.parts.push_back(scaled(*known));
      answer_.bar += answer_.parts.back().error;
    }
    if (control_) answer_.control = scaled(*control_);
    answer_.reached = answer_.bar <= wish_.accuracy * std::abs(answer_.value);
    return found.course;
  }

  [[nodiscard]] Part scaled(const Known& known) const {
    Part part = known.part;
    if (known.of != 0.0) part.error *= std::abs(answer_.value / known.of);
    return part;
  }

  const Wish& wish_;
  const Ask& ask_;
  Expense expense_;
  Answer answer_;
  Reply reply_;                            // the last one
  Fineness fineness_;                      // of the answer's run, but for its level
  std::size_t first_ = 0;                  // level of the ladder's coarsest run
  std::size_t kept_levels_ = more_levels;  // that part of the budget is kept back for
  double resolution_ = 0.0;                // of the scene's own steps
  std::string short_of_;                   // what the budget has left no room for
  std::optional<Known> steps_, tolerance_, control_, box_;
};

}  // namespace

Answer climb(const Wish& wish, const Ask& ask) {
  return Climb(wish, ask)();
}

}  // namespace study
