#pragma once

#include <functional>
#include <set>
#include <vector>

#include "model/given_interface.hpp"
#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// Bodies of particles if faces between some materials are none; empty if there is one.
using Parting = std::function<std::vector<fpm::Index>(const std::set<MaterialPair>& joined)>;

/// Joins, in a plane body of regions, what is tied by default where one of the two runs out into a
/// tip whose particles lie too much in a line for points to be seen: one pair after the other, the
/// one nearest to such a point, until all are seen. Into the particles' bodies and `joined_faces`.
/// @param model  with bodies as `parted({})` has them
/// @throws InterfaceRefused if a contact, or what the scene says is tied, would have to go
void join_thin_tips(const scene::Scene& scene, const Parting& parted, Model<2>& model);

}  // namespace model
