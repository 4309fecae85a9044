#include "trial.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <stdexcept>

namespace peers {
namespace {

// Exit code of a process that went on asking for evaluations.
constexpr int insatiable = 9;

/// Processor time of this thread [ms]. That of the process is known by ticks only, once it is
/// limited.
double now() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

void print(const Trial& trial, const std::string& name, const Outcome& outcome, double ms) {
  std::printf("%s;%s;%s;%s;%d;%d;%d;%.2f;%s\n", trial.problem().name.c_str(),
              set_of(trial.problem()), trial.preconditioned() ? "factors" : "none", name.c_str(),
              outcome.claimed ? 1 : 0, outcome.solved ? 1 : 0, outcome.evaluations, ms,
              outcome.note.c_str());
  std::fflush(stdout);
}

/// In the process of one solve.
[[noreturn]] void solve_and_exit(Trial trial, const Configuration& configuration) {
  // By processor time, which the load of the machine does not change; a process that sleeps is
  // ended by the clock.
  const rlimit limit{max_seconds, max_seconds + 1};
  setrlimit(RLIMIT_CPU, &limit);
  alarm(20 * max_seconds);
  const Outcome outcome = configuration.solve(trial);
  print(trial, configuration.name, outcome, trial.milliseconds());
  std::_Exit(0);
}

std::string reason_of(int status) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == insatiable) return "ended: goes on for ever";
  if (WIFEXITED(status)) return "ended with code " + std::to_string(WEXITSTATUS(status));
  if (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGALRM) return "ended: takes too long";
  return "ended by signal " + std::to_string(WTERMSIG(status));
}

void run(const Trial& trial, const Configuration& configuration) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("peers: no further process");
  if (child == 0) solve_and_exit(trial, configuration);
  int status = 0;
  if (waitpid(child, &status, 0) != child) throw std::runtime_error("peers: lost a process");
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  print(trial, configuration.name, {false, false, 0, reason_of(status)}, 0.0);
}

}  // namespace

Eigen::MatrixXd difference_jacobian(const Problem& problem, const Vector& u) {
  // For noisy residuals a step that makes more of a difference than their noise.
  const double step = problem.tolerance > 1e-5 ? 1e-3 : 1e-6;
  const Eigen::Index n = u.size();
  Eigen::MatrixXd J(n, n);
  Vector probe = u;
  Vector plus(n);
  Vector minus(n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double unit = problem.u_scale.size() == 0 ? 1.0 : problem.u_scale[j];
    const double h = step * std::max(unit, std::abs(u[j]));
    probe[j] = u[j] + h;
    problem.residual(probe, plus);
    probe[j] = u[j] - h;
    problem.residual(probe, minus);
    probe[j] = u[j];
    J.col(j) = (plus - minus) / (2.0 * h);
  }
  return J;
}

Trial::Trial(const Problem& problem, bool preconditioned) : problem_(&problem) {
  goal_ = problem.tolerance * norm_at(problem.start);
  if (!preconditioned) return;
  factors_ = std::make_shared<Eigen::PartialPivLU<Eigen::MatrixXd>>(
      difference_jacobian(problem, problem.start));
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
  if (evaluations_ == 0) begin_ = now();
  if (exhausted()) {
    if (++refusals_ > max_refusals) std::_Exit(insatiable);
    return false;
  }
  ++evaluations_;
  if (!problem_->residual(u, r) || !r.allFinite()) return false;
  if (met_at_ == 0 && norm(r) <= goal_) met_at_ = evaluations_;
  return true;
}

double Trial::milliseconds() const {
  return now() - begin_;
}

void Trial::precondition(const Vector& r, Vector& z) const {
  z = factors_->solve(r);
}

void run_all(const std::string& filter, const std::vector<Configuration>& configurations) {
  const std::vector<Problem> problems = all_problems();
  for (const bool preconditioned : {false, true}) {
    for (const Problem& problem : problems) {
      if (problem.name.find(filter) == std::string::npos) continue;
      const Trial fresh(problem, preconditioned);
      for (const Configuration& configuration : configurations) {
        if (configuration.needs_preconditioner && !preconditioned) continue;
        run(fresh, configuration);
      }
    }
  }
}

}  // namespace peers
