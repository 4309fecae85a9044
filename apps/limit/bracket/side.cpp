#include "limit/bracket/side.hpp"

#include <algorithm>
#include <cmath>

#include "limit/mesh/bisection.hpp"
#include "limit/problem/rigid_corners.hpp"
#include "limit/programme/lower_bound.hpp"
#include "limit/programme/upper_bound.hpp"

namespace limit::bracket {

namespace {

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
  for (const auto& [own, twin] : program.twins) {
    if (own >= 3 * indicators.size()) continue;
    const auto shear = strain.segment<2>(static_cast<Eigen::Index>(3 * twin + 1)).norm();
    if (std::isfinite(shear)) indicators[own / 3] += program.cones[own].scale * shear;
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

}  // namespace

Side::Side(problem::Problem problem, bool is_lower, Means means)
    : problem_(is_lower ? std::move(problem) : problem::with_rigid_corners_cut(std::move(problem))),
      is_lower_(is_lower),
      means_(std::move(means)) {}

void Side::set_soils(const std::vector<problem::Soil>& soils) {
  problem_.soils = soils;
  if (is_lower_) return;
  const int before = triangles();
  problem_ = problem::with_rigid_corners_cut(std::move(problem_));
  if (triangles() != before) indicators_.clear();
}

void Side::refine(double growth) {
  constexpr double share = 0.7;
  problem_.mesh = mesh::refined(std::move(problem_.mesh), indicators_, share, growth);
}

void Side::attempt(Bracket& bracket, const BracketOptions& options,
                   const std::function<void(const Attempt&)>& watch) {
  const std::optional<double> before = best(bracket);
  const double began = means_.seconds();
  std::vector<solver::ConeForm> forms = forms_of(is_lower_, options.engine);
  std::erase_if(forms, [&](solver::ConeForm form) {
    return std::find(given_up_.begin(), given_up_.end(), form) != given_up_.end();
  });
  // Stresses that bear no tension lie in no cone's inside at free faces, which Ipopt's forms want.
  const bool bears_none = std::ranges::any_of(problem_.soils, [](const problem::Soil& soil) {
    return soil.tension == 0.0 || soil.is_loose();
  });
  if (is_lower_ && bears_none && options.engine != Engine::ipopt) forms.resize(1);
  ++failures_;
  work_ = 0.0;
  for (const solver::ConeForm form : forms) {
    BracketOptions rest = options;
    rest.max_seconds = options.max_seconds - (means_.seconds() - began);
    const bool is_first = form == forms.front();
    if (rest.max_seconds <= 0.0 && !is_first) break;
    const Attempt attempt = ask(form, is_first, bracket, rest, watch);
    if (is_good(attempt, before)) {
      failures_ = 0;
      break;
    }
    if (!is_first) given_up_.push_back(form);
    if (attempt.status == solver::SolverStatus::timed_out || !options.fall_back) break;
  }
  const std::optional<double> after = best(bracket);
  if (before && after) promise_ = std::abs(*after / *before - 1.0) / std::max(1.0, work_);
}

Attempt Side::ask(solver::ConeForm form, bool is_first, Bracket& bracket,
                  const BracketOptions& options, const std::function<void(const Attempt&)>& watch) {
  const double began = means_.seconds();
  // At first parabolas know nothing but where to look, and roughly is enough; afterwards what one
  // mesh has shown does for the next.
  int rounds = is_new_ ? 2 : 1;
  constexpr double roughly = 1e-2;
  for (int round = 1;; ++round) {
    const programme::ConeProgram program =
        is_lower_ ? programme::lower_bound_program(problem_, parabolas_)
                  : programme::upper_bound_program(problem_, parabolas_);
    solver::SolverOptions solver;
    solver.form = form;
    solver.max_iterations = options.max_iterations;
    solver.cone_gap = options.solver_gap;
    if (!program.curved.empty() && round < rounds) {
      solver.cone_gap = std::max(solver.cone_gap, roughly);
    }
    solver.wants_interior = !is_lower_;
    const double start = means_.seconds();
    solver.max_seconds = std::max(1.0, options.max_seconds - (start - began));
    const solver::ConeSolution solution = means_.solve(program, solver);
    Attempt attempt{is_lower_,        triangles(),         form, solution.status,
                    solution.message, solution.iterations, 0.0,  solution.work,
                    std::nullopt};
    attempt.proposed = solution.variables.size() > 0
                           ? solution.variables[solution.variables.size() - 1]
                           : std::numeric_limits<double>::quiet_NaN();
    if (solution.variables.allFinite() && solution.multipliers.allFinite()) {
      certify(bracket, attempt, solution);
      if (is_first || attempt.certified) {
        indicators_ = flow_indicators(problem_, program, solution);
      }
    }
    attempt.seconds = means_.seconds() - start;
    work_ += attempt.work;
    bracket.attempts.push_back(attempt);
    if (watch) watch(attempt);
    const bool is_solved = attempt.status == solver::SolverStatus::solved ||
                           attempt.status == solver::SolverStatus::acceptable;
    if (program.curved.empty()) return attempt;
    if (!is_solved) {
      const bool may_retry = is_new_ && !parabolas_.guesses_least() &&
                             attempt.status != solver::SolverStatus::timed_out &&
                             means_.seconds() - began < options.max_seconds;
      if (!may_retry) return attempt;
      // A guess that was too high leaves no stress in some parabola.
      parabolas_.guess_least();
      ++rounds;
      continue;
    }
    parabolas_.take(program.curved, solution.variables);
    is_new_ = false;
    if (round == rounds || means_.seconds() - began >= options.max_seconds) return attempt;
  }
}

// A bisected mesh holds every field of the mesh before: its optimum cannot be worse.
bool Side::is_good(const Attempt& attempt, const std::optional<double>& before) const {
  if (attempt.status != solver::SolverStatus::solved &&
      attempt.status != solver::SolverStatus::acceptable) {
    return false;
  }
  constexpr double tolerance = 1e-3;  // the solver's, with room
  // No mechanism fails under that much: this is an answer, too.
  const bool has_no_end =
      problem_.most_multiplier && attempt.proposed >= (1.0 - tolerance) * *problem_.most_multiplier;
  if (!attempt.certified) return !is_lower_ && has_no_end;
  const double worse = is_lower_ ? -tolerance : tolerance;
  return !before || (is_lower_ ? *attempt.certified >= *before + worse * std::abs(*before)
                               : *attempt.certified <= *before + worse * std::abs(*before));
}

std::optional<double> Side::best(const Bracket& bracket) const {
  if (is_lower_ && bracket.lower) return bracket.lower->certificate.multiplier;
  if (!is_lower_ && bracket.upper) return bracket.upper->certificate.multiplier;
  return std::nullopt;
}

void Side::certify(Bracket& bracket, Attempt& attempt, const solver::ConeSolution& solution) {
  if (is_lower_) {
    certificate::LowerCertificate certificate =
        certificate::certify_lower(problem_, programme::stress_field(problem_, solution.variables),
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

}  // namespace limit::bracket
