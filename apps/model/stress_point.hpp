#pragma once

#include <optional>
#include <vector>

#include "model/model.hpp"
#include "model/state.hpp"
#include "model/wall_points.hpp"
#include "model/wall_stress.hpp"
#include "shape/outline.hpp"

namespace scene {
struct Scene;
}

namespace model {

/// What the particles around a place say of the stress there.
template <int Dim>
struct InterpolatedStress {
  fpm::PointOperator<Dim> point;
  // Of its mean, from further around, where the particles' own alternates.
  std::optional<fpm::PointOperator<Dim>> mean;

  [[nodiscard]] constitutive::StressVector<Dim> of(const State<Dim>& state) const;  // [Pa]
};

/// A point at which a stress is asked for.
template <int Dim>
struct StressPoint {
  /// By how much the particles are wrong on the wall, of which a share counts where the point is.
  struct NextToWall {
    InterpolatedStress<Dim> foot;
    WallStress<Dim> fit;
    double share = 1.0;
  };

  fpm::Index particle = 0;  // whose body and material it is of
  // Nothing where particles are too few for a gradient: the stress is that of the particle.
  std::optional<InterpolatedStress<Dim>> around;
  std::optional<NextToWall> wall;  // of a point next to one

  [[nodiscard]] constitutive::StressVector<Dim> of(const State<Dim>& state) const;  // [Pa]
};

/// Finds the particles that say the stress at a point.
template <int Dim>
class StressPoints {
 public:
  /// @param scene, model  must outlive it, and the model what it finds
  StressPoints(const scene::Scene& scene, const Model<Dim>& model);

  /// @param asked  [m] one coordinate for each dimension
  /// @throws std::runtime_error if it is too far from all particles.
  [[nodiscard]] StressPoint<Dim> at(const std::vector<double>& asked) const;

 private:
  [[nodiscard]] InterpolatedStress<Dim> around(const fpm::Vector<Dim>& place, fpm::Index own) const;

  const scene::Scene& scene_;
  const Model<Dim>& model_;
  std::optional<shape::Outline> outline_;  // of plane regions and prisms
  fpm::ParticleSet<Dim> particles_;        // a body for each material
  std::vector<WallPoint<Dim>> walls_;
};

}  // namespace model
