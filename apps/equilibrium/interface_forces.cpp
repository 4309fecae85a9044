#include "equilibrium/interface_forces.hpp"

#include <Eigen/LU>
#include <algorithm>

#include "constitutive/strength_reduction.hpp"

namespace equilibrium {
namespace {

// Calls visit(interface, its number, point of it, point of all) for every point.
template <int Dim, class Visitor>
void for_each_point(const model::Model<Dim>& model, Visitor&& visit) {
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < model.interfaces.size(); ++i) {
    const model::Interface<Dim>& interface = model.interfaces[i];
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c) visit(interface, i, c, k++);
  }
}

template <int Dim>
constitutive::InterfaceResponse<Dim> response_at(const model::Interface<Dim>& interface,
                                                 const constitutive::InterfaceLaw& divided,
                                                 fpm::Index point, const fpm::Vector<Dim>& normal,
                                                 const fpm::Vector<Dim>& slip,
                                                 const fpm::Field<Dim>& displacement,
                                                 const fpm::Vector<Dim>& motion) {
  const fpm::Vector<Dim> gap = interface.faces.gap(point, displacement, motion);
  return constitutive::interface_response<Dim>(
      interface.weakens_at(point) ? divided : interface.law, interface.stiffness[point], normal,
      fpm::Vector<Dim>(interface.initial_traction.row(point).transpose()), gap, slip);
}

}  // namespace

template <int Dim>
InterfaceForces<Dim>::InterfaceForces(const model::Model<Dim>& model)
    : model_(model), points_(model.interface_points()) {
  for (const model::Interface<Dim>& interface : model.interfaces) divided_.push_back(interface.law);
  normal_.setZero(Dim, points_);
  slip_.setZero(Dim, points_);
  traction_.setZero(Dim, points_);
  tangent_.setZero(Dim * Dim, points_);
  rigid_force_.assign(model.interfaces.size(), fpm::Vector<Dim>::Zero());
  motion_.assign(model.interfaces.size(), Motion::Zero());
  start_motion_ = motion_;
  plate_tangent_.resize(model.interfaces.size());
}

template <int Dim>
bool InterfaceForces<Dim>::are_linear() const {
  return std::ranges::none_of(model_.interfaces, [](const model::Interface<Dim>& interface) {
    const constitutive::InterfaceLaw& law = interface.law;
    const bool slips = !law.tied && constitutive::sticks(law);
    const bool opens = !law.tied && !law.tension;
    return slips || opens || interface.plate;
  });
}

template <int Dim>
bool InterfaceForces<Dim>::move_plates(const model::State<Dim>& state,
                                       const fpm::Field<Dim>& displacement, double load) {
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    const model::Interface<Dim>& interface = model_.interfaces[i];
    const Eigen::Index count = interface.faces.points.size();
    if (interface.plate) {
      const auto motion =
          plate_motion<Dim>({interface, divided_[i], normal_.middleCols(first, count),
                             state.interface_slip.middleCols(first, count), displacement, load});
      if (!motion) return false;
      motion_[i] = *motion;
    }
    first += count;
  }
  return true;
}

template <int Dim>
fpm::Vector<Dim> InterfaceForces<Dim>::motion_of(std::size_t interface, fpm::Index point,
                                                 double load) const {
  const model::Interface<Dim>& of = model_.interfaces[interface];
  if (!of.plate) return load * of.drive + of.held;
  const fpm::Vector<Dim> place = of.faces.points.position.row(point).transpose();
  return of.plate->modes(place) * motion_[interface];
}

template <int Dim>
void InterfaceForces<Dim>::begin_step(const model::State<Dim>& state, double reduction) {
  for (std::size_t i = 0; i < divided_.size(); ++i) {
    const model::Interface<Dim>& interface = model_.interfaces[i];
    divided_[i] = constitutive::with_strength_over(interface.law, reduction);
    divided_[i].adhesion =
        std::min(interface.divided_adhesion / reduction, interface.kept_adhesion);
  }
  for_each_point(model_, [&](const auto& interface, std::size_t, fpm::Index c, Eigen::Index k) {
    const fpm::Vector<Dim> normal = interface.faces.points.normal.row(c).transpose();
    normal_.col(k) = normal;
    if (interface.is_rigid() || !model_.layout.finite) return;
    const fpm::Tensor<Dim> gradient =
        fpm::Tensor<Dim>::Identity() + interface.faces.first.gradient(c, state.displacement);
    normal_.col(k) = (gradient.inverse().transpose() * normal).normalized();
  });
  // A plate that has no motion now has none in the step, whose evaluations say so.
  if (move_plates(state, state.displacement, state.programme.load)) start_motion_ = motion_;
}

template <int Dim>
bool InterfaceForces<Dim>::add_force(const model::State<Dim>& state,
                                     const fpm::Field<Dim>& displacement, double load,
                                     fpm::FieldTarget<Dim> force) {
  if (!move_plates(state, displacement, load)) return false;
  rigid_force_.assign(model_.interfaces.size(), fpm::Vector<Dim>::Zero());
  for_each_point(model_, [&](const auto& interface, std::size_t i, fpm::Index c, Eigen::Index k) {
    const auto response = response_at<Dim>(
        interface, divided_[i], c, fpm::Vector<Dim>(normal_.col(k)),
        fpm::Vector<Dim>(state.interface_slip.col(k)), displacement, motion_of(i, c, load));
    slip_.col(k) = response.slip;
    traction_.col(k) = response.traction;
    interface.faces.add_force(c, response.traction, force);
    if (interface.is_rigid()) {
      rigid_force_[i] += interface.faces.points.weight[c] * response.traction;
    }
  });
  return true;
}

template <int Dim>
bool InterfaceForces<Dim>::linearise(const model::State<Dim>& state,
                                     const fpm::Field<Dim>& displacement, double load) {
  if (!move_plates(state, displacement, load)) return false;
  for_each_point(model_, [&](const auto& interface, std::size_t i, fpm::Index c, Eigen::Index k) {
    const auto response = response_at<Dim>(
        interface, divided_[i], c, fpm::Vector<Dim>(normal_.col(k)),
        fpm::Vector<Dim>(state.interface_slip.col(k)), displacement, motion_of(i, c, load));
    Eigen::Map<fpm::Tensor<Dim>>(tangent_.col(k).data()) = response.tangent;
  });
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    const model::Interface<Dim>& interface = model_.interfaces[i];
    const Eigen::Index count = interface.faces.points.size();
    if (interface.plate) plate_tangent_[i].emplace(interface, tangent_.middleCols(first, count));
    first += count;
  }
  return true;
}

template <int Dim>
void InterfaceForces<Dim>::add_action(const fpm::FieldView<Dim>& direction, double load_change,
                                      fpm::FieldTarget<Dim> force) const {
  std::vector<Motion> change(model_.interfaces.size());
  for (std::size_t i = 0; i < change.size(); ++i) {
    if (plate_tangent_[i]) change[i] = plate_tangent_[i]->motion(direction, load_change);
  }
  for_each_point(model_, [&](const auto& interface, std::size_t i, fpm::Index c, Eigen::Index k) {
    fpm::Vector<Dim> motion = load_change * interface.drive;
    if (interface.plate) {
      const fpm::Vector<Dim> place = interface.faces.points.position.row(c).transpose();
      motion = interface.plate->modes(place) * change[i];
    }
    const fpm::Vector<Dim> gap = interface.faces.gap(c, direction, motion);
    const Eigen::Map<const fpm::Tensor<Dim>> tangent(tangent_.col(k).data());
    interface.faces.add_force(c, fpm::Vector<Dim>(tangent * gap), force);
  });
}

template <int Dim>
double InterfaceForces<Dim>::work_of_plates(double load) const {
  double work = 0.0;
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    if (!model_.interfaces[i].plate) continue;
    const Motion moved = motion_[i] - start_motion_[i];
    const model::Plate<Dim>& plate = *model_.interfaces[i].plate;
    work += (load * plate.force + plate.held_force).dot(moved.template head<Dim>());
  }
  return work;
}

template <int Dim>
double InterfaceForces<Dim>::settlement() const {
  for (std::size_t i = 0; i < model_.interfaces.size(); ++i) {
    const auto& plate = model_.interfaces[i].plate;
    if (!plate || !plate->reported) continue;
    const fpm::Vector<Dim> along = plate->force + plate->held_force;
    if (!along.isZero(0.0)) return along.normalized().dot(motion_[i].template head<Dim>());
  }
  return 0.0;
}

template <int Dim>
void InterfaceForces<Dim>::commit(model::State<Dim>& state) const {
  state.interface_slip = slip_;
  state.interface_traction = traction_;
  Eigen::Index k = 0;
  for (std::size_t i = 0; i < motion_.size(); ++i) {
    const auto& plate = model_.interfaces[i].plate;
    if (!plate) continue;
    state.plate_displacement.col(k) = motion_[i].template head<Dim>();
    state.plate_rotation.col(k) =
        motion_[i].template tail<model::State<Dim>::rotations>() / plate->arm;
    ++k;
  }
}

template <int Dim>
std::size_t InterfaceForces<Dim>::bytes() const {
  return static_cast<std::size_t>(normal_.size() + slip_.size() + traction_.size() +
                                  tangent_.size()) *
         sizeof(double);
}

template class InterfaceForces<2>;
template class InterfaceForces<3>;

}  // namespace equilibrium
