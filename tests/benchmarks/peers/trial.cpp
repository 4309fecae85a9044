#include "trial.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace peers {

Trial::Trial(const Problem& problem, bool preconditioned) : problem_(&problem) {
  goal_ = problem.tolerance * norm_at(problem.start);
  if (preconditioned) factorise();
}

double Trial::norm(const Vector& r) const {
  const Vector& scale = problem_->f_scale;
  return scale.size() == 0 ? r.norm() : r.cwiseQuotient(scale).norm();
}

double Trial::norm_at(const Vector& u) const {
  Vector r = Vector::Zero(u.size());
  const bool valid = u.allFinite() && problem_->residual(u, r) && r.allFinite();
  return valid ? norm(r) : std::numeric_limits<double>::infinity();
}

bool Trial::evaluate(const Vector& u, Vector& r) {
  if (exhausted()) return false;
  ++evaluations_;
  if (!problem_->residual(u, r) || !r.allFinite()) return false;
  if (met_at_ == 0 && norm(r) <= goal_) met_at_ = evaluations_;
  return true;
}

void Trial::precondition(const Vector& r, Vector& z) const {
  z = factors_->solve(r);
}

void Trial::factorise() {
  const Vector& u = problem_->start;
  const Eigen::Index n = u.size();
  Eigen::MatrixXd J(n, n);
  Vector probe = u;
  Vector plus(n);
  Vector minus(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double unit = problem_->u_scale.size() == 0 ? 1.0 : problem_->u_scale[j];
    const double h = (problem_->tolerance > 1e-5 ? 1e-3 : 1e-6) * std::max(unit, std::abs(u[j]));
    probe[j] = u[j] + h;
    problem_->residual(probe, plus);
    probe[j] = u[j] - h;
    problem_->residual(probe, minus);
    probe[j] = u[j];
    J.col(j) = (plus - minus) / (2.0 * h);
  }
  factors_ = std::make_shared<Eigen::PartialPivLU<Eigen::MatrixXd>>(J);
}

void print_result(const Trial& trial, const std::string& solver, bool claimed, bool solved,
                  int evaluations, const std::string& note) {
  std::printf("%s;%s;%s;%s;%d;%d;%d;%s\n", trial.problem().name.c_str(),
              trial.problem().for_tuning ? "tuning" : "held out",
              trial.preconditioned() ? "factors" : "none", solver.c_str(), claimed ? 1 : 0,
              solved ? 1 : 0, evaluations, note.c_str());
  std::fflush(stdout);
}

void run_all(const std::string& filter, const std::function<void(const Trial&)>& solve) {
  const std::vector<Problem> problems = all_problems();
  for (const bool preconditioned : {false, true}) {
    for (const Problem& problem : problems) {
      if (problem.name.find(filter) != std::string::npos) solve(Trial(problem, preconditioned));
    }
  }
}

}  // namespace peers
