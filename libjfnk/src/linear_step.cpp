#include <algorithm>
#include <cmath>

#include "strategy.hpp"

namespace jfnk::detail {
namespace {

// With factors that could be new for few products, longer solves do not pay.
constexpr int least_iterations = 10;

int most_iterations(const Solve& solve) {
  const int chosen = solve.options.krylov.max_iterations;
  if (!solve.evaluator.preconditioned_by_learning()) return chosen;
  return std::min(chosen, std::max(least_iterations, solve.work.evaluator.learnt.groups()));
}

/// Why a linear solve gave nothing.
Trouble trouble_of(KrylovStatus status, bool flat) {
  if (flat) return Trouble::flat;
  if (status == KrylovStatus::operator_failed) return Trouble::action_failed;
  if (status == KrylovStatus::indefinite) return Trouble::indefinite;
  return status == KrylovStatus::breakdown ? Trouble::singular : Trouble::krylov_capped;
}

Evaluation answer(Outcome outcome) {
  switch (outcome) {
    case Outcome::ok:
      return Evaluation::ok;
    case Outcome::out_of_domain:
      return Evaluation::out_of_domain;
    default:
      return Evaluation::stop;
  }
}

/// du = -P F, P taken for J^-1.
LinearSolution invert_by_preconditioner(Solve& solve, Iteration& line) {
  Workspace& work = solve.work;
  solve.evaluator.precondition(work.base.r, work.direction);
  work.direction *= -1.0;
  solve.report.last_linear_residual = 0.0;
  solve.report.last_forcing = 0.0;
  line.forcing = 0.0;
  line.linear_residual = 0.0;
  const double length = solve.evaluator.product().norm(work.direction);
  if (!(length > 0.0) || !std::isfinite(length)) {
    solve.note_trouble(Trouble::singular);
    return {Ending::krylov_stalled};
  }
  return {};
}

}  // namespace

LinearSolution find_direction(Solve& solve, double eta, double shift, Iteration& line) {
  Workspace& work = solve.work;
  Evaluator& evaluator = solve.evaluator;
  const Outcome ready = evaluator.linearise(work.base);
  if (ready == Outcome::stopped) return {Ending::stopped};
  if (ready != Outcome::ok) return {Ending::linearisation_failed};

  const bool direct =
      solve.options.krylov.solver == Krylov::Solver::direct || solve.course.newton.by_full_steps;
  if (direct && shift == 0.0 && !evaluator.preconditioner().is_identity()) {
    return invert_by_preconditioner(solve, line);
  }

  Outcome last = Outcome::ok;
  bool flat = true;
  auto action = [&](const Vector& v, Vector& Jv) {
    last = evaluator.action(v, Jv);
    flat = flat && last == Outcome::ok && (Jv.array() == 0.0).all();
    if (last == Outcome::ok && shift != 0.0) Jv += shift * v;
    return answer(last);
  };
  CountedPreconditioner counted{&evaluator};
  const PreconditionerRef P = counted.ref();
  GmresOptions linear;
  linear.restart = solve.options.krylov.restart;
  linear.max_iterations = most_iterations(solve);
  linear.flexible = solve.options.krylov.flexible;
  linear.single_precision = solve.options.krylov.single_precision;
  linear.relative_tolerance = eta;
  linear.global_size = evaluator.residual().global_size(work.base.u.size());
  work.step = -work.base.r;
  work.direction.setZero();
  const auto solve_by = [&](auto& krylov) {
    return krylov.solve(OperatorRef(action), work.step, work.direction, linear, P,
                        evaluator.product());
  };
  const Krylov::Solver kind = solve.options.krylov.solver;
  const bool by_gmres =
      kind != Krylov::Solver::bicgstab && kind != Krylov::Solver::conjugate_gradients;
  const GmresResult result = by_gmres ? solve_by(work.gmres)
                             : kind == Krylov::Solver::bicgstab
                                 ? solve_by(work.bicgstab)
                                 : solve_by(work.conjugate_gradients);
  solve.report.last_linear_residual = result.relative_residual;
  solve.report.last_forcing = eta;
  line.forcing = eta;
  line.linear_residual = result.relative_residual;
  line.krylov_iterations = result.iterations;
  solve.report.krylov_iterations += result.iterations;
  solve.course.preconditioner.stale += std::max(result.iterations - 1, 0);
  if (last == Outcome::stopped) return {Ending::stopped};
  if (last == Outcome::limit) return {Ending::limit};
  const double length = evaluator.product().norm(work.direction);
  constexpr double nothing_gained = 0.999;
  const bool no_direction = !(length > 0.0) || !std::isfinite(length);
  if (no_direction || result.relative_residual > nothing_gained) {
    solve.note_trouble(trouble_of(result.status, flat));
  }
  if (no_direction) return {Ending::krylov_stalled};
  return {Ending::go_on, by_gmres && work.gmres.can_shorten()};
}

}  // namespace jfnk::detail
