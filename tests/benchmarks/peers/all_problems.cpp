#include <cmath>
#include <cstdlib>
#include <random>

#include "problem.hpp"

namespace peers {
namespace {

// Far more than rounding, far less than what makes another problem of it.
constexpr double perturbation = 1e-3;

/// Moves every unknown of the start by up to 1e-3 of its size, or of its typical size where it is
/// small. A start that is out of the domain then stays as it was.
void perturb(Problem& problem, std::mt19937& random) {
  Vector start = problem.start;
  for (Eigen::Index i = 0; i < start.size(); ++i) {
    const double part = 2.0 * static_cast<double>(random()) / std::mt19937::max() - 1.0;
    const double unit = problem.u_scale.size() == 0 ? 1.0 : problem.u_scale[i];
    start[i] += perturbation * part * std::max(unit, std::abs(start[i]));
  }
  Vector r = Vector::Zero(start.size());
  if (problem.residual(start, r) && r.allFinite()) problem.start = start;
}

}  // namespace

std::vector<Problem> all_problems() {
  std::vector<Problem> problems;
  add_grids(problems);
  add_classics(problems);
  add_troubles(problems);
  add_second_set(problems);
  add_third_set(problems);
  add_fourth_set(problems);
  add_fifth_set(problems);
  const char* seed = std::getenv("PEERS_SEED");
  if (seed == nullptr || *seed == '\0') return problems;
  std::mt19937 random(static_cast<std::mt19937::result_type>(std::strtoul(seed, nullptr, 10)));
  for (Problem& problem : problems) perturb(problem, random);
  return problems;
}

}  // namespace peers
