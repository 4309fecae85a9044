#include "stepping/solver_setup.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "equilibrium/equilibrium.hpp"
#include "jfnk/solver.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace stepping {

jfnk::Options solver_options(const scene::Scene& scene, double rounding) {
  const scene::SolverSettings settings = scene::resolve_solver(scene);
  jfnk::Options options = scene.solver.preset == scene::SolverPreset::appendix_a
                              ? jfnk::appendix_a(settings.tolerance, settings.tolerance, 1000)
                              : jfnk::plasticity();
  options.tolerances.relative = settings.tolerance;
  options.tolerances.absolute = rounding;
  switch (settings.method) {
    case scene::SolverMethod::hybrid:
      options.method = jfnk::Method::hybrid;
      break;
    case scene::SolverMethod::newton_krylov:
      options.method = jfnk::Method::newton_krylov;
      break;
    case scene::SolverMethod::multisecant:
      options.method = jfnk::Method::multisecant;
      break;
  }
  if (settings.jacobian == scene::JacobianKind::finite_difference) {
    options.jacobian.source = jfnk::Jacobian::Source::finite_difference;
  }
  // Rounded columns take half the memory, and cost hardly an evaluation before such a tolerance;
  // forcing terms of these presets are coarser by far. The paper's algorithm is left as it is.
  constexpr double finest_for_single_precision = 1e-6;
  const bool rounds = settings.tolerance >= finest_for_single_precision &&
                      scene.solver.preset != scene::SolverPreset::appendix_a;
  options.multisecant.single_precision = options.krylov.single_precision = rounds;
  options.jacobian.length_scale = scene.geometry.spacing;
  options.max_evaluations = scene.solver.max_evaluations_per_step;
  return options;
}

// Places are known to epsilon of their size, strains to that over a spacing, and each particle's
// forces are the stress of such a strain on its faces.
template <int Dim>
double rounding_of_forces(const scene::Scene& scene, const model::Model<Dim>& model) {
  constexpr double neighbours = 10.0;  // whose rounding adds up in a particle
  const fpm::Vector<Dim> origin = model.nearby_origin();
  const double size = std::max((model.box_min - origin).cwiseAbs().maxCoeff(),
                               (model.box_max - origin).cwiseAbs().maxCoeff()) +
                      scene.drive.target;
  const double strain = std::numeric_limits<double>::epsilon() * size / model.spacing;
  const double stiffest = *std::ranges::max_element(model.youngs_modulus);
  return neighbours * stiffest * strain * std::pow(model.spacing, Dim - 1) *
         std::sqrt(static_cast<double>(model.size()));
}

template <int Dim>
equilibrium::Preconditioner<Dim> preconditioner_for(
    const scene::Scene& scene, const model::Model<Dim>& model,
    const equilibrium::Equilibrium<Dim>& equilibrium) {
  const scene::PreconditionerKind kind = scene::resolve_solver(scene).preconditioner;
  using Way = equilibrium::Preconditioner<Dim>;
  if (kind == scene::PreconditionerKind::factors) {
    return Way(equilibrium::StiffnessFactors<Dim>(model, equilibrium.initial_operator()));
  }
  const double coarse =
      kind == scene::PreconditionerKind::two_level ? scene.solver.coarse_spacing_over_spacing : 0.0;
  return Way(equilibrium::TwoLevelPreconditioner<Dim>(model, *equilibrium.initial_rows(), coarse));
}

std::string reason_of(const jfnk::Report& report, const scene::Scene& scene, int dimension) {
  if (report.status == jfnk::Status::out_of_domain_at_start) {
    return "the step cannot be evaluated at its start";
  }
  const char* unit = dimension == 2 ? "N/m" : "N";
  // More digits where two would hide which one is the larger.
  std::string found = fmt::format("{:.2g}", report.residual_norm);
  std::string allowed = fmt::format("{:.2g}", report.tolerance);
  if (found == allowed) {
    found = fmt::format("{:.6g}", report.residual_norm);
    allowed = fmt::format("{:.6g}", report.tolerance);
  }
  const std::string unbalanced =
      fmt::format("unbalanced are {} {}, solver.tolerance = {} allows {}", found, unit,
                  scene::resolve_solver(scene).tolerance, allowed);
  if (report.status != jfnk::Status::evaluation_limit) return unbalanced;
  return fmt::format("solver.max_evaluations_per_step = {} is used up: {}",
                     scene.solver.max_evaluations_per_step, unbalanced);
}

template double rounding_of_forces(const scene::Scene&, const model::Model<2>&);
template double rounding_of_forces(const scene::Scene&, const model::Model<3>&);
template equilibrium::Preconditioner<2> preconditioner_for(const scene::Scene&,
                                                           const model::Model<2>&,
                                                           const equilibrium::Equilibrium<2>&);
template equilibrium::Preconditioner<3> preconditioner_for(const scene::Scene&,
                                                           const model::Model<3>&,
                                                           const equilibrium::Equilibrium<3>&);

}  // namespace stepping
