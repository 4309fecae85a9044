#pragma once

#include <optional>

#include "model/model.hpp"

namespace equilibrium {

/// What a plate's points feel, in one evaluation.
template <int Dim>
struct PlatePoints {
  const model::Interface<Dim>& interface;
  const constitutive::InterfaceLaw& divided;  // its law where it is weakened
  Eigen::Ref<const Eigen::Matrix<double, Dim, Eigen::Dynamic>> normal;
  Eigen::Ref<const Eigen::Matrix<double, Dim, Eigen::Dynamic>> slip;  // [m] at the step's start
  const fpm::Field<Dim>& displacement;                                // [m] of the body
  double load = 0.0;                                                  // parameter
};

/// Motion of a rigid plate that is free in some ways, as the body below decides it: the forces at
/// its points are in balance with its load, and the moment about the point at which it is pushed or
/// loaded is zero. So the plate adds no unknowns to the body's equilibrium, but is a law of its
/// own, which couples its points. Newton's method with the points' tangents, from the rigid motion
/// that fits the body best: a function of the body's displacement and the state at the step's
/// start.
/// @returns nothing if there is no such motion, as when the whole plate lifts off
template <int Dim>
std::optional<typename model::Plate<Dim>::Motion> plate_motion(const PlatePoints<Dim>& points);

/// How a plate yields to the body: the change of its motion with the forces of its points and with
/// its load.
template <int Dim>
class PlateTangent {
 public:
  using Motion = typename model::Plate<Dim>::Motion;

  /// @param tangent  [Pa/m] Dim^2 x points, of each point at the plate's motion
  PlateTangent(const model::Interface<Dim>& interface,
               Eigen::Ref<const Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>> tangent);

  /// Change of motion when the body moves along `direction` and the load parameter changes.
  Motion motion(const fpm::FieldView<Dim>& direction, double load_change) const;

 private:
  using Square = Eigen::Matrix<double, model::Plate<Dim>::motions, model::Plate<Dim>::motions>;

  const model::Interface<Dim>& interface_;
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> tangent_;
  Square compliance_;  // of the free motions
};

}  // namespace equilibrium
