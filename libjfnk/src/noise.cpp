#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "strategy.hpp"

// The noise of F from a table of differences (ECNoise: Moré & Wild 2011), and the difference step
// that balances it against the curvature (Moré & Wild 2012).
namespace jfnk::detail {
namespace {

constexpr int points = 7;
constexpr int projections = 4;
using Samples = std::array<std::array<double, points>, projections>;

/// +1 or -1, the same in every run.
double sign(Eigen::Index i, int projection) {
  auto z = static_cast<std::uint64_t>(i) * 4 + static_cast<std::uint64_t>(projection);
  z = (z + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return ((z >> 40U) & 1U) != 0 ? 1.0 : -1.0;
}

/// Random signs turn ||noise|| into the deviation of a number.
void project(const Vector& r, int point, const InnerProductRef& product, Vector& signs,
             Samples& samples) {
  for (int p = 0; p < projections; ++p) {
    for (Eigen::Index i = 0; i < signs.size(); ++i) signs[i] = sign(i, p);
    samples[static_cast<std::size_t>(p)][static_cast<std::size_t>(point)] = product.dot(signs, r);
  }
}

enum class Verdict { found, step_too_small, step_too_large };

/// The level at which three orders of differences agree to a factor of four while signs change.
Verdict judge(Samples table, double& noise) {
  std::array<double, points> level{};
  std::array<bool, points> changes{};
  double factor = 1.0;  // (k!)^2 / (2k)!
  int zeros = 0;
  for (int k = 1; k < points; ++k) {
    factor *= k / (4.0 * k - 2.0);
    double sum = 0.0;
    bool changed = false;
    for (auto& row : table) {
      for (int i = 0; i + k < points; ++i) {
        const auto j = static_cast<std::size_t>(i);
        row[j] = row[j + 1] - row[j];
        if (k == 1 && row[j] == 0.0) ++zeros;
        if (i > 0 && row[j] * row[j - 1] < 0.0) changed = true;
        sum += row[j] * row[j];
      }
    }
    level[static_cast<std::size_t>(k)] =
        std::sqrt(factor * sum / (projections * (points - k)));
    changes[static_cast<std::size_t>(k)] = changed;
  }
  if (zeros >= projections * (points - 1) / 2) return Verdict::step_too_small;
  for (std::size_t k = 1; k + 2 < points; ++k) {
    const auto [low, high] = std::minmax({level[k], level[k + 1], level[k + 2]});
    if (high <= 4.0 * low && changes[k]) {
      noise = level[k];
      return Verdict::found;
    }
  }
  return Verdict::step_too_large;
}

Outcome look(Solve& solve, double h) {
  Workspace& work = solve.work;
  work.trial.u = work.best.u + h * work.step;
  return solve.evaluator.evaluate(work.trial, &Counts::noise);
}

/// Samples at equal distances h about the best point; its own residual is known.
Outcome sample(Solve& solve, double h, Samples& samples) {
  const InnerProductRef& product = solve.evaluator.product();
  for (int i = 0; i < points; ++i) {
    const int place = i - points / 2;
    if (place != 0) {
      const Outcome outcome = look(solve, place * h);
      if (outcome != Outcome::ok) return outcome;
    }
    project(place == 0 ? solve.work.best.r : solve.work.trial.r, i, product, solve.work.direction,
            samples);
  }
  return Outcome::ok;
}

/// ||J d|| and ||F''|| along the unit direction d, over a distance at which noise does not reach them.
struct Shape {
  double slope = 0.0;
  double bend = 0.0;
};

Outcome measure_shape(Solve& solve, double noise, double scale, Shape& shape) {
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  const double h = std::pow(noise / std::max(work.best.norm, noise), 0.25) * scale;
  Outcome outcome = look(solve, h);
  if (outcome != Outcome::ok) return outcome;
  work.direction = work.trial.r;
  outcome = look(solve, -h);
  if (outcome != Outcome::ok) return outcome;
  work.direction -= work.trial.r;
  shape.slope = product.norm(work.direction) / (2.0 * h);
  work.direction += 2.0 * (work.trial.r - work.best.r);
  shape.bend = product.norm(work.direction) / (h * h);
  return outcome;
}

}  // namespace

bool adapt_to_noise(Solve& solve, Ending& ending) {
  // Three spans, as far as the noise is not seen in the first (Moré & Wild 2011, section 5).
  constexpr int max_spans = 3;
  constexpr double first_span = 1e-8;
  constexpr double span_change = 100.0;
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  solve.course.noise_measured = true;
  for (Eigen::Index i = 0; i < work.step.size(); ++i) work.step[i] = sign(i, projections);
  work.step /= product.norm(work.step);
  const double scale = std::sqrt(1.0 + product.norm(work.best.u));
  Samples samples{};
  double noise = 0.0;
  double h = first_span * scale;
  for (int span = 0; span < max_spans; ++span) {
    const Outcome outcome = sample(solve, h, samples);
    if (outcome == Outcome::stopped || outcome == Outcome::limit) {
      ending = outcome == Outcome::stopped ? Ending::stopped : Ending::limit;
      return false;
    }
    const Verdict verdict =
        outcome == Outcome::ok ? judge(samples, noise) : Verdict::step_too_large;
    if (verdict == Verdict::found) break;
    h *= verdict == Verdict::step_too_small ? span_change : 1.0 / span_change;
  }
  if (!(noise > 0.0)) return false;
  solve.report.measured_noise = noise;
  Shape shape;
  const Outcome outcome = measure_shape(solve, noise, scale, shape);
  if (outcome == Outcome::stopped || outcome == Outcome::limit) {
    ending = outcome == Outcome::stopped ? Ending::stopped : Ending::limit;
    return false;
  }
  // Is noise the trouble at all? It must be seen in the Jacobian actions.
  constexpr double harmless = 0.03;
  EvaluatorState& state = work.evaluator_state;
  if (outcome != Outcome::ok || noise < harmless * shape.slope * state.noise * scale) return false;
  // A straight F bears any step; its rounding then asks for no more than a hundredth of 1 + ||u||.
  constexpr double longest = 1e-2;
  const double best = shape.bend > 0.0 ? std::pow(8.0, 0.25) * std::sqrt(noise / shape.bend)
                                       : longest * scale;
  const double b = std::min(best, longest * scale) / scale;
  if (b <= state.noise) return false;
  state.noise = b;
  // What was learnt with the step of before is worth nothing.
  work.secants.clear();
  solve.course.mixing_known = false;
  solve.course.radius = 0.0;
  return true;
}

}  // namespace jfnk::detail
