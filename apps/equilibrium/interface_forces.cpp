#include "equilibrium/interface_forces.hpp"

#include <Eigen/LU>

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
                                                 fpm::Index point, const fpm::Vector<Dim>& normal,
                                                 const fpm::Vector<Dim>& slip,
                                                 const fpm::Field<Dim>& displacement, double load) {
  const fpm::Vector<Dim> gap =
      interface.faces.gap(point, displacement, fpm::Vector<Dim>(load * interface.drive));
  return constitutive::interface_response<Dim>(
      interface.law, interface.stiffness[point], normal,
      fpm::Vector<Dim>(interface.initial_traction.row(point).transpose()), gap, slip);
}

}  // namespace

template <int Dim>
InterfaceForces<Dim>::InterfaceForces(const model::Model<Dim>& model)
    : model_(model), points_(model.interface_points()) {
  normal_.setZero(Dim, points_);
  slip_.setZero(Dim, points_);
  traction_.setZero(Dim, points_);
  tangent_.setZero(Dim * Dim, points_);
  rigid_force_.assign(model.interfaces.size(), fpm::Vector<Dim>::Zero());
}

template <int Dim>
void InterfaceForces<Dim>::begin_step(const model::State<Dim>& state) {
  for_each_point(model_, [&](const auto& interface, std::size_t, fpm::Index c, Eigen::Index k) {
    const fpm::Vector<Dim> normal = interface.faces.points.normal.row(c).transpose();
    normal_.col(k) = normal;
    if (interface.is_rigid() || !model_.layout.finite) return;
    const fpm::Tensor<Dim> gradient =
        fpm::Tensor<Dim>::Identity() + interface.faces.first.gradient(c, state.displacement);
    normal_.col(k) = (gradient.inverse().transpose() * normal).normalized();
  });
}

template <int Dim>
void InterfaceForces<Dim>::add_force(const model::State<Dim>& state,
                                     const fpm::Field<Dim>& displacement, double load,
                                     fpm::FieldTarget<Dim> force) {
  rigid_force_.assign(model_.interfaces.size(), fpm::Vector<Dim>::Zero());
  for_each_point(model_, [&](const auto& interface, std::size_t i, fpm::Index c, Eigen::Index k) {
    const auto response =
        response_at<Dim>(interface, c, fpm::Vector<Dim>(normal_.col(k)),
                         fpm::Vector<Dim>(state.interface_slip.col(k)), displacement, load);
    slip_.col(k) = response.slip;
    traction_.col(k) = response.traction;
    interface.faces.add_force(c, response.traction, force);
    if (interface.is_rigid()) {
      rigid_force_[i] += interface.faces.points.weight[c] * response.traction;
    }
  });
}

template <int Dim>
void InterfaceForces<Dim>::linearise(const model::State<Dim>& state,
                                     const fpm::Field<Dim>& displacement, double load) {
  for_each_point(model_, [&](const auto& interface, std::size_t, fpm::Index c, Eigen::Index k) {
    const auto response =
        response_at<Dim>(interface, c, fpm::Vector<Dim>(normal_.col(k)),
                         fpm::Vector<Dim>(state.interface_slip.col(k)), displacement, load);
    Eigen::Map<fpm::Tensor<Dim>>(tangent_.col(k).data()) = response.tangent;
  });
}

template <int Dim>
void InterfaceForces<Dim>::add_action(const fpm::FieldView<Dim>& direction, double load_change,
                                      fpm::FieldTarget<Dim> force) const {
  for_each_point(model_, [&](const auto& interface, std::size_t, fpm::Index c, Eigen::Index k) {
    const fpm::Vector<Dim> gap =
        interface.faces.gap(c, direction, fpm::Vector<Dim>(load_change * interface.drive));
    const Eigen::Map<const fpm::Tensor<Dim>> tangent(tangent_.col(k).data());
    interface.faces.add_force(c, fpm::Vector<Dim>(tangent * gap), force);
  });
}

template <int Dim>
void InterfaceForces<Dim>::commit(model::State<Dim>& state) const {
  state.interface_slip = slip_;
  state.interface_traction = traction_;
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
