#include "model/initial_equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "constitutive/material.hpp"
#include "constitutive/tensor.hpp"
#include "model/initial_stress.hpp"
#include "model/refusal.hpp"
#include "model/side_points.hpp"
#include "model/surface.hpp"
#include "scene/derived.hpp"
#include "scene/drives.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/names.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

constexpr double typed = 1e-5;  // of pressures written with six digits
const char* const kind = "initial_stress.kind";

template <int Dim>
using Tensor = fpm::Tensor<Dim>;

template <int Dim>
std::string text_of(const fpm::Vector<Dim>& place) {
  std::string text = fmt::format("({:.4g}, {:.4g}", place[0], place[1]);
  if (Dim == 3) text += fmt::format(", {:.4g}", place[Dim - 1]);
  return text + ") m";
}

// A place on the surface of the body.
template <int Dim>
struct SurfacePlace {
  fpm::Vector<Dim> at, normal;
  int cut = -1, side = -1, face = -1;
  Tensor<Dim> stress;  // of the ground there
};

fpm::Vector<2> normal_of(const SurfacePiece<2>& piece) {
  const Eigen::Vector2d along = (piece.to - piece.from).normalized();
  return {along.y(), -along.x()};
}
fpm::Vector<3> normal_of(const SurfacePiece<3>& piece) {
  return piece.outward;
}

template <int Dim>
std::vector<SurfacePlace<Dim>> surface_of(const scene::Scene& scene, const Model<Dim>& model) {
  std::vector<SurfacePlace<Dim>> places;
  const auto stress_at = [&](const fpm::Vector<Dim>& place, std::size_t material) {
    return constitutive::spatial_part<Dim>(initial_stress_at<Dim>(scene, place, material));
  };
  for (const SurfacePiece<Dim>& piece : model.surface) {
    const fpm::Vector<Dim> at = middle_of(piece);
    const auto material = model.material[static_cast<std::size_t>(piece.particle)];
    places.push_back(
        {at, normal_of(piece), piece.cut, piece.side, piece.face, stress_at(at, material)});
  }
  for (int f = 0; f < 2 * Dim && model.surface.empty(); ++f) {
    const auto points = side_points(scene, model, static_cast<scene::Side>(f), {}, {}).points;
    for (fpm::Index c = 0; c < points.size(); ++c) {
      const fpm::Vector<Dim> at = points.position.row(c).transpose();
      // A uniform one is in the plane, and in space all of it, the same in all materials.
      places.push_back({at, points.normal.row(c).transpose(), -1, -1, f, stress_at(at, 0)});
    }
  }
  return places;
}

// A pressure, and a shear along the surface that has the body to its left.
template <int Dim>
fpm::Vector<Dim> traction_of(double pressure, double shear, const fpm::Vector<Dim>& normal) {
  fpm::Vector<Dim> traction = -pressure * normal;
  traction[0] -= shear * normal[1];
  traction[1] += shear * normal[0];
  return traction;
}

bool bears_weight(const scene::Scene& scene) {
  return scene.initial_stress.kind == scene::InitialStressKind::geostatic;
}

template <int Dim>
bool is_level_surface(const SurfacePlace<Dim>& place) {
  constexpr double level = 1.0 - 1e-9;
  return place.normal[1] >= level;
}

// What of a stress is not borne at the surface of a body.
template <int Dim>
class Bearing {
 public:
  /// @param scale  [Pa] the largest stress
  Bearing(const scene::Scene& scene, double scale) : scene_(scene), scale_(scale) {}

  fpm::Vector<Dim> missing(const SurfacePlace<Dim>& place) const {
    fpm::Vector<Dim> rest = place.stress * place.normal;
    if (bears_weight(scene_) && is_left_alone(place, rest)) return fpm::Vector<Dim>::Zero();
    if (!is_on_mirror(place)) rest -= given(place);
    if (bears_weight(scene_) && is_pressed_more(place, rest)) return fpm::Vector<Dim>::Zero();
    if (holds_across(place)) rest -= rest.dot(place.normal) * place.normal;
    for (int i = 0; i < Dim; ++i) {
      if (holds_along(place, i)) rest[i] = 0.0;
    }
    return borne_by_contact(place, rest) ? fpm::Vector<Dim>::Zero() : rest;
  }
  bool is_on_mirror(const SurfacePlace<Dim>& place) const {
    return place.face >= 0 && scene::is_mirror(scene_, static_cast<scene::Side>(place.face));
  }

 private:
  // Where geostatic ground bears nothing loads come on top of what is at rest; walls bear it.
  bool is_left_alone(const SurfacePlace<Dim>& place, const fpm::Vector<Dim>& traction) const {
    return traction.norm() <= typed * scale_ ||
           (place.face >= 0 &&
            is_at_wall<Dim>(scene_, static_cast<scene::Side>(place.face), place.at));
  }
  // A level surface may be pressed more than its surcharge does, which settles it.
  bool is_pressed_more(const SurfacePlace<Dim>& place, const fpm::Vector<Dim>& rest) const {
    return is_level_surface(place) && rest.dot(place.normal) >= -typed * scale_;
  }
  const scene::Cutout* cutout(const SurfacePlace<Dim>& place) const {
    return place.cut >= 0 ? &scene_.cutout[static_cast<std::size_t>(place.cut)] : nullptr;
  }
  const scene::OutlineSide* side(const SurfacePlace<Dim>& place) const {
    return place.side >= 0 ? &scene_.side[static_cast<std::size_t>(place.side)] : nullptr;
  }
  // A side that holds by itself, where no support or mirror of the box does.
  const scene::OutlineSide* holder(const SurfacePlace<Dim>& place) const {
    const scene::OutlineSide* of = side(place);
    const bool held =
        place.face >= 0 && scene::is_held(scene_, static_cast<scene::Side>(place.face));
    return of != nullptr && scene::holds(of->kind) && !held ? of : nullptr;
  }

  bool holds_across(const SurfacePlace<Dim>& place) const {
    const scene::Cutout* of = cutout(place);
    const scene::OutlineSide* tied = holder(place);
    return is_on_mirror(place) || (of != nullptr && of->kind == scene::CutoutKind::roller) ||
           (tied != nullptr && tied->kind == scene::OutlineKind::roller);
  }
  bool holds_along(const SurfacePlace<Dim>& place, int axis) const {
    const scene::Cutout* of = cutout(place);
    const scene::OutlineSide* tied = holder(place);
    if (of != nullptr && of->kind == scene::CutoutKind::fixed) return true;
    if (tied != nullptr && tied->kind == scene::OutlineKind::fixed) return true;
    return std::ranges::any_of(scene_.support, [&](const scene::Support& support) {
      return is_at(support, place) && support.method != scene::SupportMethod::penalty &&
             support.method != scene::SupportMethod::contact &&
             std::ranges::count(support.directions, static_cast<scene::Axis>(axis)) > 0;
    });
  }
  bool borne_by_contact(const SurfacePlace<Dim>& place, const fpm::Vector<Dim>& rest) const {
    return std::ranges::any_of(scene_.support, [&](const scene::Support& support) {
      if (!is_at(support, place) || support.method != scene::SupportMethod::contact) return false;
      return is_within(support.contact, rest, place.normal);
    });
  }
  static bool is_at(const scene::Support& support, const SurfacePlace<Dim>& place) {
    return place.face >= 0 && support.side == static_cast<scene::Side>(place.face);
  }
  bool is_within(const scene::Contact& contact, const fpm::Vector<Dim>& traction,
                 const fpm::Vector<Dim>& normal) const {
    constitutive::InterfaceLaw law;
    law.tied = false;
    law.friction_tangent = std::tan(contact.friction_angle * std::numbers::pi / 180.0);
    law.adhesion = contact.adhesion;
    law.tension = contact.tension;
    return is_within(law, traction, normal, scale_);
  }

 public:
  // Whether a face neither slides nor opens under a traction.
  static bool is_within(const constitutive::InterfaceLaw& law, const fpm::Vector<Dim>& traction,
                        const fpm::Vector<Dim>& normal, double scale) {
    if (law.tied) return true;
    const double pull = traction.dot(normal);
    const double shear = (traction - pull * normal).norm();
    const double slack = typed * scale;
    return (law.tension || pull <= slack) &&
           shear <= law.adhesion + law.friction_tangent * std::max(0.0, -pull) + slack;
  }

 private:
  // By loads that act from the start.
  fpm::Vector<Dim> given(const SurfacePlace<Dim>& place) const {
    fpm::Vector<Dim> sum = fpm::Vector<Dim>::Zero();
    const auto constant = [&](const std::string& name) {
      return scene::share_of(scene_, scene::LoadKind::traction, name).constant;
    };
    for (const scene::Traction& traction : scene_.traction) {
      if (place.face != static_cast<int>(traction.side) ||
          !is_within_range<Dim>(scene_, traction.side, place.at, traction.range_min,
                                traction.range_max)) {
        continue;
      }
      sum += constant(traction.name) * Eigen::Map<const fpm::Vector<Dim>>(traction.value.data());
    }
    if (const scene::Cutout* of = cutout(place)) {
      sum += constant(of->name) * traction_of<Dim>(of->pressure, of->shear, place.normal);
    }
    if (const scene::OutlineSide* of = side(place)) {
      if (of->kind == scene::OutlineKind::loaded) {
        sum += traction_of<Dim>(of->pressure, of->shear, place.normal);
      }
    }
    if (is_loaded_by_stress(scene_, place.cut, place.side, place.face)) {
      sum += place.stress * place.normal;
    }
    return sum;
  }

  const scene::Scene& scene_;
  const double scale_;
};

template <int Dim>
std::string words_of(const fpm::Vector<Dim>& traction, const fpm::Vector<Dim>& normal) {
  if constexpr (Dim == 2) {
    const double pressure = -traction.dot(normal);
    const double shear = traction[1] * normal[0] - traction[0] * normal[1];
    const double round_off = 1e-9 * traction.norm();
    if (std::abs(shear) <= round_off) return fmt::format("a pressure of {:.7g} Pa", pressure);
    if (std::abs(pressure) <= round_off) return fmt::format("a shear of {:.7g} Pa", shear);
    return fmt::format("a pressure of {:.7g} and a shear of {:.7g} Pa", pressure, shear);
  } else {
    return fmt::format("a traction of ({:.7g}, {:.7g}, {:.7g}) Pa", traction[0], traction[1],
                       traction[2]);
  }
}

// What to do about a place where something is not borne.
template <int Dim>
std::string advice_on(const scene::Scene& scene, const SurfacePlace<Dim>& place) {
  if (is_loaded_by_stress(scene, place.cut, place.side, place.face)) {
    return "initial_stress.loaded_sides names it, by which it is loaded as it must be: give it no "
           "other load that acts from the start";
  }
  const std::string settle =
      ", or, as the ground is not level, settle it by kind = \"gravity\"; what is to be dug is a "
      "[[region]] that a [[stage]] removes";
  if (bears_weight(scene) && is_level_surface(place)) {
    return "load it as much from the start, by a [[side]] of kind = \"loaded\"" + settle;
  }
  const auto face = static_cast<scene::Side>(place.face);
  const bool is_face = place.face >= 0;
  const bool by_penalty =
      is_face && std::ranges::any_of(scene.support, [&](const auto& support) {
        return support.side == face && support.method == scene::SupportMethod::penalty;
      });
  const bool by_plate =
      is_face && std::ranges::any_of(scene::all_drives(scene), [&](const auto* d) {
        return d->side == face && !d->level &&
               (d->kind == scene::DriveKind::displacement || scene::is_rigid_body(*d));
      });
  const bool elsewhere =
      std::ranges::any_of(scene.support, [](const auto& support) { return !support.side; });
  std::string advice = "hold it there";
  if (by_penalty) advice = "a penalty bears nothing at first: use direct, ghosts or contact";
  if (by_plate) advice = "the plate of a drive bears nothing at first: hold it otherwise";
  if (!by_penalty && !by_plate && elsewhere) advice += " by a support that names its side";
  if (bears_weight(scene)) return advice + settle;
  return advice +
         ", load it as much, or, if the ground goes on, name it in initial_stress.loaded_sides; "
         "what is to be dug is a [[region]] that a [[stage]] removes";
}

template <int Dim>
void check_surface(const scene::Scene& scene, const Model<Dim>& model, double scale) {
  const Bearing<Dim> bearing(scene, scale);
  const SurfacePlace<Dim>* worst = nullptr;
  double most = typed * scale;
  const auto places = surface_of(scene, model);
  for (const SurfacePlace<Dim>& place : places) {
    const double missing = bearing.missing(place).norm();
    if (missing <= most) continue;
    most = missing;
    worst = &place;
  }
  if (worst == nullptr) return;
  const std::string name = name_of_surface(scene, worst->cut, worst->side, worst->face);
  if (bearing.is_on_mirror(*worst)) {
    throw Refusal(kind, fmt::format("found a shear along {}, which is a mirror", name),
                  "what is behind a mirror is sheared the other way: take the whole body, or axes "
                  "along which there is no shear");
  }
  throw Refusal(kind,
                fmt::format("nothing bears {} on {}, at {}",
                            words_of<Dim>(bearing.missing(*worst), worst->normal), name,
                            text_of<Dim>(worst->at)),
                advice_on(scene, *worst));
}

template <int Dim>
void check_interfaces(const Model<Dim>& model, double scale) {
  for (const Interface<Dim>& interface : model.interfaces) {
    if (interface.is_rigid()) continue;
    const auto& points = interface.faces.points;
    for (fpm::Index c = 0; c < points.size(); ++c) {
      const fpm::Vector<Dim> normal = points.normal.row(c).transpose();
      const fpm::Vector<Dim> traction = interface.initial_traction.row(c).transpose();
      if (Bearing<Dim>::is_within(interface.law, traction, normal, scale)) continue;
      throw Refusal(kind,
                    fmt::format("a face between two materials slides or opens under {}, at {}",
                                words_of<Dim>(traction, normal),
                                text_of<Dim>(points.position.row(c).transpose())),
                    "allowed is what the face's friction, adhesion or cohesion bears");
    }
  }
}

template <int Dim>
void check_strength(const scene::Scene& scene, const Model<Dim>& model) {
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const auto k = static_cast<std::size_t>(a);
    const constitutive::StressVector<Dim> stress = model.initial_stress.col(a);
    constitutive::PointState<Dim> before, after;
    before.stress = stress;
    const auto outcome = constitutive::update<Dim>(model.laws[model.law[k]], stress, before, after);
    if (!outcome.failed && (after.stress - stress).norm() <= typed * stress.norm()) continue;
    const constitutive::StressVector<Dim> borne = after.stress;
    throw Refusal(
        kind,
        fmt::format("the material \"{}\" does not bear this stress at {}: it would yield to "
                    "({:.4g}, {:.4g}, {:.4g}, {:.4g}) Pa, of x, y, z and xy",
                    scene.material[model.material[k]].name,
                    text_of<Dim>(model.particles.position.row(a).transpose()), borne[0], borne[1],
                    borne[2], borne[3]),
        "allowed are stresses within its strength");
  }
}

}  // namespace

template <int Dim>
void check_stress_at_rest(const scene::Scene& scene, const Model<Dim>& model) {
  const bool uniform = scene.initial_stress.kind == scene::InitialStressKind::uniform;
  // A box moves at first where nothing bears what its geostatic stress presses with.
  if (!uniform && (!bears_weight(scene) || scene.region.empty())) return;
  const double scale = model.initial_stress.colwise().norm().maxCoeff();
  check_surface(scene, model, scale);
  check_interfaces(model, scale);
  if (uniform) check_strength(scene, model);
}

template void check_stress_at_rest<2>(const scene::Scene&, const Model<2>&);
template void check_stress_at_rest<3>(const scene::Scene&, const Model<3>&);

}  // namespace model
