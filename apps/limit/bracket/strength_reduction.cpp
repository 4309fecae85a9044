#include "limit/bracket/strength_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <stdexcept>

namespace limit::bracket {

namespace {

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// A secant of ln(multiplier) over ln(factor).
class Secant {
 public:
  void add(double factor, double multiplier) {
    const double x = std::log(factor), y = std::log(multiplier);
    if (known_ && std::abs(x - x_) > 1e-9) {
      // Less strength bears less: at least in proportion, and not without end.
      slope_ = std::clamp((y - y_) / (x - x_), -20.0, -1.0);
    }
    x_ = x;
    y_ = y;
    known_ = true;
  }
  [[nodiscard]] bool is_known() const { return known_; }
  /// Where the multiplier should be one.
  [[nodiscard]] double root() const { return std::exp(x_ - y_ / slope_); }

 private:
  bool known_ = false;
  double x_ = 0.0, y_ = 0.0, slope_ = -1.0;
};

class Reduction {
 public:
  Reduction(const problem::Case& problem, const BracketOptions& options,
            const std::function<void(const Attempt&)>& watch)
      : options_(options),
        watch_(watch),
        began_(processor_seconds()),
        lower_(problem::in_units(problem.lower, problem.units)),
        upper_(problem::in_units(problem.upper, problem.units)),
        one_(1.0 / problem.units.multiplier()) {
    for (const problem::Soil& soil : lower_.soils) {
      if (soil.unit_weight != 0.0) {
        throw std::invalid_argument("strength reduction: not all loads are live");
      }
    }
  }

  Solution solution() {
    approach();
    refine();
    close(true);
    close(false);
    result_.bracket.reached = result_.gap() <= options_.gap;
    return std::move(result_);
  }

 private:
  [[nodiscard]] double remaining() const {
    return options_.max_seconds - (processor_seconds() - began_);
  }

  // Both bounds of the loads' multiplier with the strength divided by a factor.
  Bracket bounds_at(double factor, const BracketOptions& options) {
    problem::Problem lower = lower_, upper = upper_;
    for (problem::Problem* problem : {&lower, &upper}) {
      for (problem::Soil& soil : problem->soils) soil = weakened(soil, factor);
    }
    Bracket found = bracket(std::move(lower), std::move(upper), options, watch_);
    for (const Attempt& attempt : found.attempts) result_.bracket.attempts.push_back(attempt);
    if (found.lower) {
      const double multiplier = found.lower_bound() / one_;
      if (multiplier > 0.0) below_.add(factor, multiplier);
      if (multiplier >= 1.0 && (!result_.lower || factor > *result_.lower)) {
        result_.lower = factor;
        result_.bracket.lower = found.lower;
      }
    }
    if (found.upper) {
      const double multiplier = found.upper_bound() / one_;
      if (multiplier > 0.0) above_.add(factor, multiplier);
      if (multiplier <= 1.0 && (!result_.upper || factor < *result_.upper)) {
        result_.upper = factor;
        result_.bracket.upper = found.upper;
      }
    }
    return found;
  }

  [[nodiscard]] BracketOptions once() const {
    BracketOptions options = options_;
    options.max_triangles = 1;  // no refinement, and so no end before it is solved
    return options;
  }

  [[nodiscard]] double between() const {
    if (below_.is_known() && above_.is_known()) return std::sqrt(below_.root() * above_.root());
    return below_.is_known() ? below_.root() : above_.is_known() ? above_.root() : 1.0;
  }

  // On the meshes to begin with, to a factor near which it pays to refine.
  void approach() {
    double factor = 1.0;
    constexpr int most_steps = 6;
    for (int step = 0; step < most_steps; ++step) {
      (void)bounds_at(factor, once());
      const double next = between();
      constexpr double near = 0.02;
      const bool is_near = std::abs(next / factor - 1.0) < near;
      factor = next;
      if (is_near) break;
    }
    factor_ = factor;
  }

  void refine() {
    constexpr double of_gap = 0.8, of_time = 0.6;
    BracketOptions options = options_;
    options.gap = of_gap * options_.gap;
    options.max_seconds = std::max(1.0, of_time * remaining());
    const Bracket found = bounds_at(factor_, options);
    if (found.lower) lower_.mesh = found.lower->mesh;
    if (found.upper) upper_.mesh = found.upper->mesh;
  }

  // From the safe side to the factor at which one bound of the multiplier is one.
  void close(bool is_lower) {
    const Secant& secant = is_lower ? below_ : above_;
    if (!secant.is_known()) return;
    const double aside = options_.gap / 40.0;
    constexpr int most_steps = 4;
    for (int step = 0; step < most_steps; ++step) {
      const double target = secant.root() * (is_lower ? 1.0 - aside : 1.0 + aside);
      const std::optional<double>& have = is_lower ? result_.lower : result_.upper;
      if (have && std::abs(target / *have - 1.0) < 2.0 * aside) return;
      (void)bounds_at(target, once());
    }
  }

  const BracketOptions& options_;
  const std::function<void(const Attempt&)>& watch_;
  double began_;
  problem::Problem lower_, upper_;
  double one_;  // the multiplier of the loads as they are, in its unit
  double factor_ = 1.0;
  Secant below_, above_;
  Solution result_;
};

}  // namespace

problem::Soil weakened(const problem::Soil& soil, double factor) {
  problem::Soil weak = soil;
  weak.cohesion /= factor;
  weak.friction_angle = std::atan(std::tan(soil.friction_angle) / factor);
  return weak;
}

Solution reduce_strength(const problem::Case& problem, const BracketOptions& options,
                         const std::function<void(const Attempt&)>& watch) {
  return Reduction(problem, options, watch).solution();
}

}  // namespace limit::bracket
