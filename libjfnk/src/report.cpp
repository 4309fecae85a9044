#include "jfnk/report.hpp"

#include <algorithm>
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
    case Status::noise_floor:
      return "noise_floor";
    case Status::not_started:
      return "not_started";
    case Status::threw:
      return "threw";
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

std::string_view to_string(Trouble trouble) {
  switch (trouble) {
    case Trouble::none:
      return "none";
    case Trouble::flat:
      return "flat";
    case Trouble::singular:
      return "singular";
    case Trouble::krylov_capped:
      return "krylov_capped";
    case Trouble::action_failed:
      return "action_failed";
    case Trouble::minimum:
      return "minimum";
    case Trouble::broken_promise:
      return "broken_promise";
    case Trouble::domain_edge:
      return "domain_edge";
    case Trouble::short_steps:
      return "short_steps";
    case Trouble::indefinite:
      return "indefinite";
  }
  return "unknown";
}

namespace detail {
namespace {

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

/// What the failed step showed, and what to try.
std::string advice(const Report& report) {
  const bool own_action = report.counts.user_actions > 0;
  switch (report.trouble) {
    case Trouble::flat:
      return "; J v = 0 for all v tried: F, or what is not solved of it, does not change with u" +
             std::string(own_action ? ""
                                    : ", or over longer ways only than differences are (see "
                                      "u_scale and jacobian.noise)");
    case Trouble::singular:
      return "; J is singular: equations repeat or contradict each other, or F lacks an unknown";
    case Trouble::krylov_capped:
      return "; the linear solve lowered nothing within krylov.max_iterations: raise it and "
             "krylov.restart, or give a preconditioner";
    case Trouble::action_failed:
      return "; J v cannot be evaluated";
    case Trouble::minimum:
      return "; ||F|| has a minimum along the step that is no root, or J is all but singular: "
             "start from another point; is there a root at all?";
    case Trouble::broken_promise:
      if (own_action) {
        return "; check the Jacobian action: F does not fall as apply_jacobian promises (see "
               "jfnk::check)";
      }
      return "; F does not fall as its differences promise: a kink, a jump or noise (see "
             "jfnk::check)";
    case Trouble::domain_edge:
      return "; F has no value along the step: the end of its domain, where u may not go further";
    case Trouble::short_steps:
      return "; steps have become shorter than the rounding of u: give tolerances.absolute";
    case Trouble::indefinite:
      return "; J, or the preconditioner, is not positive definite, as conjugate gradients need "
             "it: "
             "solve by gmres";
    case Trouble::none:
      break;
  }
  return report.last_linear_residual > report.last_forcing
             ? "; the last linear solve missed its tolerance: try a preconditioner or larger "
               "krylov.max_iterations"
             : "; start closer to the solution";
}

/// A word on units, if the unknowns are far apart, or far from one, and nobody has said how large
/// they are.
std::string units_text(const Report& report, const Sizes& first, const Options& options) {
  constexpr double far = 4.0, small = 1e-6, large = 1e6;
  if (options.u_scale.size() > 0) return {};
  if (first.decades >= far) {
    return "; the unknowns of the first u are " + std::to_string(static_cast<int>(first.decades)) +
           " decades apart: give u_scale and f_scale";
  }
  const bool told = options.jacobian.length_scale > 0.0 || report.counts.user_actions > 0;
  if (told || first.typical == 0.0 || (first.typical >= small && first.typical <= large)) return {};
  return "; differences are made for unknowns of order one, and those of the first u are of " +
         number(first.typical, 1) + ": give u_scale";
}

/// Noise that reaches so high is none to stop at: no less could be asked for than what there was.
bool is_a_jump(const Report& report) {
  constexpr double high = 0.1;
  const double large = std::max(report.initial_residual_norm, report.reference_norm);
  return !(report.measured_noise < high * large);
}

std::string noise_text(const Report& report) {
  constexpr double safe = 2.0;
  if (is_a_jump(report)) {
    return "F jumps near u, or is noise, by " + number(report.measured_noise) +
           ", which is of the " + "order of ||F|| at the start, " +
           number(report.initial_residual_norm) +
           ": nothing can be sought below it; look at F with jfnk::check, or start elsewhere";
  }
  const double noise = std::max(report.measured_noise, report.residual_norm);
  return "||F|| = " + number(report.residual_norm) + " is at the noise or rounding of F, " +
         number(report.measured_noise) + ", and the tolerance " + number(report.tolerance) +
         " below it: give tolerances.absolute = " + number(safe * noise) + " or more";
}

}  // namespace

std::string number(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value == 0.0 ? 0.0 : value);
  return text;
}

Eigen::Index first_not_finite(const Vector& v, bool written_only) {
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (!std::isfinite(v[i]) && !(written_only && is_unwritten(v[i]))) return i;
  }
  return -1;
}

Sizes sizes_of(const Vector& v) {
  constexpr std::ptrdiff_t tenth = 10;
  std::vector<double> sizes;
  for (const double value : v) {
    if (value != 0.0 && std::isfinite(value)) sizes.push_back(std::abs(value));
  }
  if (sizes.empty()) return {};
  const auto count = static_cast<std::ptrdiff_t>(sizes.size());
  const auto at = [&](std::ptrdiff_t i) {
    std::nth_element(sizes.begin(), sizes.begin() + i, sizes.end());
    return sizes[static_cast<std::size_t>(i)];
  };
  return {std::log10(at(count - 1 - count / tenth)) - std::log10(at(count / tenth)), at(count / 2)};
}

std::string unwritten_text(Eigen::Index component) {
  return "the residual did not write component " + std::to_string(component) +
         " of r, or added to what was there (r arrives full of NaN): it must overwrite all of r";
}

std::string reason(const Report& report, const Options& options, const Sizes& first) {
  const std::string hints = advice(report) + units_text(report, first, options);
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
             " is used up: " + where(report) + units_text(report, first, options);
    case Status::line_search_failed:
      return "no step along the Newton direction reduced ||F||: " + where(report) + hints;
    case Status::stagnated:
      return "Newton steps hardly reduce ||F|| any more: " + where(report) + hints;
    case Status::krylov_stalled:
      return "the linear solve gave no direction: " + where(report) + hints;
    case Status::linearisation_failed:
      return "the residual declined to linearise: " + where(report);
    case Status::multisecant_stalled:
      return "multisecant lost its patience: " + where(report) +
             "; try Method::hybrid or a better preconditioner";
    case Status::out_of_domain_at_start:
      return out_of_domain_text(report);
    case Status::local_minimum:
      if (report.trouble == Trouble::minimum) {
        return "u is a stationary point of ||F|| that is no root: " + where(report) + hints;
      }
      return "no direction lowers ||F||, which is not zero: a local minimum or an inconsistent "
             "system: " +
             where(report) + hints;
    case Status::noise_floor:
      return noise_text(report) + units_text(report, first, options);
    case Status::not_started:
      return "no solve was started";
    case Status::threw:
      return "the residual, preconditioner or observer threw an exception: begin again by `start`";
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
