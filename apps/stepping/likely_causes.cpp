#include "stepping/likely_causes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>

#include "equilibrium/elastic_block.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"
#include "scene/stages.hpp"

namespace stepping {

namespace {

template <int Dim>
inline constexpr int rigid_motions = Dim == 2 ? 3 : 6;

template <int Dim>
using Motion = Eigen::Matrix<double, rigid_motions<Dim>, 1>;

// The component along `axis`, at a place measured from the body's middle in its own size, of each
// rigid motion: shifts along x, y (z), then turns in the planes xy (yz, zx).
template <int Dim>
Motion<Dim> component(int axis, const fpm::Vector<Dim>& place) {
  Motion<Dim> at = Motion<Dim>::Zero();
  at[axis] = 1.0;
  for (int turn = 0; turn < rigid_motions<Dim> - Dim; ++turn) {
    const int from = turn, to = (turn + 1) % Dim;
    if (axis == to) at[Dim + turn] = place[from];
    if (axis == from) at[Dim + turn] = -place[to];
  }
  return at;
}

// Rigid bodies that do not move by themselves, and what rests on them: a face that only slides
// holds across itself.
template <int Dim, class Hold>
void hold_by_faces(const model::Model<Dim>& model, Hold&& hold) {
  for (const model::Interface<Dim>& interface : model.interfaces) {
    if (!interface.is_rigid() || interface.plate) continue;
    const fpm::BoundaryPoints<Dim>& points = interface.faces.points;
    for (Eigen::Index c = 0; c < points.weight.size(); ++c) {
      const fpm::Vector<Dim> place = points.position.row(c).transpose();
      if (!constitutive::sticks(interface.law)) {
        hold(fpm::Vector<Dim>(points.normal.row(c).transpose()), place);
        continue;
      }
      for (int i = 0; i < Dim; ++i) hold(fpm::Vector<Dim>(fpm::Vector<Dim>::Unit(i)), place);
    }
  }
}

// A^T A of all that is held, A being the rigid motions' components there.
template <int Dim>
Eigen::Matrix<double, rigid_motions<Dim>, rigid_motions<Dim>> resistance(
    const model::Model<Dim>& model) {
  const fpm::Vector<Dim> middle = 0.5 * (model.box_min + model.box_max);
  const double size = (model.box_max - model.box_min).maxCoeff();
  Eigen::Matrix<double, rigid_motions<Dim>, rigid_motions<Dim>> sum;
  sum.setZero();
  const auto hold_along = [&](const fpm::Vector<Dim>& direction, const fpm::Vector<Dim>& place) {
    Motion<Dim> at = Motion<Dim>::Zero();
    for (int i = 0; i < Dim; ++i) {
      at += direction[i] * component<Dim>(i, fpm::Vector<Dim>((place - middle) / size));
    }
    sum += at * at.transpose();
  };
  const auto hold = [&](int axis, const fpm::Vector<Dim>& place) {
    hold_along(fpm::Vector<Dim>::Unit(axis), place);
  };
  hold_by_faces(model, hold_along);
  for (Eigen::Index k = 0; k < model.unknowns(); ++k) {
    if (model.prescribed[static_cast<std::size_t>(k)] == 0) continue;
    hold(static_cast<int>(k / model.size()),
         model.particles.position.row(k % model.size()).transpose());
  }
  for (const fpm::GhostPlane<Dim>& plane : model.ghosts.planes()) {
    for (int corner = 0; corner < 1 << Dim; ++corner) {
      fpm::Vector<Dim> place;
      for (int i = 0; i < Dim; ++i) {
        const bool high = ((corner >> i) & 1) != 0;
        place[i] = high ? std::min(model.box_max[i], plane.range_max[i])
                        : std::max(model.box_min[i], plane.range_min[i]);
      }
      place[plane.axis] = plane.position;
      for (int i = 0; i < Dim; ++i) {
        if (plane.held[static_cast<std::size_t>(i)]) hold(i, place);
      }
    }
  }
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      for (int i = 0; i < Dim; ++i) {
        if (!support.options.prescribed[static_cast<std::size_t>(i)]) continue;
        hold(i, support.points.position.row(c).transpose());
      }
    }
  }
  return sum;
}

std::string incompressible(const scene::Scene& scene) {
  constexpr double nearly = 0.49;
  if (scene::resolve_solver(scene).preconditioner == scene::PreconditionerKind::factors) return "";
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < scene.material.size(); ++i) {
    if (scene.material[i].poissons_ratio <= nearly) continue;
    keys.push_back(
        fmt::format("material.{}.poissons_ratio = {}", i, scene.material[i].poissons_ratio));
  }
  if (keys.empty()) return "";
  return fmt::format(
      "{}: next to 0.5 the volume is so much stiffer than the shape that the solver finds no "
      "direction; solver.preconditioner = \"factors\" does, where particles are few, and undrained "
      "clay is well served by {}",
      fmt::join(keys, ", "), nearly);
}

std::string sudden_weight(const scene::Scene& scene, bool plastic, double load) {
  const auto& g = scene.gravity.acceleration;
  const bool heavy =
      std::any_of(g.begin(), g.end(), [](double component) { return component != 0.0; });
  const auto& scales = scene.drive.scales;
  const bool grows =
      scene.drive.kind == scene::DriveKind::load &&
      std::find(scales.begin(), scales.end(), scene::LoadKind::gravity) != scales.end();
  if (!heavy || grows || !plastic || load > 0.0 ||
      scene.initial_stress.kind != scene::InitialStressKind::none) {
    return "";
  }
  return "the whole weight comes on ground without stress in the first step, and makes it yield: "
         "give [initial_stress] kind = \"geostatic\", or let a load drive scale gravity";
}

// What a load that grows comes to at last.
template <int Dim>
std::string collapse(const scene::Scene& scene, const model::State<Dim>& state) {
  const bool flows = (state.layout.plastic && (state.plastic_increment.array() > 0.0).any()) ||
                     (state.interface_slip.array() != 0.0).any();
  const double reduction = scene::reduction_at(scene.course, state.programme.progress);
  if (flows && scene.course.reduction_end != scene.course.reduction_begin && reduction != 1.0) {
    return fmt::format(
        "collapse: the ground stands with its strength divided by {:.4g}, and no equilibrium was "
        "found beyond",
        reduction);
  }
  if (scene.drive.kind != scene::DriveKind::load || !flows || !(state.programme.load > 0.0)) {
    return "";
  }
  return fmt::format(
      "collapse: the body bears {:.4g} of the load, and no equilibrium was found with more",
      state.programme.load);
}

// The Jaumann rate turns the stress with the material: shear between two fibres loses stiffness by
// half their stress difference, and has none left where that is twice the shear modulus.
template <int Dim>
std::string strained_beyond_the_law(const model::Model<Dim>& model,
                                    const model::State<Dim>& state) {
  if (!state.layout.finite) return "";
  Eigen::Index count = 0;
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
    stress.diagonal() = state.stress.col(a).template head<3>();
    stress(1, 0) = state.stress(3, a);
    if constexpr (Dim == 3) {
      stress(2, 1) = state.stress(4, a);
      stress(2, 0) = state.stress(5, a);
    }
    const Eigen::Vector3d principal =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly)
            .eigenvalues();
    if (principal[2] - principal[0] > 2.0 * equilibrium::moduli_of(model, a).shear) ++count;
  }
  if (count == 0) return "";
  return fmt::format(
      "in {} of {} particles the stresses differ by more than twice the shear modulus: elastic "
      "strains of that size (a free stretch above exp(1 - nu)) are beyond the law, and the body is "
      "unstable",
      count, model.size());
}

}  // namespace

template <int Dim>
std::vector<std::string> free_rigid_motions(const model::Model<Dim>& model) {
  static constexpr std::array<const char*, 6> space{"a shift along x", "a shift along y",
                                                    "a shift along z", "a turn about z",
                                                    "a turn about x",  "a turn about y"};
  static constexpr std::array<const char*, 3> plane{"a shift along x", "a shift along y", "a turn"};
  using Matrix = Eigen::Matrix<double, rigid_motions<Dim>, rigid_motions<Dim>>;
  const Eigen::SelfAdjointEigenSolver<Matrix> modes(resistance(model));
  // One particle held half a body away resists by 1/4; places are known to far more digits.
  constexpr double none = 1e-9;
  std::vector<std::string> motions;
  for (int m = 0; m < rigid_motions<Dim>; ++m) {
    if (modes.eigenvalues()[m] > none) continue;
    Eigen::Index largest = 0;
    // A turn about a held point is a shift as well, seen from the middle.
    const Motion<Dim> mode = modes.eigenvectors().col(m);
    const bool turns = mode.tail(rigid_motions<Dim> - Dim).norm() > none;
    if (turns) {
      mode.tail(rigid_motions<Dim> - Dim).cwiseAbs().maxCoeff(&largest);
      largest += Dim;
    } else {
      mode.cwiseAbs().maxCoeff(&largest);
    }
    const auto name = static_cast<std::size_t>(largest);
    motions.emplace_back(Dim == 2 ? plane[name] : space[name]);
  }
  return motions;
}

template <int Dim>
std::vector<std::string> likely_causes(const scene::Scene& scene, const model::Model<Dim>& model,
                                       const model::State<Dim>& state) {
  std::vector<std::string> causes;
  const auto motions = free_rigid_motions(model);
  if (!motions.empty()) {
    causes.push_back(fmt::format("no support, symmetry or drive resists {}: add a [[support]]",
                                 fmt::join(motions, ", ")));
  }
  for (std::string cause :
       {incompressible(scene), sudden_weight(scene, state.layout.plastic, state.programme.load),
        strained_beyond_the_law(model, state), collapse(scene, state)}) {
    if (!cause.empty()) causes.push_back(std::move(cause));
  }
  return causes;
}

template std::vector<std::string> free_rigid_motions<2>(const model::Model<2>&);
template std::vector<std::string> free_rigid_motions<3>(const model::Model<3>&);
template std::vector<std::string> likely_causes<2>(const scene::Scene&, const model::Model<2>&,
                                                   const model::State<2>&);
template std::vector<std::string> likely_causes<3>(const scene::Scene&, const model::Model<3>&,
                                                   const model::State<3>&);

}  // namespace stepping
