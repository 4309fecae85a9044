#pragma once

#include <Eigen/LU>
#include <memory>

#include "problem.hpp"

namespace peers {

/// Most evaluations a solver may spend on a problem.
inline constexpr int max_evaluations = 20000;

/// A problem seen through a counter, with the LU factors of the Jacobian at the start (by
/// differences, not counted) as a preconditioner that is never refreshed.
class Trial {
 public:
  /// Copies share the factors.
  Trial(const Problem& problem, bool preconditioned);

  [[nodiscard]] const Problem& problem() const { return *problem_; }
  [[nodiscard]] bool preconditioned() const { return factors_ != nullptr; }
  [[nodiscard]] Eigen::Index size() const { return problem_->start.size(); }
  /// ||F / f_scale|| that counts as solved.
  [[nodiscard]] double goal() const { return goal_; }

  /// Counted evaluation; false out of the domain, at a NaN, and when no evaluation is left.
  bool evaluate(const Vector& u, Vector& r);
  /// z = J(start)^-1 r.
  void precondition(const Vector& r, Vector& z) const;
  /// Norm of F / f_scale at u, not counted; infinite where F has no value.
  [[nodiscard]] double norm_at(const Vector& u) const;

  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Evaluations up to the first one that met the goal, wherever it was made; 0 if none did. This
  /// is what a peer is credited with, so that no stopping rule of its own counts against it.
  [[nodiscard]] int met_at() const { return met_at_; }
  [[nodiscard]] bool exhausted() const { return evaluations_ >= max_evaluations; }

 private:
  [[nodiscard]] double norm(const Vector& r) const;
  void factorise();

  const Problem* problem_;
  double goal_ = 0.0;
  int evaluations_ = 0;
  int met_at_ = 0;
  std::shared_ptr<const Eigen::PartialPivLU<Eigen::MatrixXd>> factors_;
};

/// Prints one result as a line of fields separated by semicolons.
void print_result(const Trial& trial, const std::string& solver, bool claimed, bool solved,
                  int evaluations, const std::string& note);

/// Calls `solve` with a fresh trial of every problem, without and with preconditioner; `filter` is
/// a part of the names of those to run.
void run_all(const std::string& filter, const std::function<void(const Trial&)>& solve);

}  // namespace peers
