#include "equilibrium/plate_balance.hpp"

#include <Eigen/QR>
#include <cmath>

namespace equilibrium {
namespace {

template <int Dim>
using Motion = typename model::Plate<Dim>::Motion;
template <int Dim>
using Square = Eigen::Matrix<double, model::Plate<Dim>::motions, model::Plate<Dim>::motions>;

template <int Dim>
fpm::Vector<Dim> place_of(const model::Interface<Dim>& interface, Eigen::Index c) {
  return interface.faces.points.position.row(c).transpose();
}

// What is not free is zero, on either side.
template <int Dim>
void keep_free(const model::Plate<Dim>& plate, Motion<Dim>& vector) {
  for (int i = 0; i < vector.size(); ++i) {
    if (!plate.free[static_cast<std::size_t>(i)]) vector[i] = 0.0;
  }
}

// The inverse among the free motions; those that nothing resists stay where they are.
template <int Dim>
Square<Dim> inverse_of(const model::Plate<Dim>& plate, Square<Dim> stiffness) {
  for (int i = 0; i < stiffness.rows(); ++i) {
    if (plate.free[static_cast<std::size_t>(i)]) continue;
    stiffness.row(i).setZero();
    stiffness.col(i).setZero();
  }
  constexpr double nothing = 1e-12;  // of the stiffest motion
  Eigen::CompleteOrthogonalDecomposition<Square<Dim>> decomposition;
  decomposition.setThreshold(nothing);
  decomposition.compute(stiffness);
  return decomposition.pseudoInverse();
}

template <int Dim>
struct Balance {
  Motion<Dim> unbalanced = Motion<Dim>::Zero();
  Square<Dim> stiffness = Square<Dim>::Zero();
  double size = 0.0;  // of the forces that are to be in balance
};

template <int Dim>
Balance<Dim> balance_at(const PlatePoints<Dim>& points, const Motion<Dim>& motion) {
  const model::Interface<Dim>& interface = points.interface;
  const model::Plate<Dim>& plate = *interface.plate;
  Balance<Dim> balance;
  const fpm::Vector<Dim> load = points.load * plate.force + plate.held_force;
  balance.unbalanced.template head<Dim>() = load;
  balance.size = load.norm();
  for (Eigen::Index c = 0; c < points.normal.cols(); ++c) {
    const auto modes = plate.modes(place_of(interface, c));
    const fpm::Vector<Dim> gap = interface.faces.gap(
        static_cast<fpm::Index>(c), points.displacement, fpm::Vector<Dim>(modes * motion));
    const auto response = constitutive::interface_response<Dim>(
        interface.weakens_at(static_cast<fpm::Index>(c)) ? points.divided : interface.law,
        interface.stiffness[c], fpm::Vector<Dim>(points.normal.col(c)),
        fpm::Vector<Dim>(interface.initial_traction.row(c).transpose()), gap,
        fpm::Vector<Dim>(points.slip.col(c)));
    const double weight = interface.faces.points.weight[c];
    balance.unbalanced -= weight * modes.transpose() * response.traction;
    balance.stiffness += weight * modes.transpose() * response.tangent * modes;
    balance.size += weight * response.traction.norm();
  }
  keep_free<Dim>(plate, balance.unbalanced);
  return balance;
}

// The stiffness of the plate with all its points stuck, and the motion by which its free ones
// follow the body's points: the least squares of gaps.
template <int Dim>
Square<Dim> stuck_compliance(const PlatePoints<Dim>& points) {
  const model::Interface<Dim>& interface = points.interface;
  Square<Dim> stiffness = Square<Dim>::Zero();
  for (Eigen::Index c = 0; c < points.normal.cols(); ++c) {
    const auto modes = interface.plate->modes(place_of(interface, c));
    stiffness +=
        interface.faces.points.weight[c] * interface.stiffness[c] * modes.transpose() * modes;
  }
  return inverse_of<Dim>(*interface.plate, stiffness);
}

template <int Dim>
Motion<Dim> following(const PlatePoints<Dim>& points, const Square<Dim>& compliance) {
  const model::Interface<Dim>& interface = points.interface;
  Motion<Dim> motion = Motion<Dim>::Zero();
  motion.template head<Dim>() = points.load * interface.drive + interface.held;
  Motion<Dim> pull = Motion<Dim>::Zero();
  for (Eigen::Index c = 0; c < points.normal.cols(); ++c) {
    const auto modes = interface.plate->modes(place_of(interface, c));
    const fpm::Vector<Dim> gap = interface.faces.gap(
        static_cast<fpm::Index>(c), points.displacement, fpm::Vector<Dim>(modes * motion));
    pull -= interface.faces.points.weight[c] * interface.stiffness[c] * modes.transpose() * gap;
  }
  return motion + compliance * pull;
}

}  // namespace

template <int Dim>
std::optional<typename model::Plate<Dim>::Motion> plate_motion(const PlatePoints<Dim>& points) {
  // The law is linear in pieces: once the points' states are right one step is exact. Far from it a
  // step with all points stuck closes what is open too far.
  constexpr int most_steps = 200;
  constexpr int most_halvings = 8;
  constexpr double round_off = 1e-12;
  const Square<Dim> stuck = stuck_compliance(points);
  Motion<Dim> motion = following(points, stuck);
  Balance<Dim> now = balance_at(points, motion);
  for (int step = 0; step < most_steps; ++step) {
    const double before = now.unbalanced.norm();
    if (before <= round_off * now.size) return motion;
    Motion<Dim> change = inverse_of<Dim>(*points.interface.plate, now.stiffness) * now.unbalanced;
    Balance<Dim> then = balance_at<Dim>(points, motion + change);
    for (int halved = 0; halved < most_halvings && then.unbalanced.norm() >= before; ++halved) {
      change *= 0.5;
      then = balance_at<Dim>(points, motion + change);
    }
    if (then.unbalanced.norm() >= before) {
      change = stuck * now.unbalanced;
      then = balance_at<Dim>(points, motion + change);
    }
    motion += change;
    now = then;
  }
  return std::nullopt;
}

template <int Dim>
PlateTangent<Dim>::PlateTangent(
    const model::Interface<Dim>& interface,
    Eigen::Ref<const Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>> tangent)
    : interface_(interface), tangent_(tangent) {
  Square stiffness = Square::Zero();
  for (Eigen::Index c = 0; c < tangent_.cols(); ++c) {
    const auto modes = interface.plate->modes(place_of(interface, c));
    const Eigen::Map<const fpm::Tensor<Dim>> of_point(tangent_.col(c).data());
    stiffness += interface.faces.points.weight[c] * modes.transpose() * of_point * modes;
  }
  compliance_ = inverse_of<Dim>(*interface.plate, stiffness);
}

template <int Dim>
typename PlateTangent<Dim>::Motion PlateTangent<Dim>::motion(const fpm::FieldView<Dim>& direction,
                                                             double load_change) const {
  const model::Plate<Dim>& plate = *interface_.plate;
  Motion motion = Motion::Zero();
  motion.template head<Dim>() = load_change * interface_.drive;
  Motion unbalanced = Motion::Zero();
  unbalanced.template head<Dim>() = load_change * plate.force;
  for (Eigen::Index c = 0; c < tangent_.cols(); ++c) {
    const auto modes = plate.modes(place_of(interface_, c));
    const fpm::Vector<Dim> gap = interface_.faces.gap(static_cast<fpm::Index>(c), direction,
                                                      fpm::Vector<Dim>(modes * motion));
    const Eigen::Map<const fpm::Tensor<Dim>> tangent(tangent_.col(c).data());
    unbalanced -= interface_.faces.points.weight[c] * modes.transpose() * (tangent * gap);
  }
  keep_free<Dim>(plate, unbalanced);
  return motion + compliance_ * unbalanced;
}

template std::optional<model::Plate<2>::Motion> plate_motion<2>(const PlatePoints<2>&);
template std::optional<model::Plate<3>::Motion> plate_motion<3>(const PlatePoints<3>&);
template class PlateTangent<2>;
template class PlateTangent<3>;

}  // namespace equilibrium
