#include "model/thin_tips.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "fpm/rows.hpp"
#include "model/surface.hpp"
#include "scene/cutouts.hpp"
#include "scene/derived.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

using Place = Eigen::Vector2d;

// Places and the particles that are to see them.
struct Beside {
  std::vector<Place> places;
  std::vector<fpm::Index> particles;
  void add(const Place& place, fpm::Index particle) {
    places.push_back(place);
    particles.push_back(particle);
  }
};

fpm::Index body_of(const Model<2>& model, fpm::Index particle) {
  return model.particles.body[static_cast<std::size_t>(particle)];
}

MaterialPair pair_of(const Model<2>& model, const JointPiece<2>& joint) {
  const fpm::Index one = model.material[static_cast<std::size_t>(joint.first)];
  const fpm::Index other = model.material[static_cast<std::size_t>(joint.second)];
  return {std::min(one, other), std::max(one, other)};
}

// What of a piece of the surface has an operator, once bodies are parted.
enum class Points { none, one, all };

// Without the scene's own interfaces the correction is on where bodies are.
bool is_corrected(const scene::Scene& scene) {
  return scene::resolve_consistency(scene) ||
         scene.approximation.consistency == scene::Switch::automatic;
}

// Beyond a plane the body goes on in images, unless the plane is a part of a face.
bool goes_on(const Model<2>& model, int face) {
  if (face < 0) return false;
  const Place middle = 0.5 * (model.box_min + model.box_max);
  return std::ranges::any_of(model.ghosts.planes(), [&](const auto& plane) {
    const bool upper = plane.position > middle[plane.axis];
    return !plane.has_range() && 2 * plane.axis + (upper ? 1 : 0) == face;
  });
}

// As loads.cpp and interfaces.cpp have it.
Points points_on(const scene::Scene& scene, const Model<2>& model, const SurfacePiece<2>& piece) {
  const Points free = is_corrected(scene) ? Points::all : Points::none;
  if (piece.cut >= 0) {
    const scene::Cutout& cutout = scene.cutout[static_cast<std::size_t>(piece.cut)];
    if (cutout.pressure != 0.0 || cutout.shear != 0.0) return Points::all;
    return cutout.kind == scene::CutoutKind::free ? free : Points::one;
  }
  if (piece.side >= 0) {
    const scene::OutlineKind kind = scene.side[static_cast<std::size_t>(piece.side)].kind;
    if (kind == scene::OutlineKind::loaded) return Points::all;
    const bool by_face = piece.face >= 0 && scene::is_held(scene, scene::Side(piece.face));
    if (scene::holds(kind) && !by_face) return Points::one;
  }
  return goes_on(model, piece.face) ? Points::none : free;
}

Beside places_of(const scene::Scene& scene, const Model<2>& model) {
  Beside beside;
  for (const JointPiece<2>& joint : model.joints) {
    if (body_of(model, joint.first) == body_of(model, joint.second)) continue;
    for (const fpm::Index a : {joint.first, joint.second}) {
      beside.add(0.5 * (joint.from + joint.to), a);
    }
  }
  for (const SurfacePiece<2>& piece : model.surface) {
    const Points points = points_on(scene, model, piece);
    if (points == Points::none) continue;
    const int count = points == Points::one ? 1 : point_count(model, piece);
    for (int k = 0; k < count; ++k) {
      beside.add(piece.from + (k + 0.5) / count * (piece.to - piece.from), piece.particle);
    }
  }
  return beside;
}

// The first of some places that the particles beside it do not see.
std::optional<std::size_t> first_blind(const Model<2>& model, const Beside& beside) {
  fpm::Field<2> positions(static_cast<Eigen::Index>(beside.places.size()), 2);
  for (std::size_t k = 0; k < beside.places.size(); ++k) {
    positions.row(static_cast<Eigen::Index>(k)) = beside.places[k].transpose();
  }
  try {
    static_cast<void>(fpm::PointOperator<2>(model.particles, model.ghosts, positions,
                                            model.row_options, beside.particles));
  } catch (const fpm::PoorNeighbourhood& blind) {
    return static_cast<std::size_t>(blind.index());
  }
  return std::nullopt;
}

double distance(const Place& place, const JointPiece<2>& joint) {
  const Place along = joint.to - joint.from;
  const double t = (place - joint.from).dot(along) / along.squaredNorm();
  return (joint.from + std::clamp(t, 0.0, 1.0) * along - place).norm();
}

// Pairs that meet at the body of a particle, as near to a place as it sees, the nearest first.
std::vector<MaterialPair> pairs_near(const Model<2>& model, const Place& place,
                                     fpm::Index particle) {
  std::map<MaterialPair, double> nearest;
  const double reach = model.row_options.max_enlargement *
                       fpm::support_radius_of(model.particles, particle, model.row_options);
  for (const JointPiece<2>& joint : model.joints) {
    const fpm::Index first = body_of(model, joint.first), second = body_of(model, joint.second);
    const fpm::Index own = body_of(model, particle);
    if (first == second || (first != own && second != own)) continue;
    const MaterialPair pair = pair_of(model, joint);
    const double away = distance(place, joint);
    if (away > reach || pair.first == pair.second) continue;
    const auto [at, is_new] = nearest.try_emplace(pair, away);
    at->second = std::min(at->second, away);
  }
  std::vector<MaterialPair> pairs;
  for (const auto& entry : nearest) pairs.push_back(entry.first);
  std::ranges::stable_sort(pairs, {}, [&](const MaterialPair& pair) { return nearest.at(pair); });
  return pairs;
}

// Of what the scene gives, a pair that would be of one body, and was not.
std::optional<MaterialPair> swallowed(const scene::Scene& scene, const Model<2>& model,
                                      const std::vector<fpm::Index>& apart,
                                      const std::vector<fpm::Index>& body) {
  const auto is_one = [](const std::vector<fpm::Index>& of, const JointPiece<2>& joint) {
    return of.empty() ||
           of[static_cast<std::size_t>(joint.first)] == of[static_cast<std::size_t>(joint.second)];
  };
  for (const JointPiece<2>& joint : model.joints) {
    const MaterialPair pair = pair_of(model, joint);
    if (pair.first == pair.second || is_one(apart, joint) || !is_one(body, joint)) continue;
    if (key_of_given(scene, pair)) return pair;
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const scene::Scene& scene, const MaterialPair& pair,
                         const std::string& thin, const Place& place) {
  const auto one = static_cast<std::size_t>(pair.first);
  const auto other = static_cast<std::size_t>(pair.second);
  const bool is_contact =
      scene::interface_between(scene, one, other).kind == scene::InterfaceKind::contact;
  throw InterfaceRefused(
      *key_of_given(scene, pair),
      fmt::format("found \"{}\" between \"{}\" and \"{}\", which would be of one body: at ({:.4g}, "
                  "{:.4g}) m \"{}\" runs out into a tip too thin for rows of its own",
                  is_contact ? "contact" : "tied", scene.material[one].name,
                  scene.material[other].name, place.x(), place.y(), thin),
      "allowed are \"through\", a blunter tip, or another geometry.spacing, of which the tip has "
      "more particles");
}

}  // namespace

void join_thin_tips(const scene::Scene& scene, const Parting& parted, Model<2>& model) {
  model.joined_faces.clear();
  if (model.row_options.support_radius <= 0.0) return;  // of a section, no rows
  const std::vector<fpm::Index> apart = model.particles.body;
  std::set<MaterialPair> joined;
  while (!model.particles.body.empty() && !model.joints.empty()) {
    const Beside beside = places_of(scene, model);
    const auto blind = first_blind(model, beside);
    if (!blind) return;
    const Place& place = beside.places[*blind];
    const fpm::Index particle = beside.particles[*blind];
    std::optional<MaterialPair> refused, taken;
    std::vector<fpm::Index> body;
    for (const MaterialPair& pair : pairs_near(model, place, particle)) {
      std::set<MaterialPair> more = joined;
      if (!more.insert(pair).second) continue;
      body = parted(more);
      const auto lost = swallowed(scene, model, apart, body);
      if (!lost) {
        taken = pair;
        joined = std::move(more);
        break;
      }
      if (!refused) refused = lost;
    }
    const std::string& thin =
        scene.material[model.material[static_cast<std::size_t>(particle)]].name;
    if (!taken && refused) refuse(scene, *refused, thin, place);
    if (!taken) return;  // who has a point there says so
    model.particles.body = std::move(body);
    model.joined_faces.push_back({taken->first, taken->second, place});
  }
}

}  // namespace model
