#pragma once

#include <Eigen/LU>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "problem.hpp"

namespace peers {

/// Most evaluations a solver may spend on a problem.
inline constexpr int max_evaluations = 20000;
/// Evaluations that are refused after that before the process of the solver is ended.
inline constexpr int max_refusals = 1000;
/// Processor time after which it is ended as well [s].
inline constexpr int max_seconds = 60;

/// The Jacobian at u by central differences, not counted.
Eigen::MatrixXd difference_jacobian(const Problem& problem, const Vector& u);

/// A problem seen through a counter, with the LU factors of the Jacobian at the start as a
/// preconditioner that is never refreshed.
class Trial {
 public:
  /// Copies share the factors.
  Trial(const Problem& problem, bool preconditioned);

  [[nodiscard]] const Problem& problem() const { return *problem_; }
  [[nodiscard]] bool preconditioned() const { return factors_ != nullptr; }
  [[nodiscard]] Eigen::Index size() const { return problem_->start.size(); }
  /// ||F / f_scale|| that counts as solved.
  [[nodiscard]] double goal() const { return goal_; }

  /// Counted evaluation; false out of the domain, at a NaN, and when no evaluation is left. Who
  /// goes on asking then is ended: it would never stop by itself.
  bool evaluate(const Vector& u, Vector& r);
  /// z = J(start)^-1 r.
  void precondition(const Vector& r, Vector& z) const;
  /// Norm of F / f_scale at u, not counted; infinite where F has no value.
  [[nodiscard]] double norm_at(const Vector& u) const;

  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Evaluations up to the first one that met the goal, wherever it was made; 0 if none did. This
  /// is what a peer is credited with, so that no stopping rule of its own counts against it.
  [[nodiscard]] int met_at() const { return met_at_; }
  /// Processor time since the first evaluation.
  [[nodiscard]] double milliseconds() const;
  [[nodiscard]] bool exhausted() const { return evaluations_ >= max_evaluations; }

 private:
  [[nodiscard]] double norm(const Vector& r) const;

  const Problem* problem_;
  double goal_ = 0.0;
  int evaluations_ = 0;
  int met_at_ = 0;
  int refusals_ = 0;
  double begin_ = 0.0;
  std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXd>> factors_;
};

/// What came of one solve.
struct Outcome {
  bool claimed = false;  ///< the solver says that it succeeded
  bool solved = false;   ///< the goal was met
  int evaluations = 0;
  std::string note = {};
};

/// One way in which a solver is run.
struct Configuration {
  std::string name;
  std::function<Outcome(Trial&)> solve;
  /// Not run without a preconditioner.
  bool needs_preconditioner = false;
};

/// Solves every problem with `filter` in its name, without and with preconditioner, by every
/// configuration, and prints each outcome as a line of fields separated by semicolons:
///
///   problem; set; preconditioner; configuration; claimed; solved; evaluations; milliseconds; note
///
/// Each solve has a process of its own, so that one that hangs, crashes or never ends is a failure
/// of that solve alone.
void run_all(const std::string& filter, const std::vector<Configuration>& configurations);

}  // namespace peers
