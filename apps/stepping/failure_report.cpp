#include "stepping/failure_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "stepping/likely_causes.hpp"

namespace stepping {

namespace {

constexpr std::size_t most_places = 3;

// How far the drive has come, or, with stages, the one at hand.
std::string how_far(const scene::Scene& scene, double load, double progress) {
  return scene.stage.empty() ? fmt::format("load {:.6g}", load)
                             : fmt::format("{:.6g} of the stage", progress);
}

std::string what_ended_it(const scene::Scene& scene, const StepResult& result,
                          const model::ProgrammeState& programme) {
  const std::string reached = how_far(scene, programme.load, programme.progress);
  if (result.outcome == StepOutcome::hopeless) {
    return fmt::format(
        "no hope after {}: {} attempts at a step since {} have not gained one "
        "nominal step (programme.patience)",
        reached, result.attempts, how_far(scene, result.patience_mark, result.patience_mark));
  }
  return fmt::format("no convergence at the smallest increment after {}", reached);
}

std::string what_limits(const StepResult& result) {
  if (result.folded_particle >= 0) {
    return fmt::format("a folded particle: the neighbourhood of particle {} turns inside out",
                       result.folded_particle);
  }
  if (result.unbalanced_plate) {
    return "the plate: no motion of it is in balance with its load";
  }
  if (result.trouble == jfnk::Trouble::flat || result.trouble == jfnk::Trouble::singular) {
    return "the tangent: the body, or a part of it, gives way without resistance";
  }
  switch (result.status) {
    case jfnk::Status::evaluation_limit:
      return "the evaluations of a step (solver.max_evaluations_per_step)";
    case jfnk::Status::line_search_failed:
      return "the line search: no length of the Newton step lowers the residual";
    case jfnk::Status::krylov_stalled:
      return "the Krylov solver: it finds no direction";
    case jfnk::Status::linearisation_failed:
      return "the stress update: it has no tangent";
    case jfnk::Status::out_of_domain_at_start:
      return "the predictor: it cannot be evaluated";
    default:
      return "the nonlinear iteration: the residual falls too slowly";
  }
}

// The one setting that is most likely to help.
template <int Dim>
std::string advice(const scene::Scene& scene, const model::State<Dim>& state,
                   const StepResult& result) {
  const bool plastic = state.layout.plastic && state.layout.finite;
  const bool strained =
      plastic &&
      (state.plastic_strain - state.plastic_strain_at_search).maxCoeff() > scene.re_search.trigger;
  if (!scene.re_search.enabled && strained) {
    return "neighbourhoods are strained beyond re_search.trigger: resume with --set "
           "re_search.enabled=true";
  }
  if (scene.re_search.enabled && plastic && result.folded_particle >= 0) {
    return fmt::format("search anew earlier: resume with --set re_search.trigger={:.2g}",
                       scene.re_search.trigger / 2.0);
  }
  if (result.status == jfnk::Status::evaluation_limit) {
    return fmt::format("resume with --set solver.max_evaluations_per_step={}",
                       4 * scene.solver.max_evaluations_per_step);
  }
  if (scene.drive.kind == scene::DriveKind::load) {
    return "the load may be beyond what the body carries: drive a displacement instead";
  }
  if (scene.course.reduction_end != scene.course.reduction_begin) {
    return "the strength may be less than the body needs: that is its factor";
  }
  if (scene.drive.kind == scene::DriveKind::none && state.layout.plastic) {
    return "the loads may be beyond what the body carries: let them grow, drive.kind = \"load\"";
  }
  if (result.outcome == StepOutcome::hopeless) {
    return fmt::format(
        "a looser tolerance, if its error is acceptable: resume with --set "
        "solver.tolerance={:.2g}",
        3.0 * scene::resolve_solver(scene).tolerance);
  }
  return fmt::format("resume with --set programme.minimum_increment_ratio={:.2g}",
                     scene.programme.minimum_increment_ratio / 64.0);
}

// Square of the residual of each particle, over its sum.
Eigen::VectorXd shares(const Eigen::VectorXd& residual, Eigen::Index particles) {
  Eigen::VectorXd square = Eigen::VectorXd::Zero(particles);
  for (Eigen::Index k = 0; k < residual.size(); ++k) {
    square[k % particles] += residual[k] * residual[k];
  }
  const double sum = square.sum();
  return sum > 0.0 ? Eigen::VectorXd(square / sum) : square;
}

std::vector<fpm::Index> largest(const Eigen::VectorXd& values) {
  std::vector<fpm::Index> order(static_cast<std::size_t>(values.size()));
  std::iota(order.begin(), order.end(), fpm::Index{0});
  const std::size_t count = std::min(most_places, order.size());
  std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                    [&](fpm::Index a, fpm::Index b) { return values[a] > values[b]; });
  order.resize(count);
  return order;
}

template <int Dim>
std::string condition_of(const model::State<Dim>& state, fpm::Index a) {
  std::vector<std::string> words;
  if (state.layout.plastic) {
    words.emplace_back(state.plastic_increment[a] > 0.0 ? "yields" : "does not yield");
    words.push_back(fmt::format("plastic strain {:.3g}", state.plastic_strain[a]));
    if (state.layout.finite) {
      words.push_back(fmt::format("{:.3g} of it since its last search",
                                  state.plastic_strain[a] - state.plastic_strain_at_search[a]));
    }
  }
  if (state.layout.finite) {
    const Eigen::Map<const fpm::Tensor<Dim>> f(state.deformation_gradient.col(a).data());
    words.push_back(
        fmt::format("volume ratio {:.3g}", state.searched_volume_ratio[a] * f.determinant()));
  }
  return words.empty() ? "" : fmt::format(" ({})", fmt::join(words, ", "));
}

template <int Dim>
std::string place(const model::Model<Dim>& model, const model::State<Dim>& state, fpm::Index a) {
  const Eigen::Matrix<double, 1, Dim> now =
      model.particles.position.row(a) + state.displacement.row(a);
  return fmt::format("particle {}, now at ({:.6g}) m", a,
                     fmt::join(now.data(), now.data() + Dim, ", ")) +
         condition_of(state, a);
}

template <int Dim>
std::string where(const model::Model<Dim>& model, const model::State<Dim>& state,
                  const StepResult& result) {
  std::string text;
  if (result.folded_particle >= 0) {
    text += fmt::format("\n  folded: {}", place(model, state, result.folded_particle));
  }
  if (result.residual.size() == 0) return text;
  const Eigen::VectorXd share = shares(result.residual, model.size());
  for (const fpm::Index a : largest(share)) {
    if (!(share[a] > 0.0)) break;
    text += fmt::format("\n  {:.0f} % of the residual (squared): {}", 100.0 * share[a],
                        place(model, state, a));
  }
  return text;
}

// Where more load than the ground bears may have seemed to be borne.
std::string energy_corrected(const scene::Scene& scene, bool plastic, const StepResult& result,
                             double load) {
  const scene::Course& course = scene.course;
  const bool only_load_grows = scene.drive.kind == scene::DriveKind::load &&
                               course.load_end > course.load_begin &&
                               course.reduction_begin == course.reduction_end;
  // The work of the paper's viscosity is not counted.
  const bool is_counted = scene::resolve_control(scene) != scene::HourglassControl::viscosity;
  if (!result.corrected_load || !plastic || !only_load_grows || !is_counted) return "";
  return fmt::format(
      "\n  energy-corrected: {:.4g} of the load, without {:.2g} % that the hourglass control bears "
      "and the tolerance leaves unbalanced in the last step.",
      *result.corrected_load, 100.0 * (1.0 - *result.corrected_load / load));
}

}  // namespace

template <int Dim>
std::string failure_report(const scene::Scene& scene, const model::Model<Dim>& model,
                           const model::State<Dim>& state, const StepResult& result) {
  std::string causes;
  for (const std::string& cause : likely_causes(scene, model, state)) {
    causes += fmt::format("\n  likely: {}.", cause);
  }
  const std::string corrected =
      energy_corrected(scene, state.layout.plastic, result, state.programme.load);
  return fmt::format("{}: {}.\n  limits: {}.{}{}{}\n  advice: {}{}.",
                     what_ended_it(scene, result, state.programme), result.reason,
                     what_limits(result), where(model, state, result), causes, corrected,
                     causes.empty() ? "" : "if that is not it, ", advice(scene, state, result));
}

template <int Dim>
std::vector<files::PointField> failure_fields(const model::Model<Dim>& model,
                                              const StepResult& result) {
  const Eigen::Index n = model.size();
  const auto particles = static_cast<std::size_t>(n);
  const auto entry = [n](const Eigen::VectorXd& of) {
    return [n, &of](std::size_t a, int i) {
      return of.size() == 0 ? 0.0 : of[i * n + static_cast<Eigen::Index>(a)];
    };
  };
  return {files::vector_field("residual", Dim == 2 ? "N/m" : "N", particles, Dim,
                              entry(result.residual)),
          files::vector_field("attempt", "m", particles, Dim, entry(result.attempt))};
}

template std::string failure_report<2>(const scene::Scene&, const model::Model<2>&,
                                       const model::State<2>&, const StepResult&);
template std::string failure_report<3>(const scene::Scene&, const model::Model<3>&,
                                       const model::State<3>&, const StepResult&);
template std::vector<files::PointField> failure_fields<2>(const model::Model<2>&,
                                                          const StepResult&);
template std::vector<files::PointField> failure_fields<3>(const model::Model<3>&,
                                                          const StepResult&);

}  // namespace stepping
