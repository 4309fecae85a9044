#include <algorithm>
#include <cmath>

#include "noise_level.hpp"
#include "strategy.hpp"

// The difference step that balances noise against curvature (Moré & Wild 2012).
namespace jfnk::detail {
namespace {

Outcome look(Solve& solve, double h) {
  Workspace& work = solve.work;
  work.trial.u = work.best.u + h * work.step;
  if (!solve.evaluator.within_bounds(work.trial.u)) return Outcome::out_of_domain;
  return solve.evaluator.evaluate(work.trial, &Counts::noise);
}

/// NoiseSamples at equal distances h about the best point; its own residual is known.
Outcome sample(Solve& solve, double h, NoiseSamples& samples) {
  const InnerProductRef& product = solve.evaluator.product();
  for (int i = 0; i < noise_points; ++i) {
    const int place = i - noise_points / 2;
    if (place != 0) {
      const Outcome outcome = look(solve, place * h);
      if (outcome != Outcome::ok) return outcome;
    }
    project_sample(place == 0 ? solve.work.best.r : solve.work.trial.r, i, product,
                   solve.work.direction, samples);
  }
  return Outcome::ok;
}

/// ||J d|| and ||F''|| along the unit direction d, over a distance at which noise does not reach
/// them.
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

/// Whether nothing is to be had below ||F|| but by chance.
/// @param h  distance of the samples, over which F must not change its size by so much that what
/// was
///   measured is the rounding of larger values
bool at_noise_floor(const Solve& solve, double h) {
  constexpr double near = 4.0;  // the noise is known to such a factor
  constexpr double short_way = 1e-2;
  constexpr double alike = 1e3;
  const double noise = solve.report.measured_noise;
  const Iterate& best = solve.work.best;
  const bool representative = h <= short_way * solve.evaluator.product().norm(best.u) ||
                              solve.work.trial.norm <= alike * noise;
  return best.norm <= near * noise && solve.evaluator.tolerance(best) < noise && representative;
}

}  // namespace

bool may_measure_noise(const Solve& solve) {
  // Again where ||F|| has come so far down that what was measured may be another's.
  constexpr double far_below = 1e-6;
  constexpr double near_noise = 10.0;
  const RescueCourse& rescue = solve.course.rescue;
  const double norm = solve.work.best.norm;
  const bool again =
      norm < far_below * rescue.noise_norm ||
      (norm < 0.1 * rescue.noise_norm && norm < near_noise * solve.report.measured_noise);
  return solve.options.jacobian.measure_noise && (!rescue.noise_measured || again);
}

bool changes_farther_off(Solve& solve) {
  if (!solve.evaluator.differences()) return false;
  constexpr double far = 1e-4;  // of 1 + ||u||: beyond the root of the precision of floats
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  random_direction(noise_projections, product, work.step);
  const double scale = std::max(1.0, product.norm(work.best.u));
  return look(solve, far * scale) == Outcome::ok && work.trial.r != work.best.r;
}

bool adapt_to_noise(Solve& solve, Ending& ending) {
  // Three spans, as far as the noise is not seen in the first (Moré & Wild 2011, section 5).
  constexpr int max_spans = 3;
  constexpr double first_span = 1e-8;
  constexpr double span_change = 100.0;
  Workspace& work = solve.work;
  const InnerProductRef& product = solve.evaluator.product();
  solve.course.rescue.noise_measured = true;
  solve.course.rescue.noise_norm = work.best.norm;
  random_direction(noise_projections, product, work.step);
  const double scale = std::sqrt(1.0 + product.norm(work.best.u));
  NoiseSamples samples{};
  double noise = 0.0;
  double h = first_span * scale;
  for (int span = 0; span < max_spans; ++span) {
    const Outcome outcome = sample(solve, h, samples);
    if (outcome == Outcome::stopped || outcome == Outcome::limit) {
      ending = outcome == Outcome::stopped ? Ending::stopped : Ending::limit;
      return false;
    }
    const NoiseVerdict verdict =
        outcome == Outcome::ok ? judge_noise(samples, noise) : NoiseVerdict::step_too_large;
    if (verdict == NoiseVerdict::found) break;
    h *= verdict == NoiseVerdict::step_too_small ? span_change : 1.0 / span_change;
  }
  if (!(noise > 0.0)) return false;
  solve.report.measured_noise = noise;
  if (at_noise_floor(solve, h)) {
    ending = Ending::noise_floor;
    return false;
  }
  if (!solve.evaluator.differences()) return false;
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
  const double best =
      shape.bend > 0.0 ? std::pow(8.0, 0.25) * std::sqrt(noise / shape.bend) : longest * scale;
  const double b = std::min(best, longest * scale) / scale;
  if (b <= state.noise) return false;
  state.noise = b;
  // What was learnt with the step of before is worth nothing.
  work.secants.clear();
  solve.course.multisecant.mixing_known = false;
  solve.course.newton.radius = 0.0;
  return true;
}

}  // namespace jfnk::detail
