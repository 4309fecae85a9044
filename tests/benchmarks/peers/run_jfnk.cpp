// Every problem by libjfnk as it comes: default options, tolerance and scales of the problem.
#include <string>

#include "jfnk/jfnk.hpp"
#include "trial.hpp"

namespace {

struct Factors {
  const peers::Trial* trial;
  void apply(const jfnk::Vector& r, jfnk::Vector& z) const { trial->precondition(r, z); }
};

std::string purposes(const jfnk::Report& report) {
  const jfnk::Counts& c = report.counts;
  std::string text = std::to_string(c.multisecant) + " multisecant, " +
                     std::to_string(c.difference_actions) + " actions, " +
                     std::to_string(c.newton_trials + c.line_search) + " trials";
  if (c.pseudo_transient > 0) {
    text += ", " + std::to_string(c.pseudo_transient) + " pseudo-transient";
  }
  if (c.learning > 0) text += ", " + std::to_string(c.learning) + " to learn";
  if (c.noise > 0) text += ", " + std::to_string(c.noise) + " noise";
  if (!report.converged()) text += ": " + std::string(jfnk::to_string(report.status));
  return text;
}

jfnk::Report solve(peers::Trial& trial, jfnk::Vector& u, const jfnk::Options& options) {
  const auto residual = [&](const jfnk::Vector& v, jfnk::Vector& r) {
    return trial.evaluate(v, r);
  };
  if (trial.preconditioned()) return jfnk::solve(residual, u, options, Factors{&trial});
  return jfnk::solve(residual, u, options);
}

}  // namespace

int main(int argc, char** argv) {
  const auto solve_by_default = [](peers::Trial& trial) {
    jfnk::Options options;
    options.tolerances.relative = trial.problem().tolerance;
    options.max_evaluations = peers::max_evaluations;
    options.u_scale = trial.problem().u_scale;
    options.f_scale = trial.problem().f_scale;
    jfnk::Vector u = trial.problem().start;
    const jfnk::Report report = solve(trial, u, options);
    // F / f_scale is formed in another order here and there: a few rounding units of grace.
    const bool solved = report.converged() && trial.norm_at(u) <= trial.goal() * (1.0 + 1e-12);
    return peers::Outcome{report.converged(), solved, trial.evaluations(), purposes(report)};
  };
  peers::run_all(argc > 1 ? argv[1] : "", {{"libjfnk", solve_by_default}});
  return 0;
}
