#include "jfnk/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "evaluator.hpp"
#include "noise_level.hpp"
#include "outcome_text.hpp"

namespace jfnk {
namespace {

using detail::Evaluator;
using detail::Iterate;
using detail::Outcome;

constexpr double rounding_unit = std::numeric_limits<double>::epsilon();

std::string number(double value) {
  return detail::number(value, 2);
}

/// One look at a residual: what the parts of a check share.
struct Examination {
  Evaluator& evaluator;
  CheckReport& report;
  Iterate base;
  Iterate trial;
  Vector direction;
  Vector action;
  Vector scratch;
  double scale = 1.0;  // 1 + ||u||

  Outcome look(double distance) {
    trial.u = base.u + distance * direction;
    return evaluator.evaluate(trial, &Counts::noise);
  }
};

bool same_bits(const Vector& a, const Vector& b) {
  return a.size() == b.size() && (a.array() == b.array()).all();
}

void check_repeatability(Examination& e) {
  const auto again = [&](Vector& r) {
    e.trial.u = e.base.u;
    const bool evaluable = e.evaluator.evaluate(e.trial, &Counts::noise) == Outcome::ok;
    r = e.trial.r;
    return evaluable;
  };
  Vector& second = e.scratch;
  Vector& third = e.action;
  const bool twice = again(second) && again(third);
  e.report.deterministic = twice && same_bits(second, third);
  detail::random_direction(8, e.evaluator.product(), e.direction);
  (void)e.look(1e-3 * e.scale);
  const bool after = again(third);
  e.report.repeatable =
      e.report.deterministic && after && same_bits(second, e.base.r) && same_bits(third, e.base.r);
}

void check_noise(Examination& e) {
  constexpr int max_spans = 3;
  constexpr double span_change = 100.0;
  detail::random_direction(9, e.evaluator.product(), e.direction);
  // Beside u, which may be a special place: a kink looks like noise.
  const double aside = 1e-3 * e.scale;
  double h = 1e-8 * std::sqrt(e.scale);
  for (int span = 0; span < max_spans; ++span) {
    detail::NoiseSamples samples{};
    Outcome outcome = Outcome::ok;
    for (int i = 0; i < detail::noise_points && outcome == Outcome::ok; ++i) {
      const int place = i - detail::noise_points / 2;
      outcome = e.look(aside + place * h);
      detail::project_sample(e.trial.r, i, e.evaluator.product(), e.scratch, samples);
    }
    const auto verdict = outcome == Outcome::ok ? detail::judge_noise(samples, e.report.noise)
                                                : detail::NoiseVerdict::step_too_large;
    if (verdict == detail::NoiseVerdict::found) return;
    h *= verdict == detail::NoiseVerdict::step_too_small ? span_change : 1.0 / span_change;
  }
}

/// Error of J v against central differences, and the order of the Taylor remainder.
void check_action(Examination& e, int number_of_direction) {
  const InnerProductRef& product = e.evaluator.product();
  detail::random_direction(10 + number_of_direction % 4, product, e.direction);
  if (e.evaluator.linearise(e.base) != Outcome::ok) return;
  e.action.setConstant(detail::unwritten());
  if (e.evaluator.action(e.direction, e.action) != Outcome::ok) return;
  const double length = product.norm(e.action);

  std::array<double, 8> remainder{};
  for (std::size_t k = 0; k < remainder.size(); ++k) {
    const double t = std::pow(10.0, -1.0 - static_cast<double>(k)) * e.scale;
    ++e.report.probes;
    if (e.look(t) != Outcome::ok) {
      ++e.report.probes_out_of_domain;
      e.report.distance_to_domain_edge = std::min(e.report.distance_to_domain_edge, t / e.scale);
      remainder[k] = std::numeric_limits<double>::quiet_NaN();
      continue;
    }
    e.scratch = e.trial.r - e.base.r - t * e.action;
    remainder[k] = product.norm(e.scratch);
  }
  double order = 0.0;
  const double floor = std::max(e.report.noise, 10.0 * rounding_unit * e.base.norm);
  for (std::size_t k = 0; k + 1 < remainder.size(); ++k) {
    if (!(remainder[k + 1] > 10.0 * floor)) continue;
    order = std::max(order, std::log10(remainder[k] / remainder[k + 1]));
  }
  // Nothing left above the noise: F is straight as far as can be seen.
  if (order == 0.0 && length > 0.0) order = 2.0;
  e.report.taylor_order = std::min(e.report.taylor_order, order);

  const double t = std::cbrt(rounding_unit) * e.scale;
  if (e.look(t) != Outcome::ok) return;
  e.scratch = e.trial.r;
  if (e.look(-t) != Outcome::ok) return;
  e.scratch = (e.scratch - e.trial.r) / (2.0 * t) - e.action;
  const double error = product.norm(e.scratch) / std::max(length, 1e-300);
  e.report.action_error = std::max(e.report.action_error, error);
}

/// Why F has no value at u.
std::string why_not_evaluable(const Iterate& base, bool refused) {
  if (!base.u.allFinite()) return "u is not finite";
  const Eigen::Index place = detail::first_not_finite(base.r, refused);
  if (place < 0) return "F cannot be evaluated at u";
  if (detail::is_unwritten(base.r[place])) return detail::unwritten_text(place);
  return "F cannot be evaluated at u: component " + std::to_string(place) + " is not finite";
}

/// Puts the numbers into words.
void judge(Examination& e, bool own_action, double options_noise) {
  CheckReport& report = e.report;
  // An action whose relative error is beyond this leads Krylov solvers astray.
  constexpr double usable_action = 1e-2;
  constexpr double usable_order = 1.5;
  auto& findings = report.findings;
  report.good = true;
  if (!report.deterministic) {
    findings.push_back(
        "F(u) differs when evaluated twice in a row: chance, threads or memory not "
        "initialised");
    report.good = false;
  } else if (!report.repeatable) {
    findings.push_back(
        "F(u) differs after an evaluation elsewhere: F remembers; let it change its "
        "state in on_accept(u) only");
    report.good = false;
  }
  const bool wrong = report.action_error > usable_action && report.taylor_order < usable_order;
  if (wrong && own_action) {
    findings.push_back("apply_jacobian differs from differences of F by " +
                       number(report.action_error) + " of itself, Taylor order " +
                       number(report.taylor_order) +
                       " instead of 2: it is wrong, or F has a kink "
                       "at u");
    report.good = false;
  } else if (wrong) {
    findings.push_back("differences of F do not settle (Taylor order " +
                       number(report.taylor_order) + " instead of 2): noise, or a kink at u");
  }
  if (report.suggested_noise > options_noise) {
    findings.push_back("F carries noise of " + number(report.noise) + ": set jacobian.noise = " +
                       number(report.suggested_noise) + ", and no tolerance below the noise");
  }
  if (report.probes_out_of_domain > 0) {
    findings.push_back("F has no value at " + number(report.distance_to_domain_edge) +
                       " (1 + ||u||) from u");
  }
}

}  // namespace

CheckReport check(const ResidualRef& residual, const Vector& u, const Options& options,
                  int directions) {
  if (u.size() == 0) throw std::invalid_argument("jfnk::check: u is empty");
  if (const auto messages = validate(options); !messages.empty()) {
    throw std::invalid_argument("jfnk::check: " + messages.front());
  }
  CheckReport report;
  report.distance_to_domain_edge = std::numeric_limits<double>::infinity();
  report.suggested_noise = options.jacobian.noise;
  Counts counts;
  detail::EvaluatorVectors vectors;
  vectors.probe.resize(u.size());
  detail::EvaluatorState state;
  state.noise = options.jacobian.noise;
  const PreconditionerRef none;
  Options unbounded = options;
  unbounded.max_evaluations = std::numeric_limits<int>::max();
  Evaluator evaluator(residual, none, unbounded, counts, vectors, state);
  Examination e{evaluator, report, {}, {}, Vector(u.size()), Vector(u.size()), Vector(u.size())};
  e.base.resize(u.size());
  e.trial.resize(u.size());
  e.base.u = u;
  evaluator.to_solver_units(e.base.u);
  report.evaluable = u.allFinite() && evaluator.evaluate_start(e.base) == Outcome::ok;
  if (!report.evaluable) {
    report.findings.push_back(why_not_evaluable(e.base, evaluator.refused()));
    report.evaluations = counts.total();
    return report;
  }
  report.residual_norm = e.base.norm;
  e.scale = 1.0 + evaluator.product().norm(e.base.u);
  check_repeatability(e);
  check_noise(e);
  report.taylor_order = std::numeric_limits<double>::infinity();
  for (int i = 0; i < std::max(directions, 1); ++i) check_action(e, i);
  if (std::isinf(report.taylor_order)) report.taylor_order = 0.0;
  // b^2 is the relative error of F; its size over the step is taken from the slope.
  constexpr double noticeable = 3.0;
  const double size = std::max(e.base.norm, evaluator.product().norm(e.action));
  if (report.noise > 0.0 && size > 0.0) {
    const double b = std::sqrt(report.noise / size);
    if (b > noticeable * options.jacobian.noise) report.suggested_noise = std::min(b, 1e-2);
  }
  judge(e, !evaluator.differences(), options.jacobian.noise);
  report.evaluations = counts.total();
  return report;
}

}  // namespace jfnk
