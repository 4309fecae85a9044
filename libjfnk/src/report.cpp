#include "jfnk/report.hpp"

#include <cmath>
#include <cstdio>

#include "outcome_text.hpp"

namespace jfnk {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::converged:
      return "converged";
    case Status::max_iterations:
      return "max_iterations";
    case Status::evaluation_limit:
      return "evaluation_limit";
    case Status::line_search_failed:
      return "line_search_failed";
    case Status::stagnated:
      return "stagnated";
    case Status::krylov_stalled:
      return "krylov_stalled";
    case Status::linearisation_failed:
      return "linearisation_failed";
    case Status::multisecant_stalled:
      return "multisecant_stalled";
    case Status::out_of_domain_at_start:
      return "out_of_domain_at_start";
    case Status::local_minimum:
      return "local_minimum";
    case Status::in_progress:
      return "in_progress";
    case Status::stopped:
      return "stopped";
  }
  return "unknown";
}

std::string_view to_string(Phase phase) {
  switch (phase) {
    case Phase::start:
      return "start";
    case Phase::newton:
      return "newton";
    case Phase::multisecant:
      return "multisecant";
    case Phase::pseudo_transient:
      return "pseudo_transient";
  }
  return "unknown";
}

namespace detail {
namespace {

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// "s 7 (-1.1), 3 (0.4)": the components of the largest |F_i|.
std::string worst(const Report& report) {
  std::string text = report.worst.size() > 1 ? "s " : " ";
  if (report.worst.empty()) return text + std::to_string(report.worst_component);
  for (const Component& component : report.worst) {
    if (&component != &report.worst.front()) text += ", ";
    text += std::to_string(component.index) + " (" + number(component.residual) + ")";
  }
  return text;
}

/// "||F|| = 1.2, asked 0.1, largest in components 7 (-1.1), 3 (0.4)".
std::string where(const Report& report) {
  // A solve that did not converge can have met the tolerance of F only if more was asked.
  const bool step_is_long = report.residual_norm <= report.tolerance;
  return "||F|| = " + number(report.residual_norm) + ", asked " + number(report.tolerance) +
         (step_is_long ? " (met, but the last step is longer than tolerances.step allows)" : "") +
         ", largest in component" + worst(report);
}

std::string out_of_domain_text(const Report& report) {
  if (report.worst_component >= 0) {
    return "F cannot be evaluated at the first u: component " +
           std::to_string(report.worst_component) +
           " is not finite; start from a point in the domain of F";
  }
  return "the residual declared the first u out of its domain; start from another point";
}

/// What to try; the trials of the last Newton step tell nothing about its linear solve.
const char* linear_advice(const Report& report) {
  for (auto line = report.history.rbegin(); line != report.history.rend(); ++line) {
    if (line->phase != Phase::newton) continue;
    if (line->linear_residual > line->forcing) {
      return "; the last linear solve missed its tolerance: try a preconditioner or larger "
             "krylov.max_iterations";
    }
    break;
  }
  return "; check the Jacobian action, or start closer to the solution";
}

}  // namespace

Eigen::Index first_not_finite(const Vector& v, bool written_only) {
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (!std::isfinite(v[i]) && !(written_only && is_unwritten(v[i]))) return i;
  }
  return -1;
}

std::string unwritten_text(Eigen::Index component) {
  return "the residual did not write component " + std::to_string(component) +
         " of r, or added to what was there (r arrives full of NaN): it must overwrite all of r";
}

std::string reason(const Report& report, const Options& options) {
  switch (report.status) {
    case Status::converged:
      return "||F|| = " + number(report.residual_norm) + " met the tolerance " +
             number(report.tolerance) + " after " + std::to_string(report.counts.total()) +
             " evaluations";
    case Status::max_iterations:
      return "the iterations allowed were used up: " + where(report) +
             (options.method == Method::hybrid ? "; raise hybrid.rounds or final_newton_steps"
                                               : "; raise max_iterations");
    case Status::evaluation_limit:
      return "max_evaluations = " + std::to_string(options.max_evaluations) +
             " is used up: " + where(report);
    case Status::line_search_failed:
      return "no step along the Newton direction reduced ||F||: " + where(report) +
             linear_advice(report);
    case Status::stagnated:
      return "Newton steps hardly reduce ||F|| any more: " + where(report) + linear_advice(report);
    case Status::krylov_stalled:
      return "the linear solve gave no direction (singular Jacobian, or J v cannot be "
             "evaluated): " +
             where(report);
    case Status::linearisation_failed:
      return "the residual declined to linearise: " + where(report);
    case Status::multisecant_stalled:
      return "multisecant lost its patience: " + where(report) +
             "; try Method::hybrid or a better preconditioner";
    case Status::out_of_domain_at_start:
      return out_of_domain_text(report);
    case Status::local_minimum:
      return "no direction lowers ||F||, which is not zero: a local minimum or an inconsistent "
             "system: " +
             where(report) + "; start from another point";
    case Status::in_progress:
      return "the solve has not yet come to an end: " + where(report);
    case Status::stopped:
      if (report.history.empty()) return "the residual asked to stop at the first u";
      return "the residual or the observer asked to stop: " + where(report);
  }
  return {};
}

}  // namespace detail
}  // namespace jfnk
