#include "evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace jfnk::detail {
namespace {

// Factor of eps after F was out of domain on both sides.
constexpr double shrink = 0.1;

// Part of the way to a bound that a step may go, so that no iterate lies on it.
constexpr double way_to_a_bound = 0.9;

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

const Vector& Evaluator::physical(const Vector& u) {
  if (!u_scaled()) return u;
  vectors_.physical = u.cwiseProduct(options_.u_scale);
  return vectors_.physical;
}

void Evaluator::to_solver_units(Vector& u) const {
  if (u_scaled()) u.array() /= options_.u_scale.array();
}

bool Evaluator::within_bounds(const Vector& u) {
  const Vector& point = physical(u);
  const auto below = [](const Vector& a, const Vector& b) {
    return a.size() == 0 || b.size() == 0 || (a.array() <= b.array()).all();
  };
  return below(options_.lower, point) && below(point, options_.upper);
}

Outcome Evaluator::call(const Vector& u, Vector& r) {
  const Vector& point = physical(u);
  product().pass(r.size(), 1, [&](Rows rows) { rows.of(r).setConstant(unwritten()); });
  const Outcome outcome = translate(residual_(point, r));
  refused_ = outcome == Outcome::out_of_domain;
  require_size(r, u.size(), "the residual");
  if (f_scaled()) r.array() /= options_.f_scale.array();
  return outcome;
}

Outcome Evaluator::evaluate(Iterate& point, int Counts::*purpose) {
  if (limit_reached()) return Outcome::limit;
  ++(counts_.*purpose);
  const Outcome outcome = call(point.u, point.r);
  if (outcome != Outcome::ok) return outcome;
  point.norm = product().norm(point.r);
  point.reference = residual_.has_reference_norm() ? residual_.reference_norm() : state_.start_norm;
  const bool usable = std::isfinite(point.norm) && std::isfinite(point.reference);
  return usable ? Outcome::ok : Outcome::out_of_domain;
}

Outcome Evaluator::evaluate_start(Iterate& point) {
  const Outcome outcome = evaluate(point, &Counts::start);
  state_.start_norm = point.norm;
  if (outcome == Outcome::ok && !residual_.has_reference_norm()) {
    point.reference = state_.start_norm;
  }
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
  if (!differences()) {
    ++counts_.linearisations;
    return translate(residual_.linearise(physical(base.u)));
  }
  base_u_norm_ = product().norm(base.u);
  return Outcome::ok;
}

Outcome Evaluator::action(const Vector& v, Vector& Jv) {
  if (differences()) return difference(v, Jv);
  if (limit_reached()) return Outcome::limit;
  ++counts_.user_actions;
  const Outcome outcome = translate(residual_.apply_jacobian(physical(v), Jv));
  require_size(Jv, v.size(), "apply_jacobian");
  if (f_scaled()) Jv.array() /= options_.f_scale.array();
  return outcome;
}

double Evaluator::difference_step(double v_norm) const {
  const Jacobian& j = options_.jacobian;
  const auto n = static_cast<double>(residual_.global_size(vectors_.probe.size()));
  Jacobian::Step step = j.step;
  if (step == Jacobian::Step::automatic) {
    step = j.length_scale > 0.0 ? Jacobian::Step::length_scale : Jacobian::Step::generic;
  }
  switch (step) {
    case Jacobian::Step::length_scale:
      return state_.noise * j.length_scale * std::sqrt(n) / v_norm;
    case Jacobian::Step::paper:
      // Departure: read with b for the paper's "computer precision" c, whose own size would leave
      // no digit of the difference, and with 1 for ||u|| = 0, where the formula gives no
      // step: doc/appendix_a.md.
      return (1.0 + v_norm) * state_.noise * (base_u_norm_ > 0.0 ? base_u_norm_ : 1.0);
    default:
      return state_.noise * std::sqrt(1.0 + base_u_norm_) / v_norm;
  }
}

Outcome Evaluator::difference(const Vector& v, Vector& Jv) {
  const double v_norm = product().norm(v);
  if (v_norm == 0.0) {
    Jv.setZero();
    return Outcome::ok;
  }
  Vector& probe = vectors_.probe;
  double eps = difference_step(v_norm);
  for (int attempt = 0; attempt < options_.jacobian.max_attempts; ++attempt) {
    if (limit_reached()) return Outcome::limit;
    probe = base_->u + eps * v;
    if (within_bounds(probe)) {
      ++counts_.difference_actions;
      const Outcome outcome = call(probe, Jv);
      if (outcome == Outcome::stopped) return outcome;
      if (outcome == Outcome::ok && std::isfinite(product().norm(Jv))) {
        Jv = (Jv - base_->r) / eps;
        return Outcome::ok;
      }
    }
    eps = eps > 0.0 ? -eps : -eps * shrink;
  }
  return Outcome::out_of_domain;
}

void Evaluator::precondition(const Vector& r, Vector& z) {
  if (preconditioner().is_identity()) {
    z = r;
    return;
  }
  ++counts_.preconditioner;
  z.resize(r.size());
  if (preconditioned_by_learning()) {
    vectors_.learnt.apply(r, z);
    return;
  }
  if (f_scaled()) {
    vectors_.image = r.cwiseProduct(options_.f_scale);
    preconditioner_.apply(vectors_.image, z);
  } else {
    preconditioner_.apply(r, z);
  }
  require_size(z, r.size(), "the preconditioner");
  to_solver_units(z);
}

void Evaluator::setup(const Vector& u) {
  ++counts_.preconditioner_setups;
  preconditioner_.setup(physical(u));
}

void Evaluator::accept(const Vector& u) {
  if (residual_.has_on_accept()) residual_.on_accept(physical(u));
}

void Evaluator::filter(const Vector& u, Vector& step) {
  if (residual_.has_step_filter()) {
    const Vector& point = physical(u);
    if (u_scaled()) step.array() *= options_.u_scale.array();
    residual_.filter_step(point, step);
    require_size(step, u.size(), "filter_step");
    to_solver_units(step);
  }
  double part = 1.0;
  const auto cut = [&](double room, double way) {
    if (way > way_to_a_bound * room) part = std::min(part, way_to_a_bound * room / way);
  };
  for (Eigen::Index i = 0; i < options_.lower.size() || i < options_.upper.size(); ++i) {
    const double scale = u_scaled() ? options_.u_scale[i] : 1.0;
    if (step[i] < 0.0 && options_.lower.size() > 0) {
      cut(u[i] * scale - options_.lower[i], -step[i] * scale);
    } else if (step[i] > 0.0 && options_.upper.size() > 0) {
      cut(options_.upper[i] - u[i] * scale, step[i] * scale);
    }
  }
  if (part < 1.0) step *= part;
}

}  // namespace jfnk::detail
