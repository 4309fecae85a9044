#include "stepping/linear_solve.hpp"

#include <algorithm>

#include "equilibrium/equilibrium.hpp"

namespace stepping {

template <int Dim>
LinearSolveResult LinearSolve<Dim>::operator()(equilibrium::Equilibrium<Dim>& equilibrium,
                                               const jfnk::PreconditionerRef& P,
                                               const LinearSolveOptions& options,
                                               Eigen::VectorXd& u,
                                               const std::function<bool()>& go_on) {
  // Below what is asked for, as the reference norm is another at the end.
  constexpr double aim = 0.5;
  // Where nothing but the motion of supports is known, of what the tear at them leaves.
  constexpr double first_aim = 1e-2;
  constexpr double worth_another = 0.5;
  const jfnk::InnerProductRef product(equilibrium);
  const auto action = [&](const Eigen::VectorXd& v, Eigen::VectorXd& jv) {
    if (!go_on()) return jfnk::Evaluation::stop;
    equilibrium.apply_jacobian(v, jv);
    return jfnk::Evaluation::ok;
  };
  LinearSolveResult result;
  rest_.resize(u.size());
  correction_.resize(u.size());
  const auto look = [&] {
    ++result.evaluations;
    if (equilibrium(u, rest_) != jfnk::Evaluation::ok) return false;
    result.norm = product.norm(rest_);
    result.reference = equilibrium.reference_norm();
    result.converged =
        result.norm <= std::max(options.rounding, options.tolerance * result.reference);
    return true;
  };
  if (!look() || result.converged || !equilibrium.linearise(u)) return result;
  double scale = equilibrium.external_load().norm();
  // Supports have moved, or something else than the loads is to be borne.
  bool torn = result.reference > 2.0 * scale;
  for (bool falls = true; falls && !result.converged && result.actions < options.max_actions;) {
    jfnk::GmresOptions linear;
    linear.max_iterations = options.max_actions - result.actions;
    linear.absolute_tolerance = std::max(options.rounding, aim * options.tolerance * scale);
    linear.relative_tolerance = torn ? first_aim : 0.0;
    rest_ *= -1.0;
    const jfnk::GmresResult solve =
        krylov_.solve(jfnk::OperatorRef(action), rest_, correction_, linear, P, product);
    result.actions += solve.iterations;
    result.stopped = solve.status == jfnk::KrylovStatus::stopped;
    if (result.stopped) return result;
    u += correction_;
    const double before = result.norm;
    if (!look()) return result;
    scale = result.reference;
    torn = false;
    falls = solve.status == jfnk::KrylovStatus::converged && result.norm < worth_another * before;
  }
  return result;
}

template <int Dim>
std::size_t LinearSolve<Dim>::bytes() const {
  return krylov_.bytes() +
         static_cast<std::size_t>(rest_.size() + correction_.size()) * sizeof(double);
}

template <int Dim>
std::size_t LinearSolve<Dim>::bytes_to_come(Eigen::Index n, bool preconditioned) {
  const Eigen::Index vectors = preconditioned ? 6 : 5;
  return static_cast<std::size_t>(vectors * n) * sizeof(double);
}

template class LinearSolve<2>;
template class LinearSolve<3>;

}  // namespace stepping
