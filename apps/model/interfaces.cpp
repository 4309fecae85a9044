#include "model/interfaces.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "constitutive/tensor.hpp"
#include "model/initial_stress.hpp"
#include "model/selection.hpp"
#include "model/surface.hpp"
#include "scene/course.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Pair = std::pair<fpm::Index, fpm::Index>;  // of materials, the smaller first

// Times Young's modulus over the spacing, of soil that yields below a plate that turns or is
// loaded: ten times as stiff its opening and closing takes more than ten times the evaluations, or
// fails.
constexpr double free_plates_stiffness = 1.0;

// Of tied soils, over the stiffness across: one Young's modulus per spacing, a
// third of what a spacing of soil gives way in shear. As stiff as across, faces of soils that flow
// cost several times the evaluations.
constexpr double soils_shear_stiffness = 0.1;

constitutive::InterfaceLaw law_of(const scene::Contact& contact) {
  constitutive::InterfaceLaw law;
  law.tied = false;
  law.friction_tangent = std::tan(contact.friction_angle * std::numbers::pi / 180.0);
  law.adhesion = contact.adhesion;
  law.tension = contact.tension;
  return law;
}

// The law of a tied face, and of its adhesion what is of materials whose strength is divided, and
// what is of others.
struct TiedLaw {
  constitutive::InterfaceLaw law{};
  double divided = std::numeric_limits<double>::infinity();  // [Pa]
  double kept = std::numeric_limits<double>::infinity();     // [Pa]
};

// Clay that is tied bears no more along its face than its cohesion. Rows that end there would smear
// the slip over a spacing instead, and a layer that is squeezed would bear more
// (share/doc/decisions/interfaces.md). Slip along soil with friction dilates, which a face does
// not; in finite strain slips would outgrow the spacing, and points keep their partners.
TiedLaw law_of_tied(const scene::Scene& scene, const Pair& materials,
                    std::span<const double> place) {
  TiedLaw tied;
  constitutive::InterfaceLaw& law = tied.law;
  const bool slips = scene.approximation.kinematics == scene::KinematicsKind::small_strain;
  for (const fpm::Index m : {materials.first, materials.second}) {
    const scene::Material& material = scene.material[static_cast<std::size_t>(m)];
    if (!scene::yields(material)) continue;
    law.shear_stiffness = soils_shear_stiffness;
    const auto p = scene::parameters_at(material, place);
    // A face does not harden or soften with the ground on either side, nor is its strength curved.
    const bool changes =
        std::isfinite(p.residual_strain) || !scene::model_of(material).is_cohesive();
    if (p.friction_angle > 0.0 || changes || !slips) continue;
    double& adhesion = scene::is_weakened(scene, material.name) ? tied.divided : tied.kept;
    adhesion = std::min(adhesion, p.cohesion);
    law.adhesion = std::min(tied.divided, tied.kept);
    law.tied = false;
    law.tension = true;
  }
  return tied;
}

// The part of some faces that `chosen` holds.
template <int Dim, class Chosen>
fpm::CommonFaces<Dim> part_of(const fpm::CommonFaces<Dim>& faces, Chosen&& chosen) {
  std::vector<Eigen::Index> kept;
  fpm::CommonFaces<Dim> part;
  for (Eigen::Index c = 0; c < faces.points.weight.size(); ++c) {
    if (!chosen(c)) continue;
    kept.push_back(c);
    part.first.push_back(faces.first[static_cast<std::size_t>(c)]);
    if (!faces.second.empty()) part.second.push_back(faces.second[static_cast<std::size_t>(c)]);
  }
  part.points.position = faces.points.position(kept, Eigen::all);
  part.points.normal = faces.points.normal(kept, Eigen::all);
  part.points.weight = faces.points.weight(kept);
  return part;
}

template <int Dim>
const scene::Material& material_of(const scene::Scene& scene, const Model<Dim>& model,
                                   fpm::Index particle) {
  return scene.material[model.material[static_cast<std::size_t>(particle)]];
}

// Traction of the initial stress: the mean of what either material's is there.
template <int Dim>
fpm::Vector<Dim> initial_traction(const scene::Scene& scene, const Model<Dim>& model,
                                  const fpm::CommonFaces<Dim>& faces, std::size_t c) {
  if (model.initial_stress.size() == 0) return fpm::Vector<Dim>::Zero();
  const auto row = static_cast<Eigen::Index>(c);
  const fpm::Vector<Dim> place = faces.points.position.row(row).transpose();
  const auto of = [&](fpm::Index a) {
    return constitutive::spatial_part<Dim>(
        initial_stress_at<Dim>(scene, place, model.material[static_cast<std::size_t>(a)]));
  };
  fpm::Tensor<Dim> stress = of(faces.first[c]);
  if (!faces.second.empty()) stress = 0.5 * (stress + of(faces.second[c]));
  return stress * faces.points.normal.row(row).transpose();
}

template <int Dim>
void mark_weakened(const scene::Scene& scene, const Model<Dim>& model,
                   const fpm::CommonFaces<Dim>& faces, Interface<Dim>& interface) {
  interface.divided_adhesion = interface.law.adhesion;
  if (!scene::reduces_strength(scene)) return;
  const auto is_weakened = [&](fpm::Index a) {
    return scene::is_weakened(scene, material_of(scene, model, a).name);
  };
  for (std::size_t c = 0; c < faces.first.size(); ++c) {
    const bool second = !faces.second.empty() && is_weakened(faces.second[c]);
    interface.weakens.push_back(second || is_weakened(faces.first[c]) ? 1 : 0);
  }
}

template <int Dim>
Interface<Dim> interface_at(const scene::Scene& scene, const Model<Dim>& model,
                            const fpm::CommonFaces<Dim>& faces, const scene::Contact& contact,
                            const constitutive::InterfaceLaw& law) {
  Interface<Dim> interface;
  interface.law = law;
  interface.faces.points = faces.points;
  const auto operator_of = [&](const std::vector<fpm::Index>& particles) {
    return fpm::PointOperator<Dim>(model.particles, model.ghosts, faces.points.position,
                                   model.row_options, particles);
  };
  interface.faces.first = operator_of(faces.first);
  if (!faces.second.empty()) interface.faces.second = operator_of(faces.second);
  mark_weakened(scene, model, faces, interface);
  const Eigen::Index count = faces.points.weight.size();
  interface.stiffness.resize(count);
  interface.initial_traction.resize(count, Dim);
  for (Eigen::Index c = 0; c < count; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const scene::Material& one = material_of(scene, model, faces.first[k]);
    const scene::Material& other =
        faces.second.empty() ? one : material_of(scene, model, faces.second[k]);
    const fpm::Index beyond = faces.second.empty() ? faces.first[k] : faces.second[k];
    const bool yields = scene::yields(one) || scene::yields(other);
    const auto modulus = [&](fpm::Index a, const scene::Material& material) {
      return model.youngs_modulus_of(a) *
             (yields ? 1.0 : scene::modulus_ratio_of_springs(material));
    };
    const double softer = std::min(modulus(faces.first[k], one), modulus(beyond, other));
    const double spacing = std::min(model.spacing_at(faces.first[k]), model.spacing_at(beyond));
    interface.stiffness[c] = scene::resolve_stiffness_factor(contact, yields) * softer / spacing;
    interface.initial_traction.row(c) = initial_traction(scene, model, faces, k).transpose();
  }
  return interface;
}

// Of what cutouts leave of the faces between cells, where two bodies meet.
template <int Dim>
fpm::CommonFaces<Dim> common_faces(const scene::Scene& scene, const Model<Dim>& model) {
  if (!model.joints.empty()) return joint_faces(model);
  auto faces = fpm::common_faces(model.cells, model.particles.body);
  if constexpr (Dim == 2) {
    if (model.surface.empty()) return faces;
    const shape::Body body = scene::body_of(scene);
    for (Eigen::Index c = 0; c < faces.points.weight.size(); ++c) {
      const fpm::Vector<2> middle = faces.points.position.row(c).transpose();
      const fpm::Vector<2> normal = faces.points.normal.row(c).transpose();
      const fpm::Vector<2> half =
          0.5 * faces.points.weight[c] * fpm::Vector<2>(-normal[1], normal[0]);
      const shape::Stretch left = body.along(middle - half, middle + half);
      faces.points.weight[c] = left.length;
      if (left.length > 0.0) faces.points.position.row(c) = left.middle.transpose();
    }
    constexpr double sliver = 1e-9;
    return part_of<2>(
        faces, [&](Eigen::Index c) { return faces.points.weight[c] > sliver * model.spacing; });
  }
  return faces;
}

// The cells' faces at a side of the box, or what cutouts leave of it.
template <int Dim>
fpm::CommonFaces<Dim> outer_faces(const Model<Dim>& model, const fpm::Face& face) {
  return model.surface.empty() ? fpm::outer_faces(model.cells, face)
                               : surface_faces(model, SurfacePart::of_face(face));
}

template <int Dim>
void add_between_materials(const scene::Scene& scene, Model<Dim>& model) {
  if (model.particles.body.empty()) return;
  const auto faces = common_faces(scene, model);
  const auto pair_of = [&](Eigen::Index c) {
    const auto k = static_cast<std::size_t>(c);
    const fpm::Index one = model.material[static_cast<std::size_t>(faces.first[k])];
    const fpm::Index other = model.material[static_cast<std::size_t>(faces.second[k])];
    return Pair(std::min(one, other), std::max(one, other));
  };
  const auto rule_of = [&](const Pair& pair) {
    return scene::interface_between(scene, static_cast<std::size_t>(pair.first),
                                    static_cast<std::size_t>(pair.second));
  };
  const auto law_at = [&](Eigen::Index c) {
    const scene::Interface rule = rule_of(pair_of(c));
    const fpm::Vector<Dim> place = faces.points.position.row(c).transpose();
    if (rule.kind != scene::InterfaceKind::contact) {
      return law_of_tied(scene, pair_of(c), {place.data(), Dim});
    }
    TiedLaw contact{law_of(rule.contact)};
    contact.divided = contact.law.adhesion;
    return contact;
  };
  // What two materials bear along their faces is one law, unless it changes from place to place.
  using Group = std::tuple<Pair, double, double>;
  std::map<Group, Eigen::Index> first_of;
  std::vector<Group> group;
  for (Eigen::Index c = 0; c < faces.points.weight.size(); ++c) {
    const TiedLaw law = law_at(c);
    group.emplace_back(pair_of(c), law.divided, law.kept);
    first_of.try_emplace(group.back(), c);
  }
  for (const auto& entry : first_of) {
    const auto part = part_of<Dim>(
        faces, [&](Eigen::Index c) { return group[static_cast<std::size_t>(c)] == entry.first; });
    const auto [one, other] = std::get<Pair>(entry.first);
    const TiedLaw law = law_at(entry.second);
    try {
      model.interfaces.push_back(
          interface_at(scene, model, part, rule_of({one, other}).contact, law.law));
      model.interfaces.back().divided_adhesion = law.divided;
      model.interfaces.back().kept_adhesion = law.kept;
    } catch (const fpm::PoorNeighbourhood& poor) {
      throw fpm::PoorNeighbourhood(
          fmt::format("interface between \"{}\" and \"{}\": {}",
                      scene.material[static_cast<std::size_t>(one)].name,
                      scene.material[static_cast<std::size_t>(other)].name, poor.what()),
          poor.index());
    }
  }
}

template <int Dim>
fpm::Face face_of(scene::Side side) {
  return {scene::axis_of(side), scene::is_upper(side)};
}

// A plate that is loaded sinks in, one that has a point at which it is pushed or loaded turns about
// it, and `lateral` lets it move along its side, if its face sticks.
template <int Dim>
Plate<Dim> plate_of(const scene::ActingDrive& acting, const Interface<Dim>& interface) {
  const scene::Drive& drive = *acting.drive;
  Plate<Dim> plate;
  const int across = scene::axis_of(drive.side);
  const fpm::Field<Dim>& places = interface.faces.points.position;
  plate.at = places.colwise().mean().transpose();
  plate.arm = 0.5 * (places.colwise().maxCoeff() - places.colwise().minCoeff()).maxCoeff();
  plate.reported = acting.reported;
  if (!drive.force.empty()) {
    const Eigen::Map<const fpm::Vector<Dim>> whole(drive.force.data());
    if (acting.moves) {
      plate.force = whole;
    } else {
      plate.held_force = acting.held * whole;
    }
  }
  const bool sticks = constitutive::sticks(interface.law);
  std::size_t k = 0;
  for (int i = 0; i < Dim; ++i) {
    const auto axis = static_cast<std::size_t>(i);
    if (i == across) {
      plate.free[axis] = drive.kind == scene::DriveKind::load;
      continue;
    }
    plate.free[axis] = drive.lateral == scene::Lateral::free && sticks &&
                       (drive.direction.empty() || drive.direction[axis] == 0.0);
    if (!drive.at.empty()) plate.at[i] = drive.at[k++];
  }
  for (int i = 0; i < Plate<Dim>::motions - Dim; ++i) {
    // About its normal a smooth plate is not held by anything.
    const bool spins = Dim == 3 && i == across;
    plate.free[static_cast<std::size_t>(Dim + i)] = !drive.at.empty() && (!spins || sticks);
  }
  return plate;
}

template <int Dim>
fpm::CommonFaces<Dim> faces_under_plate(const scene::Scene& scene, const scene::Drive& drive,
                                        const Model<Dim>& model) {
  if (drive.level) return surface_faces(model, SurfacePart::of_side(*scene::footing_of(scene)));
  const auto faces = outer_faces(model, face_of<Dim>(drive.side));
  return part_of<Dim>(faces, [&](Eigen::Index c) {
    return in_side_range(scene, model, drive.side, drive.range_min, drive.range_max,
                         faces.first[static_cast<std::size_t>(c)]);
  });
}

// What is tied, but free along the side, is held across it whichever way it is pulled.
constitutive::InterfaceLaw law_of_plate(const scene::Drive& drive) {
  if (drive.method != scene::DriveMethod::tied) return law_of(drive.contact);
  constitutive::InterfaceLaw law;
  if (drive.lateral == scene::Lateral::fixed) return law;
  law.tied = false;
  law.tension = true;
  return law;
}

// The rigid plate of a drive that only touches.
template <int Dim>
void add_plate(const scene::Scene& scene, const scene::ActingDrive& acting, Model<Dim>& model) {
  const scene::Drive& drive = *acting.drive;
  const bool pushes = drive.kind == scene::DriveKind::displacement;
  const auto under = faces_under_plate(scene, drive, model);
  const bool is_free = !pushes || !drive.at.empty();
  scene::Contact contact = drive.contact;
  if (is_free && model.layout.plastic && !contact.stiffness_factor) {
    contact.stiffness_factor = free_plates_stiffness;
  }
  Interface<Dim> plate = interface_at(scene, model, under, contact, law_of_plate(drive));
  // The plate bears nothing at first, whatever lies under it.
  plate.initial_traction.setZero();
  plate.of_drive = scene::name_of_drive(drive);
  if (pushes) {
    const fpm::Vector<Dim> along =
        Eigen::Map<const fpm::Vector<Dim>>(drive.direction.data()).normalized();
    if (acting.reported) plate.measure = along;
    (acting.moves ? plate.drive : plate.held) =
        (acting.moves ? 1.0 : acting.held) * drive.target * along;
  }
  if (is_free) plate.plate = plate_of(acting, plate);
  model.interfaces.push_back(std::move(plate));
}

template <int Dim>
void add_rigid(const scene::Scene& scene, Model<Dim>& model) {
  for (const scene::Support& support : scene.support) {
    if (support.method != scene::SupportMethod::contact) continue;
    const auto faces = outer_faces(model, face_of<Dim>(*support.side));
    model.interfaces.push_back(
        interface_at(scene, model, faces, support.contact, law_of(support.contact)));
    model.interfaces.back().support = support.name;
  }
  for (const scene::ActingDrive& acting : scene::acting_drives(scene)) {
    if (scene::is_rigid_body(*acting.drive)) add_plate(scene, acting, model);
  }
}

SurfacePart held_part(const scene::Scene& scene, std::size_t side) {
  SurfacePart part = SurfacePart::of_side(side);
  for (int face = 0; face < 2 * scene.geometry.dimension; ++face) {
    part.without[static_cast<std::size_t>(face)] =
        scene::is_held(scene, static_cast<scene::Side>(face));
  }
  return part;
}

template <int Dim>
void add_cutouts(const scene::Scene& scene, Model<Dim>& model) {
  scene::Contact smooth;  // a roller: held across, whichever way it is pulled
  smooth.tension = true;
  for (std::size_t i = 0; i < scene.cutout.size(); ++i) {
    const scene::Cutout& cutout = scene.cutout[i];
    if (cutout.kind == scene::CutoutKind::free) continue;
    const auto law =
        cutout.kind == scene::CutoutKind::fixed ? constitutive::InterfaceLaw{} : law_of(smooth);
    model.interfaces.push_back(
        interface_at(scene, model, surface_faces(model, SurfacePart::of_cutout(i)), smooth, law));
    model.interfaces.back().support = cutout.name;
    model.interfaces.back().is_boundary = true;
  }
}

// What sides hold where no support or mirror of the box does.
template <int Dim>
void add_held_sides(const scene::Scene& scene, Model<Dim>& model) {
  scene::Contact smooth;
  smooth.tension = true;
  for (std::size_t i = 0; i < scene.side.size(); ++i) {
    const scene::OutlineSide& side = scene.side[i];
    if (!scene::holds(side.kind)) continue;
    const auto faces = surface_faces(model, held_part(scene, i));
    if (faces.points.size() == 0) continue;
    const auto law =
        side.kind == scene::OutlineKind::fixed ? constitutive::InterfaceLaw{} : law_of(smooth);
    model.interfaces.push_back(interface_at(scene, model, faces, smooth, law));
    model.interfaces.back().support = side.name;
    model.interfaces.back().is_boundary = true;
  }
}

}  // namespace

template <int Dim>
void add_interfaces(const scene::Scene& scene, Model<Dim>& model) {
  add_between_materials(scene, model);
  add_rigid(scene, model);
  add_cutouts(scene, model);
  add_held_sides(scene, model);
}

template void add_interfaces<2>(const scene::Scene&, Model<2>&);
template void add_interfaces<3>(const scene::Scene&, Model<3>&);

}  // namespace model
