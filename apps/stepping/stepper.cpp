#include "stepping/stepper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equilibrium/equilibrium.hpp"
#include "equilibrium/preconditioner.hpp"
#include "jfnk/gmres.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"
#include "stepping/corrected_load.hpp"
#include "stepping/re_search.hpp"
#include "stepping/solver_setup.hpp"

namespace stepping {
namespace {

// A step that ends this close to the end of the programme ends at it.
constexpr double end_slack = 1e-9;

// Secant pairs that a step hands on to the next. Measured: 8 and 15 serve no better.
constexpr int kept_pairs = 10;

}  // namespace

template <int Dim>
LoadStepper<Dim>::LoadStepper(const scene::Scene& scene, const model::Model<Dim>& model,
                              model::State<Dim>& state,
                              std::optional<equilibrium::InitialBalance<Dim>> rest)
    : scene_(scene),
      model_(model),
      state_(state),
      rounding_(rounding_of_forces(scene, model)),
      equilibrium_(std::make_unique<equilibrium::Equilibrium<Dim>>(model, state, std::move(rest))),
      preconditioner_(std::make_unique<equilibrium::Preconditioner<Dim>>(
          preconditioner_for(scene, model, *equilibrium_))),
      use_preconditioner_(scene::resolve_solver(scene).preconditioner !=
                          scene::PreconditionerKind::none),
      solver_(solver_options(scene, rounding_)),
      nominal_increment_(1.0 / static_cast<double>(scene::nominal_steps(scene))),
      patience_(scene.programme.patience, nominal_increment_, state.programme.progress),
      increment_(model.unknowns()) {
  if (state_.programme.next_increment <= 0.0) state_.programme.next_increment = nominal_increment_;
}

template <int Dim>
LoadStepper<Dim>::~LoadStepper() = default;

template <int Dim>
std::vector<model::MemoryPart> LoadStepper<Dim>::memory(bool to_come) const {
  // As many as a Newton step of a hard step needs: 15 in the mean on the footing, up to 40.
  constexpr int krylov_vectors = 20;
  std::vector<model::MemoryPart> parts = equilibrium_->memory(to_come);
  parts.push_back({"preconditioner", preconditioner_->bytes()});
  const Eigen::Index n = model_.unknowns();
  std::size_t vectors = solver_.bytes() + linear_solve_.bytes();
  if (to_come) {
    vectors = solves_linearly() ? LinearSolve<Dim>::bytes_to_come(n, use_preconditioner_)
                                : solver_.bytes_to_come(n, use_preconditioner_, krylov_vectors);
  }
  parts.push_back({"solver's vectors", vectors});
  if (to_come && hands_on_pairs()) {
    const auto numbers =
        std::max<Eigen::Index>(2 * kept_pairs * n - 2 * state_.secant_step.size(), 0);
    parts.push_back(
        {"secant pairs of the state", static_cast<std::size_t>(numbers) * sizeof(float)});
  }
  return parts;
}

template <int Dim>
bool LoadStepper<Dim>::begin_stage() {
  model::ProgrammeState& programme = state_.programme;
  const scene::Course& course = scene_.course;
  programme.stage = static_cast<std::int64_t>(course.stage);
  programme.progress = 0.0;
  programme.load = course.load_begin;
  programme.next_increment = nominal_increment_;
  // The last step led elsewhere: the first one is foreseen by the tangent.
  programme.last_increment = 0.0;
  programme.easy_steps = 0;
  forget_pairs();
  patience_ = Patience(scene_.programme.patience, nominal_increment_, 0.0);
  if (!state_.layout.staged) return true;
  const auto left = equilibrium_->unbalanced(course.load_begin, course.reduction_begin);
  if (!left) return false;
  state_.unbalanced = *left;
  return true;
}

template <int Dim>
StepRecord LoadStepper<Dim>::at_rest() {
  StepRecord record;
  if (scene_.initial_stress.kind == scene::InitialStressKind::none) return record;
  const scene::Course& course = scene_.course;
  const auto reaction = equilibrium_->reactions_at_rest(course.load_begin, course.reduction_begin);
  // Another plate bears nothing at first.
  if (!reaction || !scene::drives_wall(scene_)) return record;
  record.reaction = *reaction;
  const double width = scene_.drive.width.value_or(0.0);
  if (width > 0.0) record.mean_pressure = record.corrected_pressure = *reaction / width;
  return record;
}

template <int Dim>
bool LoadStepper<Dim>::finished() const {
  return state_.programme.progress >= 1.0;
}

// Without stages the load parameter is the progress.
template <int Dim>
double LoadStepper<Dim>::load_at(double progress) const {
  const scene::Course& course = scene_.course;
  if (progress >= 1.0) return course.load_end;
  return course.load_begin + progress * (course.load_end - course.load_begin);
}

template <int Dim>
void LoadStepper<Dim>::set_prescribed(double increment, Eigen::VectorXd& u) const {
  const double load = increment * (scene_.course.load_end - scene_.course.load_begin);
  for (Eigen::Index k = 0; k < u.size(); ++k) {
    if (model_.prescribed[static_cast<std::size_t>(k)] != 0) u[k] = load * model_.drive[k];
  }
}

// Like the last increment, if there is one.
template <int Dim>
void LoadStepper<Dim>::foresee(double increment) {
  const double last = state_.programme.last_increment;
  if (last > 0.0) {
    increment_ = (increment / last) *
                 Eigen::Map<const Eigen::VectorXd>(state_.increment.data(), model_.unknowns());
  } else {
    increment_.setZero();
  }
  set_prescribed(increment, increment_);
}

// Free unknowns by one linear solve from the converged state: J u_free = -(r(0) + J u_prescribed).
template <int Dim>
bool LoadStepper<Dim>::predict_by_tangent(double increment, Eigen::VectorXd& u,
                                          StepRecord& record) {
  jfnk::GmresOptions options;
  options.relative_tolerance = 1e-2;
  options.max_iterations = 200;
  u.setZero();
  Eigen::VectorXd residual(u.size());
  ++record.residual_evaluations;
  if (!equilibrium_->linearise_before_motion(u, residual)) return false;
  Eigen::VectorXd prescribed = Eigen::VectorXd::Zero(u.size());
  set_prescribed(increment, prescribed);
  Eigen::VectorXd action(u.size());
  equilibrium_->apply_motion(prescribed, action);
  ++record.jacobian_actions;
  const Eigen::VectorXd rhs = -(residual + action);
  if (rhs.norm() <= rounding_) {  // of which a body that is hardly held would make a motion
    u = prescribed;
    return true;
  }
  const auto jacobian = [&](const Eigen::VectorXd& v, Eigen::VectorXd& jv) {
    equilibrium_->apply_jacobian(v, jv);
  };
  const auto result = use_preconditioner_ ? jfnk::gmres(jacobian, rhs, u, options, *preconditioner_)
                                          : jfnk::gmres(jacobian, rhs, u, options);
  record.jacobian_actions += result.iterations;
  u += prescribed;
  return u.allFinite();
}

template <int Dim>
bool LoadStepper<Dim>::solve(Eigen::VectorXd& u, const Watch& watch, StepResult& result) {
  const auto observer = [&](const jfnk::Iteration& i) { return !watch || watch(i); };
  const jfnk::Report& report = use_preconditioner_
                                   ? solver_.solve(*equilibrium_, u, *preconditioner_, observer)
                                   : solver_.solve(*equilibrium_, u, jfnk::Identity{}, observer);
  StepRecord& record = result.record;
  record.newton_iterations += report.newton_iterations;
  record.residual_evaluations += report.counts.residuals();
  record.jacobian_actions += report.counts.user_actions;
  record.residual_ratio = report.residual_norm / std::max(report.reference_norm, 1e-300);
  result.status = report.status;
  if (report.converged()) return true;
  result.trouble = report.trouble;
  result.reason = reason_of(report, scene_, Dim);
  result.folded_particle = equilibrium_->failure().particle;
  result.unbalanced_plate = equilibrium_->failure().plate;
  if (report.status == jfnk::Status::stopped) result.outcome = StepOutcome::stopped;
  return false;
}

// Unless the scene asks for another method than the default one, or for another algorithm.
template <int Dim>
bool LoadStepper<Dim>::solves_linearly() const {
  const scene::SolverSettings settings = scene::resolve_solver(scene_);
  return equilibrium_->is_linear() && settings.method == scene::SolverMethod::hybrid &&
         settings.jacobian == scene::JacobianKind::analytic &&
         scene_.solver.preset != scene::SolverPreset::appendix_a;
}

template <int Dim>
bool LoadStepper<Dim>::solve_linearly(double increment, const Watch& watch, StepResult& result) {
  LinearSolveOptions options;
  options.tolerance = scene::resolve_solver(scene_).tolerance;
  options.rounding = rounding_;
  options.max_actions = scene_.solver.max_evaluations_per_step;
  foresee(increment);
  const auto go_on = [&] { return !watch || watch(jfnk::Iteration{}); };
  const jfnk::PreconditionerRef P =
      use_preconditioner_ ? jfnk::PreconditionerRef(*preconditioner_) : jfnk::PreconditionerRef();
  const LinearSolveResult solve = linear_solve_(*equilibrium_, P, options, increment_, go_on);
  StepRecord& record = result.record;
  record.residual_evaluations += solve.evaluations;
  record.jacobian_actions += solve.actions;
  record.residual_ratio = solve.norm / std::max(solve.reference, 1e-300);
  if (solve.converged) result.status = jfnk::Status::converged;
  if (solve.stopped) {
    result.status = jfnk::Status::stopped;
    result.outcome = StepOutcome::stopped;
  }
  return solve.converged;
}

// What a solve learns of the tangent serves the next step where it is the load that grows. Elastic
// steps are few, and where strength is divided, or rows are rebuilt, the tangent changes too. Under
// tight tolerances the last pairs are of the last digits: they spare nothing, and perturb bodies
// that deform alike everywhere. The paper's algorithm knows nothing of it.
template <int Dim>
bool LoadStepper<Dim>::hands_on_pairs() const {
  constexpr double tightest = 1e-4;
  const scene::Course& course = scene_.course;
  const scene::SolverSettings settings = scene::resolve_solver(scene_);
  return state_.layout.plastic && settings.tolerance >= tightest &&
         settings.method != scene::SolverMethod::newton_krylov &&
         scene_.solver.preset != scene::SolverPreset::appendix_a &&
         course.reduction_begin == course.reduction_end;
}

// A step in which Newton steps had to help out leaves pairs that mislead the next
// (share/doc/decisions/solver.md).
template <int Dim>
void LoadStepper<Dim>::keep_pairs(const StepRecord& record) {
  const bool serve = hands_on_pairs() && record.newton_iterations == 0;
  jfnk::SecantPairs pairs{std::move(state_.secant_step), std::move(state_.secant_change)};
  solver_.pairs(serve ? kept_pairs : 0, pairs);
  state_.secant_step = std::move(pairs.step);
  state_.secant_change = std::move(pairs.change);
}

template <int Dim>
void LoadStepper<Dim>::forget_pairs() {
  state_.secant_step.resize(0, 0);
  state_.secant_change.resize(0, 0);
}

template <int Dim>
StepResult LoadStepper<Dim>::advance(const Watch& watch) {
  const model::ProgrammeState before = state_.programme;
  StepResult result = attempt(watch);
  // What was tried in vain is forgotten: whoever goes on from here tries the same.
  if (result.outcome != StepOutcome::converged) state_.programme = before;
  return result;
}

template <int Dim>
StepResult LoadStepper<Dim>::attempt(const Watch& watch) {
  model::ProgrammeState& programme = state_.programme;
  StepResult result;
  bool linear = solves_linearly();
  for (;;) {
    const double left = 1.0 - programme.progress;
    double increment = std::min(programme.next_increment, left);
    if (left - increment < end_slack) increment = left;
    const double progress = increment == left ? 1.0 : programme.progress + increment;
    equilibrium_->begin_step(load_at(progress), scene_.course.fades * progress,
                             scene::reduction_at(scene_.course, progress));

    bool solved = linear && solve_linearly(increment, watch, result);
    // What that came to is gone on with once; a smaller step would come to no more.
    const bool came_short = linear && !solved && result.outcome != StepOutcome::stopped;
    if (came_short) {
      linear = false;
      solved = increment_.allFinite() && solve(increment_, watch, result);
    }
    // Moving the prescribed unknowns alone would tear the body.
    const bool has_history = programme.last_increment > 0.0;
    if (!solved && !came_short && has_history && result.outcome != StepOutcome::stopped) {
      foresee(increment);
      solver_.begin_with({state_.secant_step, state_.secant_change});
      solved = solve(increment_, watch, result);
    }
    if (!solved && !came_short && result.outcome != StepOutcome::stopped) {
      solved = predict_by_tangent(increment, increment_, result.record) &&
               solve(increment_, watch, result);
    }
    if (solved) {
      keep_pairs(result.record);
      finish_step(increment, result.record);
      return result;
    }
    if (result.outcome == StepOutcome::stopped) return result;
    patience_.attempted();
    if (patience_.lost()) return give_up(StepOutcome::hopeless, result);
    ++result.record.cuts;
    programme.next_increment = 0.5 * increment;
    programme.easy_steps = 0;
    if (programme.next_increment < nominal_increment_ * scene_.programme.minimum_increment_ratio) {
      return give_up(StepOutcome::minimum_increment, result);
    }
  }
}

// Looks once more at the best of the last attempt, for the report.
template <int Dim>
StepResult& LoadStepper<Dim>::give_up(StepOutcome outcome, StepResult& result) {
  result.outcome = outcome;
  result.attempts = patience_.attempts();
  result.patience_mark = patience_.mark();
  result.corrected_load = corrected_load_;
  if (!increment_.allFinite()) return result;
  Eigen::VectorXd residual(increment_.size());
  if ((*equilibrium_)(increment_, residual) != jfnk::Evaluation::ok) return result;
  result.attempt = increment_;
  result.residual = std::move(residual);
  return result;
}

template <int Dim>
void LoadStepper<Dim>::finish_step(double increment, StepRecord& record) {
  model::ProgrammeState& programme = state_.programme;
  const equilibrium::StepForces forces = equilibrium_->commit(increment_);
  // What the curve reports: the side that moves, or else the one that was moved last and is held.
  const std::optional<scene::ActingDrive> reported = scene::reported_drive(scene_);
  const scene::Drive& drive = reported ? *reported->drive : scene_.drive;
  const bool displaced = drive.kind == scene::DriveKind::displacement;
  const double length = displaced ? drive.target : 1.0;
  const bool held = reported && !reported->moves;

  ++programme.step;
  const double former_load = programme.load;
  programme.progress =
      1.0 - programme.progress - increment < end_slack ? 1.0 : programme.progress + increment;
  programme.load = load_at(programme.progress);
  corrected_load_ = corrected_load(programme.load, forces);
  programme.last_increment = increment;
  patience_.attempted();
  patience_.reached(programme.progress);
  programme.hourglass_work += forces.hourglass_work;
  programme.external_work += forces.external_work;

  record.step = programme.step;
  record.load_parameter = programme.load;
  const double place = held ? reported->held : programme.load;
  record.settlement = displaced ? length * place : forces.settlement;
  const double reference = drive.reference_length.value_or(0.0);
  record.settlement_over_B = reference > 0.0 ? record.settlement / reference : 0.0;
  // Without stages the increment itself, to the last bit.
  const bool whole = scene_.course.load_begin == 0.0 && scene_.course.load_end == 1.0;
  record.increment = length * (whole ? increment : programme.load - former_load);
  if (displaced && held) record.increment = 0.0;
  record.reaction = forces.reaction;
  if (const double width = drive.width.value_or(0.0); width > 0.0) {
    record.mean_pressure = forces.reaction / width;
    if (displaced) {
      const double taken = record.increment != 0.0 ? forces.hourglass_work / record.increment : 0.0;
      record.corrected_pressure = (forces.reaction - taken) / width;
    }
  }
  record.evaluations = record.residual_evaluations + record.jacobian_actions;
  record.plastic_particles = forces.plastic;
  record.max_plastic_strain = forces.max_plastic_strain;
  record.hourglass_work_ratio =
      programme.external_work != 0.0 ? programme.hourglass_work / programme.external_work : 0.0;
  record.max_displacement = std::sqrt(state_.displacement.rowwise().squaredNorm().maxCoeff());
  record.re_searched_rows = re_search();
  choose_next_increment(record);
}

template <int Dim>
Eigen::Index LoadStepper<Dim>::re_search() {
  const Eigen::Index rebuilt = stepping::re_search(scene_, model_, state_, *equilibrium_);
  if (rebuilt > 0) forget_pairs();
  return rebuilt;
}

// Back to the nominal step gently after a cut; beyond it only where steps are easy. A step that was
// hard but converged is not cut far below the nominal one: smaller steps would cost as much each.
template <int Dim>
void LoadStepper<Dim>::choose_next_increment(const StepRecord& record) {
  constexpr double hard_floor = 0.25;  // of the nominal increment
  model::ProgrammeState& programme = state_.programme;
  const scene::Programme& rule = scene_.programme;
  const bool below_nominal = programme.next_increment < nominal_increment_;
  const int easy = below_nominal ? rule.hard_evaluations : rule.easy_evaluations;
  const int wait = below_nominal ? std::max(1, rule.easy_steps / 3) : rule.easy_steps;
  programme.easy_steps =
      record.cuts == 0 && record.evaluations <= easy ? programme.easy_steps + 1 : 0;
  if (record.cuts == 0 && record.evaluations > rule.hard_evaluations) {
    const double floor = std::min(programme.next_increment, hard_floor * nominal_increment_);
    programme.next_increment = std::max(floor, programme.next_increment / rule.growth);
  } else if (programme.easy_steps >= wait) {
    const double limit = nominal_increment_ * (below_nominal ? 1.0 : rule.maximum_increment_ratio);
    programme.next_increment = std::min(limit, programme.next_increment * rule.growth);
    programme.easy_steps = 0;
  }
}

template class LoadStepper<2>;
template class LoadStepper<3>;

}  // namespace stepping
