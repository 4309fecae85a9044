#include "jfnk/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "passes.hpp"

namespace jfnk {

void ConjugateGradients::resize(Eigen::Index n, bool preconditioned) {
  for (Vector* v : {&r_, &p_, &product_}) v->resize(n);
  image_.resize(preconditioned ? n : 0);
}

GmresResult ConjugateGradients::solve(const OperatorRef& A, const Vector& b, Vector& x,
                                      const GmresOptions& options, const PreconditionerRef& P,
                                      const InnerProductRef& product) {
  if (b.size() != x.size()) {
    throw std::invalid_argument("jfnk::ConjugateGradients: b has size " + std::to_string(b.size()) +
                                ", x has size " + std::to_string(x.size()));
  }
  if (const auto messages = validate(options); !messages.empty()) {
    throw std::invalid_argument("jfnk::ConjugateGradients: " + messages.front());
  }
  resize(b.size(), !P.is_identity());
  GmresResult result;
  const double b_norm = product.norm(b);
  const double target = std::max(options.absolute_tolerance, options.relative_tolerance * b_norm);
  x.setZero();
  // In units of ||b||, so that no square over- or underflows whatever the units are.
  const double unit = b_norm > 0.0 ? b_norm : 1.0;
  double norm = b_norm / unit;
  r_.resize(b.size());
  product.pass(b.size(), 2, [&](Rows rows) { rows.of(r_) = rows.of(b) / unit; });
  double rho = 0.0;  // no direction yet
  result.status = KrylovStatus::max_iterations;
  while (norm * unit > target && result.iterations < options.max_iterations) {
    result.status = advance(A, P, product, rho, norm, x, result.iterations);
    if (result.status != KrylovStatus::max_iterations) break;
  }
  product.pass(x.size(), 2, [&](Rows rows) { rows.of(x) *= unit; });
  norm *= unit;
  if (norm <= target) result.status = KrylovStatus::converged;
  result.residual_norm = norm;
  result.relative_residual = b_norm > 0.0 ? norm / b_norm : 0.0;
  return result;
}

// One iteration; max_iterations unless it must be the last.
// @param[in,out] rho  <r, P r> of the iteration before
KrylovStatus ConjugateGradients::advance(const OperatorRef& A, const PreconditionerRef& P,
                                         const InnerProductRef& product, double& rho, double& norm,
                                         Vector& x, int& iterations) {
  const bool plain = P.is_identity();
  if (!plain) P.apply(r_, image_);
  const Vector& z = plain ? r_ : image_;
  const double before = rho;
  rho = product.dot(r_, z);
  if (!std::isfinite(rho)) return KrylovStatus::operator_failed;
  if (rho <= 0.0) return KrylovStatus::indefinite;
  if (before == 0.0) {
    detail::assign(product, p_, z);
  } else {
    detail::add(product, p_, z, rho / before, p_);
  }
  ++iterations;
  const Evaluation outcome = A(p_, product_);
  if (outcome == Evaluation::stop) return KrylovStatus::stopped;
  const double curvature = product.dot(p_, product_);
  if (outcome != Evaluation::ok || !std::isfinite(curvature)) return KrylovStatus::operator_failed;
  if (curvature <= 0.0) return KrylovStatus::indefinite;
  const double length = rho / curvature;
  const Vector* const measured = &r_;
  product.pass(x.size(), 6,
               [&](Rows rows) {
                 rows.of(x) += length * rows.of(p_);
                 rows.of(r_) -= length * rows.of(product_);
               },
               {&measured, 1}, {&norm, 1});
  return KrylovStatus::max_iterations;
}

}  // namespace jfnk
