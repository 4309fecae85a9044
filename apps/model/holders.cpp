#include "model/holders.hpp"

#include <algorithm>

#include "model/planes.hpp"
#include "model/selection.hpp"
#include "model/state.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

template <int Dim>
std::vector<Eigen::Index> unknowns_of(const Model<Dim>& model,
                                      const std::vector<Eigen::Index>& particles,
                                      const std::vector<int>& directions) {
  std::vector<Eigen::Index> unknowns;
  for (const int i : directions) {
    for (const Eigen::Index a : particles) unknowns.push_back(i * model.size() + a);
  }
  return unknowns;
}

// What is held by images, and by particles on the face itself.
template <int Dim>
std::vector<Eigen::Index> behind(const Model<Dim>& model, scene::Side side, double position,
                                 const std::vector<Eigen::Index>& on_face) {
  std::vector<Eigen::Index> particles = sources_of_planes(model, scene::axis_of(side), position);
  particles.insert(particles.end(), on_face.begin(), on_face.end());
  std::ranges::sort(particles);
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  return particles;
}

}  // namespace

template <int Dim>
Holders<Dim>::Holders(const scene::Scene& scene, const Model<Dim>& model)
    : particles_(model.size()) {
  for (const scene::Support& support : scene.support) {
    const scene::SupportMethod method = scene::resolve_method(scene, support);
    if (method == scene::SupportMethod::penalty || method == scene::SupportMethod::contact) {
      continue;
    }
    std::vector<int> directions;
    for (const scene::Axis axis : support.directions) directions.push_back(static_cast<int>(axis));
    std::vector<Eigen::Index> particles = supported_particles(scene, support, model);
    Holder holder{support.name, support.side, support.side, !support.side};
    holder.images = method == scene::SupportMethod::ghosts;
    if (holder.images && scene.geometry.layout == scene::Layout::cell) particles.clear();
    const auto themselves = unknowns_of(model, particles, directions);
    holder.by_particles.insert(themselves.begin(), themselves.end());
    if (holder.images) {
      particles = behind(model, *support.side, scene::side_position(scene.geometry, *support.side),
                         particles);
    }
    add(std::move(holder), unknowns_of(model, particles, directions));
  }
  for (const scene::ActingDrive& acting : scene::acting_drives(scene)) {
    const scene::Drive& drive = *acting.drive;
    if (drive.kind != scene::DriveKind::displacement || scene::is_rigid_body(drive)) {
      continue;
    }
    std::vector<int> directions;
    for (int i = 0; i < Dim; ++i) {
      const bool moved = drive.direction[static_cast<std::size_t>(i)] != 0.0;
      if (moved || drive.lateral == scene::Lateral::fixed) directions.push_back(i);
    }
    std::vector<Eigen::Index> particles = driven_particles(scene, drive, model);
    Holder holder{scene::name_of_drive(drive),
                  drive.level ? std::nullopt : std::optional(drive.side), drive.side, false};
    holder.images = scene::resolve_drive_method(scene, drive) == scene::DriveMethod::ghosts;
    if (holder.images && scene.geometry.layout == scene::Layout::cell) particles.clear();
    const auto themselves = unknowns_of(model, particles, directions);
    holder.by_particles.insert(themselves.begin(), themselves.end());
    if (holder.images) {
      particles =
          behind(model, drive.side, scene::plate_position(scene.geometry, drive), particles);
    }
    add(std::move(holder), unknowns_of(model, particles, directions));
  }
}

template <int Dim>
void Holders<Dim>::add(Holder holder, const std::vector<Eigen::Index>& unknowns) {
  const std::size_t number = holders_.size();
  holders_.push_back(std::move(holder));
  for (const Eigen::Index k : unknowns) holding_[k].push_back(number);
}

template <int Dim>
double Holders<Dim>::share(Eigen::Index unknown, std::size_t holder) const {
  const std::vector<std::size_t>& all = holding_.at(unknown);
  const auto axis = static_cast<int>(unknown / particles_);
  const auto lies_across = [&](std::size_t h) {
    return holders_[h].faces && scene::axis_of(*holders_[h].faces) == axis;
  };
  const auto across = std::ranges::count_if(all, lies_across);
  if (across == 0) return 1.0 / static_cast<double>(all.size());
  return lies_across(holder) ? 1.0 / static_cast<double>(across) : 0.0;
}

template <int Dim>
bool Holders<Dim>::are_opposite() const {
  return std::ranges::any_of(holding_, [&](const auto& held) { return are_opposite(held.first); });
}

template <int Dim>
bool Holders<Dim>::are_opposite(Eigen::Index unknown) const {
  const auto& all = holding_.at(unknown);
  for (const std::size_t one : all) {
    const Holder& by_images = holders_[one];
    if (!by_images.images || share(unknown, one) == 0.0) continue;
    for (const std::size_t other : all) {
      const auto& side = holders_[other].faces;
      if (side && share(unknown, other) > 0.0 && *side != *by_images.faces &&
          scene::axis_of(*side) == scene::axis_of(*by_images.faces)) {
        return true;
      }
    }
  }
  return false;
}

// What images carry is that of their sides. The rest is what particles bear that are held
// themselves, or round-off and what keeps an initial stress at rest.
template <int Dim>
void Holders<Dim>::add_share(Eigen::Index unknown, std::size_t holder, double part,
                             Shares& shares) const {
  if (!are_opposite(unknown)) {
    shares.reaction.emplace_back(unknown, part);
    return;
  }
  const auto& all = holding_.at(unknown);
  const auto count = [&](auto&& is_one) {
    return static_cast<double>(std::ranges::count_if(all, is_one));
  };
  const auto by_particles = [&](std::size_t h) {
    return holders_[h].by_particles.contains(unknown) && share(unknown, h) > 0.0;
  };
  double rest = part;
  if (const double such = count(by_particles); such > 0.0) {
    rest = by_particles(holder) ? part / share(unknown, holder) / such : 0.0;
  }
  if (rest > 0.0) shares.reaction.emplace_back(unknown, rest);
  const Eigen::Index particle = unknown % particles_, direction = unknown / particles_;
  for (int f = 0; f < 2 * Dim; ++f) {
    const auto is_there = [&](std::size_t h) {
      return holders_[h].images && holders_[h].faces == static_cast<scene::Side>(f) &&
             share(unknown, h) > 0.0;
    };
    const double such = count(is_there);
    if (such == 0.0) continue;
    const double own = is_there(holder) ? part / share(unknown, holder) / such : 0.0;
    if (own == rest) continue;
    const Eigen::Index place = particle * State<Dim>::side_rows + f * Dim + direction;
    shares.side_reaction.emplace_back(place, own - rest);
  }
}

template <int Dim>
typename Holders<Dim>::Shares Holders<Dim>::of(const std::string& name) const {
  Shares shares;
  for (const auto& [unknown, all] : holding_) {
    for (const std::size_t h : all) {
      if (holders_[h].name != name) continue;
      if (const double part = share(unknown, h); part > 0.0) add_share(unknown, h, part, shares);
    }
  }
  return shares;
}

template <int Dim>
typename Holders<Dim>::Shares Holders<Dim>::on(const scene::Scene& scene, const Model<Dim>& model,
                                               scene::Side side) const {
  const auto sides_of = [&](Eigen::Index a) {
    std::vector<scene::Side> sides;
    for (int f = 0; f < 2 * Dim; ++f) {
      const auto each = static_cast<scene::Side>(f);
      if (on_side(scene, model, each, a)) sides.push_back(each);
    }
    return sides;
  };
  Shares shares;
  for (const auto& [unknown, all] : holding_) {
    for (const std::size_t h : all) {
      double part = share(unknown, h);
      if (holders_[h].anywhere) {
        const auto sides = sides_of(unknown % particles_);
        if (std::ranges::count(sides, side) == 0) continue;
        part /= static_cast<double>(sides.size());
      } else if (holders_[h].side != side) {
        continue;
      }
      if (part > 0.0) add_share(unknown, h, part, shares);
    }
  }
  return shares;
}

template class Holders<2>;
template class Holders<3>;

}  // namespace model
