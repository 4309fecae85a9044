#include "jfnk/bicgstab.hpp"

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
  const bool preconditioned = !P.is_identity();
  resize(b.size(), preconditioned);
  GmresResult result;
  const double b_norm = product.norm(b);
  const double target = std::max(options.absolute_tolerance, options.relative_tolerance * b_norm);
  // A vector in the space of x: P w, or w itself.
  const auto image = [&](const Vector& w) -> const Vector& {
    if (!preconditioned) return w;
    P.apply(w, image_);
    return image_;
  };
  x.setZero();
  best_.setZero();
  r_ = b;
  double lowest = b_norm;
  result.status = KrylovStatus::max_iterations;
  bool fresh = true;
  double rho = 1.0, alpha = 1.0, omega = 1.0;
  const auto look = [&] {
    const double norm = product.norm(r_);
    if (!(norm < lowest)) return;
    lowest = norm;
    best_ = x;
  };
  // After a breakdown the recurrence starts afresh from the present residual, once.
  bool restarted = false;
  while (lowest > target && result.iterations + 2 <= std::max(2, options.max_iterations)) {
    if (fresh) {
      shadow_ = r_;
      p_ = r_;
      rho = product.dot(shadow_, r_);
      fresh = false;
    } else {
      const double next = product.dot(shadow_, r_);
      const double beta = (next / rho) * (alpha / omega);
      rho = next;
      p_ = r_ + beta * (p_ - omega * v_);
    }
    const Vector& direction = image(p_);
    Evaluation outcome = A(direction, v_);
    ++result.iterations;
    const double against = product.dot(shadow_, v_);
    const double scale = product.norm(shadow_) * product.norm(v_);
    if (outcome != Evaluation::ok || !std::isfinite(scale)) {
      result.status = failure_of(outcome);
      break;
    }
    if (!(std::abs(against) > breakdown_cosine * scale)) {
      result.status = KrylovStatus::breakdown;
      if (restarted) break;
      restarted = fresh = true;
      result.status = KrylovStatus::max_iterations;
      continue;
    }
    alpha = rho / against;
    x += alpha * direction;
    r_ -= alpha * v_;
    look();
    if (lowest <= target) break;
    const Vector& correction = image(r_);
    outcome = A(correction, t_);
    ++result.iterations;
    const double square = product.dot(t_, t_);
    if (outcome != Evaluation::ok || !std::isfinite(square)) {
      result.status = failure_of(outcome);
      break;
    }
    omega = square > 0.0 ? product.dot(t_, r_) / square : 0.0;
    x += omega * correction;
    r_ -= omega * t_;
    look();
    if (omega == 0.0 || rho == 0.0) {
      result.status = KrylovStatus::breakdown;
      break;
    }
  }
  if (lowest <= target) result.status = KrylovStatus::converged;
  x = best_;
  result.residual_norm = lowest;
  result.relative_residual = b_norm > 0.0 ? lowest / b_norm : 0.0;
  return result;
}

}  // namespace jfnk
