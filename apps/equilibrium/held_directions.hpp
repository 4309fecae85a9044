#pragma once

#include <Eigen/QR>

#include "model/model.hpp"

namespace equilibrium {

/// The directions in which a point of an interface is held, columns: across the face, then along it
/// if it sticks.
template <int Dim>
Eigen::Matrix<double, Dim, Eigen::Dynamic> held_directions(const model::Interface<Dim>& interface,
                                                           fpm::Index point) {
  const fpm::Vector<Dim> normal = interface.faces.points.normal.row(point).transpose();
  if (!constitutive::sticks(interface.law)) return normal;
  return normal.householderQr().householderQ();
}

}  // namespace equilibrium
