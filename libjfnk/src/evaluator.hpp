#pragma once

#include "jfnk/options.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// What came of an evaluation, seen from the strategy.
enum class Outcome {
  ok,
  out_of_domain,
  stopped,  ///< the residual asked to stop
  limit     ///< max_evaluations is used up; nothing was evaluated
};

/// A point with its residual.
struct Iterate {
  Vector u;
  Vector r;
  double norm = 0.0;       ///< ||r||
  double reference = 0.0;  ///< scale of the relative tolerance at u

  void resize(Eigen::Index n) {
    u.resize(n);
    r.resize(n);
  }
};

/// The only door to the residual: counts, checks for NaN, keeps the limit, makes J v.
class Evaluator {
 public:
  Evaluator(const ResidualRef& residual, const Options& options, Counts& counts, Vector& probe)
      : residual_(residual), options_(options), counts_(counts), probe_(probe) {}

  /// F at `point.u` into `point`, counted under `purpose`.
  Outcome evaluate(Iterate& point, int Counts::*purpose);

  /// F at the first u; fixes the default reference norm.
  Outcome evaluate_start(Iterate& point);

  /// Prepares `action` about `base`, which must outlive it.
  Outcome linearise(const Iterate& base);

  /// J v about the last linearised point.
  Outcome action(const Vector& v, Vector& Jv);

  /// The inner product of the problem.
  [[nodiscard]] const InnerProductRef& product() const { return residual_.inner_product(); }

  /// max(absolute, relative * reference) at a point.
  [[nodiscard]] double tolerance(const Iterate& point) const;

  /// Whether `point`, reached by a step of the given norm (negative: by none), ends the solve.
  [[nodiscard]] bool converged(const Iterate& point, double step_norm) const;

  /// Whether the last refusal was the evaluation limit.
  [[nodiscard]] bool limit_reached() const { return counts_.total() >= options_.max_evaluations; }

 private:
  Outcome call(const Vector& u, Vector& r);
  Outcome difference(const Vector& v, Vector& Jv);
  [[nodiscard]] double difference_step(double v_norm) const;

  const ResidualRef& residual_;
  const Options& options_;
  Counts& counts_;
  Vector& probe_;
  const Iterate* base_ = nullptr;
  double base_u_norm_ = 0.0;
  double start_norm_ = 0.0;
};

}  // namespace jfnk::detail
