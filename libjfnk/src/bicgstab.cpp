#include "jfnk/bicgstab.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace jfnk {
namespace {

// Below this cosine of the shadow residual with what it must meet, the recurrence has broken down.
constexpr double breakdown_cosine = 1e-14;

KrylovStatus failure_of(Evaluation outcome) {
  return outcome == Evaluation::stop ? KrylovStatus::stopped : KrylovStatus::operator_failed;
}

}  // namespace

void BiCGStab::resize(Eigen::Index n, bool preconditioned) {
  for (Vector* v : {&r_, &shadow_, &p_, &v_, &t_, &best_}) v->resize(n);
  image_.resize(preconditioned ? n : 0);
}

GmresResult BiCGStab::solve(const OperatorRef& A, const Vector& b, Vector& x,
                            const GmresOptions& options, const PreconditionerRef& P,
                            const InnerProductRef& product) {
  if (b.size() != x.size()) {
    throw std::invalid_argument("jfnk::BiCGStab: b has size " + std::to_string(b.size()) +
                                ", x has size " + std::to_string(x.size()));
  }
  if (const auto messages = validate(options); !messages.empty()) {
    throw std::invalid_argument("jfnk::BiCGStab: " + messages.front());
  }
  resize(b.size(), !P.is_identity());
  GmresResult result;
  const double b_norm = product.norm(b);
  const double target = std::max(options.absolute_tolerance, options.relative_tolerance * b_norm);
  x.setZero();
  best_.setZero();
  r_ = b;
  shadow_ = b;
  p_ = b;
  lowest_ = b_norm;
  double rho = product.dot(shadow_, r_);
  result.status = KrylovStatus::max_iterations;
  while (lowest_ > target && result.iterations + 2 <= std::max(2, options.max_iterations)) {
    double alpha = 0.0;
    double omega = 0.0;
    const KrylovStatus status = iterate(A, P, product, target, rho, alpha, omega, x, result);
    if (status != KrylovStatus::max_iterations) {
      result.status = status;
      break;
    }
    const double next = product.dot(shadow_, r_);
    p_ = r_ + (next / rho) * (alpha / omega) * (p_ - omega * v_);
    rho = next;
  }
  if (lowest_ <= target) result.status = KrylovStatus::converged;
  x = best_;
  result.residual_norm = lowest_;
  result.relative_residual = b_norm > 0.0 ? lowest_ / b_norm : 0.0;
  return result;
}

// Both halves of one iteration; max_iterations unless it must be the last.
KrylovStatus BiCGStab::iterate(const OperatorRef& A, const PreconditionerRef& P,
                               const InnerProductRef& product, double target, double rho,
                               double& alpha, double& omega, Vector& x, GmresResult& result) {
  // A vector in the space of x: P w, or w itself.
  const auto image = [&](const Vector& w) -> const Vector& {
    if (P.is_identity()) return w;
    P.apply(w, image_);
    return image_;
  };
  const auto keep_best = [&] {
    const double norm = product.norm(r_);
    if (!(norm < lowest_)) return;
    lowest_ = norm;
    best_ = x;
  };
  const Vector& direction = image(p_);
  Evaluation outcome = A(direction, v_);
  ++result.iterations;
  const double scale = product.norm(shadow_) * product.norm(v_);
  if (outcome != Evaluation::ok || !std::isfinite(scale)) return failure_of(outcome);
  const double against = product.dot(shadow_, v_);
  if (!(std::abs(against) > breakdown_cosine * scale)) return KrylovStatus::breakdown;
  alpha = rho / against;
  x += alpha * direction;
  r_ -= alpha * v_;
  keep_best();
  if (lowest_ <= target) return KrylovStatus::converged;

  const Vector& correction = image(r_);
  outcome = A(correction, t_);
  ++result.iterations;
  const double square = product.dot(t_, t_);
  if (outcome != Evaluation::ok || !std::isfinite(square)) return failure_of(outcome);
  omega = square > 0.0 ? product.dot(t_, r_) / square : 0.0;
  x += omega * correction;
  r_ -= omega * t_;
  keep_best();
  const bool exhausted = omega == 0.0 || rho == 0.0;
  return exhausted ? KrylovStatus::breakdown : KrylovStatus::max_iterations;
}

}  // namespace jfnk
