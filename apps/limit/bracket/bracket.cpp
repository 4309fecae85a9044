#include "limit/bracket/bracket.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "limit/mesh/bisection.hpp"
#include "limit/problem/rigid_corners.hpp"
#include "limit/programme/lower_bound.hpp"
#include "limit/programme/upper_bound.hpp"

namespace limit::bracket {

namespace {

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// Much more than what rounding does to sums of some thousand terms, much less than a bracket.
constexpr double rounding = 1e-10;

// Shear strain rate in a triangle, which the equations' multipliers imply, times its strength.
std::vector<double> flow_indicators(const problem::Problem& problem,
                                    const programme::ConeProgram& program,
                                    const solver::ConeSolution& solution) {
  const Eigen::VectorXd strain = program.equations.transpose() * solution.multipliers;
  std::vector<double> indicators(problem.mesh.triangles.size(), 0.0);
  for (std::size_t k = 0; k < 3 * indicators.size(); ++k) {
    const auto shear = strain.segment<2>(static_cast<Eigen::Index>(3 * k + 1)).norm();
    if (std::isfinite(shear)) indicators[k / 3] += program.cones[k].scale * shear;
  }
  return indicators;
}

// In the order in which they are tried.
std::vector<solver::ConeForm> forms_of(bool is_lower, Engine engine) {
  std::vector<solver::ConeForm> forms =
      is_lower ? std::vector{solver::ConeForm::inequality, solver::ConeForm::quadratic,
                             solver::ConeForm::barrier}
               : std::vector{solver::ConeForm::barrier};
  forms.insert(engine == Engine::ipopt ? forms.end() : forms.begin(), solver::ConeForm::cones);
  return forms;
}

/// One side of the bracket: its mesh, and what refining it has brought.
class Side {
 public:
  Side(problem::Problem problem, bool is_lower)
      : problem_(std::move(problem)), is_lower_(is_lower) {}

  [[nodiscard]] int triangles() const { return static_cast<int>(problem_.mesh.triangles.size()); }
  /// Relative gain per second of the last attempt; infinite as long as it is not known.
  [[nodiscard]] double promise() const { return promise_; }
  [[nodiscard]] bool can_refine() const { return !indicators_.empty(); }

  void refine() {
    constexpr double share = 0.7;
    problem_.mesh = mesh::bisected(problem_.mesh, mesh::largest(indicators_, share));
  }

  void attempt(Bracket& bracket, const BracketOptions& options,
               const std::function<void(const Attempt&)>& watch) {
    const std::optional<double> before = best(bracket);
    const double began = processor_seconds();
    const programme::ConeProgram program = is_lower_ ? programme::lower_bound_program(problem_)
                                                     : programme::upper_bound_program(problem_);
    const std::vector<solver::ConeForm> forms = forms_of(is_lower_, options.engine);
    for (const solver::ConeForm form : forms) {
      solver::SolverOptions solver;
      solver.form = form;
      solver.max_iterations = options.max_iterations;
      solver.max_seconds = std::max(1.0, options.max_seconds);
      const double start = processor_seconds();
      const solver::ConeSolution solution = solver::solve(program, solver);
      Attempt attempt{is_lower_,        triangles(),         form, solution.status,
                      solution.message, solution.iterations, 0.0,  std::nullopt};
      if (solution.variables.allFinite() && solution.multipliers.allFinite()) {
        certify(bracket, attempt, solution);
        if (form == forms.front() || attempt.certified) {
          indicators_ = flow_indicators(problem_, program, solution);
        }
      }
      attempt.seconds = processor_seconds() - start;
      bracket.attempts.push_back(attempt);
      if (watch) watch(attempt);
      if (is_good(attempt, before) || solution.status == solver::SolverStatus::timed_out) break;
    }
    const std::optional<double> after = best(bracket);
    const double seconds = std::max(1e-3, processor_seconds() - began);
    if (before && after) promise_ = std::abs(*after / *before - 1.0) / seconds;
  }

 private:
  // A bisected mesh holds every field of the mesh before: its optimum cannot be worse.
  [[nodiscard]] bool is_good(const Attempt& attempt, const std::optional<double>& before) const {
    if (!attempt.certified) return false;
    if (attempt.status != solver::SolverStatus::solved &&
        attempt.status != solver::SolverStatus::acceptable) {
      return false;
    }
    constexpr double tolerance = 1e-3;  // the solver's, with room
    const double worse = is_lower_ ? -tolerance : tolerance;
    return !before || (is_lower_ ? *attempt.certified >= *before + worse * std::abs(*before)
                                 : *attempt.certified <= *before + worse * std::abs(*before));
  }

  [[nodiscard]] std::optional<double> best(const Bracket& bracket) const {
    if (is_lower_ && bracket.lower) return bracket.lower->certificate.multiplier;
    if (!is_lower_ && bracket.upper) return bracket.upper->certificate.multiplier;
    return std::nullopt;
  }

  void certify(Bracket& bracket, Attempt& attempt, const solver::ConeSolution& solution) {
    if (is_lower_) {
      certificate::LowerCertificate certificate = certificate::certify_lower(
          problem_, programme::stress_field(problem_, solution.variables),
          solution.variables[solution.variables.size() - 1]);
      if (!certificate.holds) return;
      attempt.certified = certificate.multiplier;
      if (!bracket.lower || certificate.multiplier > bracket.lower->certificate.multiplier) {
        bracket.lower = {problem_.mesh, attempt, std::move(certificate)};
      }
    } else {
      const problem::VelocityField proposed =
          programme::velocity_field(problem_, solution.multipliers);
      const problem::VelocityField dilating =
          solution.interior_multipliers.size() > 0
              ? programme::velocity_field(problem_, solution.interior_multipliers)
              : proposed;
      certificate::UpperCertificate certificate =
          certificate::certify_upper(problem_, proposed, dilating);
      if (!certificate.holds) return;
      attempt.certified = certificate.multiplier;
      if (!bracket.upper || certificate.multiplier < bracket.upper->certificate.multiplier) {
        bracket.upper = {problem_.mesh, attempt, std::move(certificate)};
      }
    }
  }

  problem::Problem problem_;
  bool is_lower_;
  std::vector<double> indicators_;
  double promise_ = std::numeric_limits<double>::infinity();
};

}  // namespace

double Bracket::lower_bound() const {
  const double bound = lower.value().certificate.multiplier;
  return bound - rounding * std::abs(bound);
}

double Bracket::upper_bound() const {
  const double bound = upper.value().certificate.multiplier;
  return bound + rounding * std::abs(bound);
}

double Bracket::gap() const {
  if (!lower || !upper) return std::numeric_limits<double>::infinity();
  const double mean = (lower_bound() + upper_bound()) / 2.0;
  return mean > 0.0 ? (upper_bound() - lower_bound()) / mean
                    : std::numeric_limits<double>::infinity();
}

Bracket bracket(problem::Problem lower, problem::Problem upper, const BracketOptions& options,
                const std::function<void(const Attempt&)>& watch) {
  const double began = processor_seconds();
  const auto spent = [&] { return processor_seconds() - began; };
  const auto remaining = [&] {
    BracketOptions rest = options;
    rest.max_seconds = options.max_seconds - spent();
    return rest;
  };
  Bracket result;
  Side below(std::move(lower), true),
      above(problem::with_rigid_corners_cut(std::move(upper)), false);
  below.attempt(result, remaining(), watch);
  above.attempt(result, remaining(), watch);
  while (result.gap() > options.gap && spent() < options.max_seconds) {
    std::vector<Side*> sides;
    for (Side* side : {&below, &above}) {
      if (side->can_refine() && side->triangles() < options.max_triangles) sides.push_back(side);
    }
    if (sides.empty()) break;
    Side& next = **std::max_element(sides.begin(), sides.end(),
                                    [](Side* a, Side* b) { return a->promise() < b->promise(); });
    next.refine();
    next.attempt(result, remaining(), watch);
  }
  result.reached = result.gap() <= options.gap;
  return result;
}

Bracket bracket(const problem::Case& problem, const BracketOptions& options,
                const std::function<void(const Attempt&)>& watch) {
  return bracket(in_units(problem.lower, problem.units), in_units(problem.upper, problem.units),
                 options, watch);
}

}  // namespace limit::bracket
