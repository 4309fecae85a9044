#pragma once

#include "jfnk/options.hpp"
#include "jfnk/preconditioner.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"
#include "learnt_jacobian.hpp"

namespace jfnk::detail {

/// What came of an evaluation, seen from the strategy.
enum class Outcome {
  ok,
  out_of_domain,
  stopped,  ///< the residual asked to stop
  limit     ///< max_evaluations is used up; nothing was evaluated
};

/// A point with its residual, both in the solver's units: u / u_scale and F / f_scale.
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

/// Memory of the evaluator that lives from solve to solve.
struct EvaluatorVectors {
  Vector probe;     // u + eps v
  Vector physical;  // u in the caller's units, if there are scales
  Vector image;     // a vector handed to or from the caller, likewise
  LearntJacobian learnt;
};

/// The part of the evaluator that a resumed solve needs.
struct EvaluatorState {
  double start_norm = 0.0;
  double noise = 0.0;  ///< b of the difference step in force
  bool without_preconditioner = false;
  bool learnt = false;  ///< the learnt Jacobian stands in for the preconditioner
};

/// The only door to the residual and the preconditioner: changes units, counts, checks for NaN and
/// bounds, keeps the limit, makes J v.
class Evaluator {
 public:
  Evaluator(const ResidualRef& residual, const PreconditionerRef& preconditioner,
            const Options& options, Counts& counts, EvaluatorVectors& vectors,
            EvaluatorState& state)
      : residual_(residual),
        preconditioner_(preconditioner),
        options_(options),
        counts_(counts),
        vectors_(vectors),
        state_(state),
        learnt_(vectors.learnt) {}

  /// F at `point.u` into `point`, counted under `purpose`.
  Outcome evaluate(Iterate& point, int Counts::*purpose);

  /// F at the first u; fixes the default reference norm.
  Outcome evaluate_start(Iterate& point);

  /// Prepares `action` about `base`, which must outlive it.
  Outcome linearise(const Iterate& base);

  /// J v about the last linearised point.
  Outcome action(const Vector& v, Vector& Jv);

  /// z = P r.
  void precondition(const Vector& r, Vector& z);

  /// Lets the preconditioner rebuild itself about u.
  void setup(const Vector& u);

  /// Tells the residual that u is the solver's own.
  void accept(const Vector& u);

  /// Lets the residual change the step from u, and keeps it within the bounds.
  void filter(const Vector& u, Vector& step);

  /// Whether u, in the solver's units, is between the bounds.
  [[nodiscard]] bool within_bounds(const Vector& u);

  /// u in the caller's units.
  [[nodiscard]] const Vector& physical(const Vector& u);
  /// The caller's u in the solver's units.
  void to_solver_units(Vector& u) const;

  [[nodiscard]] const ResidualRef& residual() const { return residual_; }
  /// The preconditioner in use, the caller's or the learnt one; the identity if it was dropped.
  [[nodiscard]] const PreconditionerRef& preconditioner() const {
    if (state_.without_preconditioner) return identity_;
    return state_.learnt ? learnt_ : preconditioner_;
  }
  /// Whether it is the learnt one.
  [[nodiscard]] bool preconditioned_by_learning() const {
    return state_.learnt && !state_.without_preconditioner;
  }
  /// Whether the caller's preconditioner has a `setup`.
  [[nodiscard]] bool caller_can_set_up() const { return preconditioner_.has_setup(); }
  /// Goes on without the preconditioner.
  void drop_preconditioner() { state_.without_preconditioner = true; }
  /// Takes a dropped one up again.
  void resume_preconditioner() { state_.without_preconditioner = false; }
  /// The inner product of the problem.
  [[nodiscard]] const InnerProductRef& product() const { return residual_.inner_product(); }

  /// max(absolute, relative * reference) at a point.
  [[nodiscard]] double tolerance(const Iterate& point) const;

  /// Whether `point`, reached by a step of the given norm (negative: by none), ends the solve.
  [[nodiscard]] bool converged(const Iterate& point, double step_norm) const;

  /// Whether the last refusal was the evaluation limit.
  [[nodiscard]] bool limit_reached() const { return counts_.total() >= options_.max_evaluations; }

  /// Whether the residual itself declared the last point out of its domain; r need not be written.
  [[nodiscard]] bool refused() const { return refused_; }

  /// Whether J v comes from differences.
  [[nodiscard]] bool differences() const {
    return options_.jacobian.source != Jacobian::Source::user_if_available ||
           !residual_.has_jacobian();
  }

 private:
  /// F(u) into r, which arrives full of NaN: what F forgets to write is never taken for a value.
  Outcome call(const Vector& u, Vector& r);
  Outcome difference(const Vector& v, Vector& Jv);
  [[nodiscard]] double difference_step(double v_norm) const;
  [[nodiscard]] bool u_scaled() const { return options_.u_scale.size() > 0; }
  [[nodiscard]] bool f_scaled() const { return options_.f_scale.size() > 0; }

  const ResidualRef& residual_;
  const PreconditionerRef& preconditioner_;
  const PreconditionerRef identity_;
  const Options& options_;
  Counts& counts_;
  EvaluatorVectors& vectors_;
  EvaluatorState& state_;
  const PreconditionerRef learnt_;
  const Iterate* base_ = nullptr;
  double base_u_norm_ = 0.0;
  bool refused_ = false;
};

/// The preconditioner in the solver's units, counted.
struct CountedPreconditioner {
  Evaluator* evaluator;
  void apply(const Vector& r, Vector& z) const { evaluator->precondition(r, z); }
  /// A view of this; the identity if there is no preconditioner.
  [[nodiscard]] PreconditionerRef ref() {
    return evaluator->preconditioner().is_identity() ? PreconditionerRef{}
                                                     : PreconditionerRef(*this);
  }
};

}  // namespace jfnk::detail
