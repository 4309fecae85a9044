#include "evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace jfnk::detail {
namespace {

// Factor of eps after F was out of domain on both sides.
constexpr double shrink = 0.1;

Outcome translate(Evaluation evaluation) {
  switch (evaluation) {
    case Evaluation::ok:
      return Outcome::ok;
    case Evaluation::out_of_domain:
      return Outcome::out_of_domain;
    case Evaluation::stop:
      return Outcome::stopped;
  }
  return Outcome::out_of_domain;
}

void require_size(const Vector& r, Eigen::Index n, const char* who) {
  if (r.size() != n) {
    throw std::invalid_argument(std::string("jfnk: ") + who + " resized its output from " +
                                std::to_string(n) + " to " + std::to_string(r.size()));
  }
}

}  // namespace

Outcome Evaluator::call(const Vector& u, Vector& r) {
  const Outcome outcome = translate(residual_(u, r));
  require_size(r, u.size(), "the residual");
  return outcome;
}

Outcome Evaluator::evaluate(Iterate& point, int Counts::*purpose) {
  if (limit_reached()) return Outcome::limit;
  ++(counts_.*purpose);
  const Outcome outcome = call(point.u, point.r);
  if (outcome != Outcome::ok) return outcome;
  point.norm = product().norm(point.r);
  point.reference = residual_.has_reference_norm() ? residual_.reference_norm() : start_norm_;
  const bool usable = std::isfinite(point.norm) && std::isfinite(point.reference);
  return usable ? Outcome::ok : Outcome::out_of_domain;
}

Outcome Evaluator::evaluate_start(Iterate& point) {
  point.r.setZero();
  const Outcome outcome = evaluate(point, &Counts::start);
  start_norm_ = point.norm;
  if (outcome == Outcome::ok && !residual_.has_reference_norm()) point.reference = start_norm_;
  return outcome;
}

double Evaluator::tolerance(const Iterate& point) const {
  return std::max(options_.tolerances.absolute, options_.tolerances.relative * point.reference);
}

bool Evaluator::converged(const Iterate& point, double step_norm) const {
  if (point.norm == 0.0) return true;
  if (point.norm > tolerance(point)) return false;
  if (options_.tolerances.step == 0.0) return true;
  return step_norm >= 0.0 && step_norm <= options_.tolerances.step * product().norm(point.u);
}

Outcome Evaluator::linearise(const Iterate& base) {
  base_ = &base;
  if (options_.jacobian.source == Jacobian::Source::user_if_available && residual_.has_jacobian()) {
    ++counts_.linearisations;
    return translate(residual_.linearise(base.u));
  }
  base_u_norm_ = product().norm(base.u);
  return Outcome::ok;
}

Outcome Evaluator::action(const Vector& v, Vector& Jv) {
  if (options_.jacobian.source != Jacobian::Source::user_if_available ||
      !residual_.has_jacobian()) {
    return difference(v, Jv);
  }
  if (limit_reached()) return Outcome::limit;
  ++counts_.user_actions;
  const Outcome outcome = translate(residual_.apply_jacobian(v, Jv));
  require_size(Jv, v.size(), "apply_jacobian");
  return outcome;
}

double Evaluator::difference_step(double v_norm) const {
  const Jacobian& j = options_.jacobian;
  const auto n = static_cast<double>(probe_.size());
  Jacobian::Step step = j.step;
  if (step == Jacobian::Step::automatic) {
    step = j.length_scale > 0.0 ? Jacobian::Step::length_scale : Jacobian::Step::generic;
  }
  switch (step) {
    case Jacobian::Step::length_scale:
      return j.noise * j.length_scale * std::sqrt(n) / v_norm;
    case Jacobian::Step::paper:
      // Departure: read with b for the paper's "computer precision" c, whose own size would leave
      // no digit of the difference, and with 1 for ||u|| = 0, where the formula gives no
      // step: doc/appendix_a.md.
      return (1.0 + v_norm) * j.noise * (base_u_norm_ > 0.0 ? base_u_norm_ : 1.0);
    default:
      return j.noise * std::sqrt(1.0 + base_u_norm_) / v_norm;
  }
}

Outcome Evaluator::difference(const Vector& v, Vector& Jv) {
  const double v_norm = product().norm(v);
  if (v_norm == 0.0) {
    Jv.setZero();
    return Outcome::ok;
  }
  double eps = difference_step(v_norm);
  for (int attempt = 0; attempt < options_.jacobian.max_attempts; ++attempt) {
    if (limit_reached()) return Outcome::limit;
    probe_ = base_->u + eps * v;
    ++counts_.difference_actions;
    const Outcome outcome = call(probe_, Jv);
    if (outcome == Outcome::stopped) return outcome;
    if (outcome == Outcome::ok && std::isfinite(product().norm(Jv))) {
      Jv = (Jv - base_->r) / eps;
      return Outcome::ok;
    }
    eps = eps > 0.0 ? -eps : -eps * shrink;
  }
  return Outcome::out_of_domain;
}

}  // namespace jfnk::detail
