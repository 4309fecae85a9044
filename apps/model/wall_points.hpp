#pragma once

#include <optional>
#include <vector>

#include "model/model.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// A piece of a body's surface, and what acts on it, as far as the scene says so.
template <int Dim>
struct WallPoint {
  fpm::Vector<Dim> position;  // [m]
  fpm::Vector<Dim> normal;    // outward, unit
  double area = 0.0;          // [m^(Dim-1)]
  fpm::Index particle = -1;   // whose surface it is; -1: the nearest one's
  // [Pa] Traction that stays, and what load parameter 1 adds; nothing where it is held or meets
  // another body.
  fpm::Vector<Dim> constant = fpm::Vector<Dim>::Zero();
  fpm::Vector<Dim> growing = fpm::Vector<Dim>::Zero();
  bool is_known = false;
  bool is_image = false;  // behind a mirror
};

/// The surface of all bodies, at least two points to a spacing, but for mirrors, behind which it
/// goes on as their images do (`mirrors`). Empty for particles on the boundary itself (layout
/// vertex).
template <int Dim>
std::vector<WallPoint<Dim>> wall_points(const scene::Scene& scene, const Model<Dim>& model);

/// The point of a wall next to a place, and how far away [m] it is.
template <int Dim>
struct Foot {
  fpm::Vector<Dim> place;   // [m]
  fpm::Vector<Dim> normal;  // outward, unit
  double distance = 0.0;    // [m]
};

/// That of the nearest piece; nothing if there is none within a reach [m].
template <int Dim>
std::optional<Foot<Dim>> foot_on_wall(const std::vector<WallPoint<Dim>>& walls,
                                      const fpm::Vector<Dim>& place, double reach);

}  // namespace model
