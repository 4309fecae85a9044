// usage: jfnk-peers-roots [NAME]
//
// Whether the problems of all sets but the first have a root to be found at all: each with NAME in
// its name by Newton steps with a dense Jacobian, damped and full, which share nothing with the
// solvers compared. Prints ||F|| over the goal; exit code 1 if one is above it.
#include <Eigen/LU>
#include <cstdio>
#include <limits>

#include "trial.hpp"

namespace {

using peers::Problem;
using peers::Vector;

/// The lowest ||F|| over the goal on the way.
double newton(const Problem& problem, bool damped) {
  constexpr int most_steps = 60;
  constexpr double shortest = 1e-6;
  const peers::Trial trial(problem, false);
  Vector u = problem.start;
  Vector r(u.size());
  double lowest = std::numeric_limits<double>::infinity();
  for (int step = 0; step < most_steps && lowest > trial.goal(); ++step) {
    problem.residual(u, r);
    const Vector du = -difference_jacobian(problem, u).partialPivLu().solve(r);
    double length = 1.0;
    while (damped && length > shortest &&
           !(trial.norm_at(u + length * du) <= (1.0 - 1e-4 * length) * trial.norm_at(u))) {
      length *= 0.5;
    }
    u += length * du;
    lowest = std::min(lowest, trial.norm_at(u));
  }
  return lowest / trial.goal();
}

double distance_to_goal(const Problem& problem) {
  const peers::Trial trial(problem, false);
  if (problem.root.size() > 0) return trial.norm_at(problem.root) / trial.goal();
  const double damped = newton(problem, true);
  return damped <= 1.0 ? damped : newton(problem, false);
}

}  // namespace

int main(int argc, char** argv) {
  bool all_solved = true;
  for (const Problem& problem : peers::all_problems()) {
    if (problem.set == 1 || problem.name.find(argc > 1 ? argv[1] : "") == std::string::npos) {
      continue;
    }
    const double distance = distance_to_goal(problem);
    std::printf("%s: %d unknowns, %.1e of the goal\n", problem.name.c_str(),
                static_cast<int>(problem.start.size()), distance);
    std::fflush(stdout);
    all_solved = all_solved && distance <= 1.0;
  }
  return all_solved ? 0 : 1;
}
