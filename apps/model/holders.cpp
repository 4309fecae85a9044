#include "model/holders.hpp"

#include <algorithm>

#include "model/planes.hpp"
#include "model/selection.hpp"
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
    if (method == scene::SupportMethod::ghosts) {
      if (scene.geometry.layout == scene::Layout::cell) particles.clear();
      particles = behind(model, *support.side, scene::side_position(scene.geometry, *support.side),
                         particles);
    }
    add({support.name, support.side, !support.side}, unknowns_of(model, particles, directions));
  }
  for (const scene::ActingDrive& acting : scene::acting_drives(scene)) {
    const scene::Drive& drive = *acting.drive;
    if (drive.kind != scene::DriveKind::displacement ||
        drive.method == scene::DriveMethod::contact) {
      continue;
    }
    std::vector<int> directions;
    for (int i = 0; i < Dim; ++i) {
      const bool moved = drive.direction[static_cast<std::size_t>(i)] != 0.0;
      if (moved || drive.lateral == scene::Lateral::fixed) directions.push_back(i);
    }
    std::vector<Eigen::Index> particles = driven_particles(scene, drive, model);
    if (scene::resolve_drive_method(scene, drive) == scene::DriveMethod::ghosts) {
      if (scene.geometry.layout == scene::Layout::cell) particles.clear();
      particles =
          behind(model, drive.side, scene::plate_position(scene.geometry, drive), particles);
    }
    const auto side = drive.level ? std::nullopt : std::optional(drive.side);
    add({scene::name_of_drive(drive), side, false}, unknowns_of(model, particles, directions));
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
    return holders_[h].side && scene::axis_of(*holders_[h].side) == axis;
  };
  const auto across = std::ranges::count_if(all, lies_across);
  if (across == 0) return 1.0 / static_cast<double>(all.size());
  return lies_across(holder) ? 1.0 / static_cast<double>(across) : 0.0;
}

template <int Dim>
typename Holders<Dim>::Shares Holders<Dim>::of(const std::string& name) const {
  Shares shares;
  for (const auto& [unknown, all] : holding_) {
    for (const std::size_t h : all) {
      if (holders_[h].name != name) continue;
      if (const double part = share(unknown, h); part > 0.0) shares.emplace_back(unknown, part);
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
      if (part > 0.0) shares.emplace_back(unknown, part);
    }
  }
  return shares;
}

template class Holders<2>;
template class Holders<3>;

}  // namespace model
