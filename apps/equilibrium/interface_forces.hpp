#pragma once

#include <optional>
#include <vector>

#include "equilibrium/plate_balance.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace equilibrium {

/// Forces of the interfaces in one step: bodies that are tied or in contact, and those that touch a
/// rigid support or plate. Points keep their partners: slips are small beside the spacing until a
/// new scene is made of the deformed body. The normal is that of the first body at the start of the
/// step, or the rigid body's. A plate that is free in some ways moves as the body lets it
/// (plate_balance.hpp).
template <int Dim>
class InterfaceForces {
 public:
  explicit InterfaceForces(const model::Model<Dim>& model);

  bool empty() const { return points_ == 0; }

  /// Whether all that they bear is proportional to what moves: springs that neither slip nor open,
  /// and no plate that finds its own way.
  bool are_linear() const;

  /// Prepares a step from the state.
  /// @param reduction  what the strength of faces that weaken is divided by
  void begin_step(const model::State<Dim>& state, double reduction);

  /// Adds the forces that go with a total displacement to those of the bodies; remembers tractions.
  /// @param load  load parameter to which rigid bodies have moved
  /// @returns whether plates that are free find a motion in balance with their loads
  [[nodiscard]] bool add_force(const model::State<Dim>& state, const fpm::Field<Dim>& displacement,
                               double load, fpm::FieldTarget<Dim> force);

  /// Keeps the tangents at a displacement, for `add_action`; returns as `add_force`.
  [[nodiscard]] bool linearise(const model::State<Dim>& state, const fpm::Field<Dim>& displacement,
                               double load);

  /// Adds the action of the tangents on a direction.
  /// @param load_change  of rigid bodies
  void add_action(const fpm::FieldView<Dim>& direction, double load_change,
                  fpm::FieldTarget<Dim> force) const;

  /// Force [N/m or N] by which each interface's rigid body holds the body, of the latest forces;
  /// zero between two bodies.
  const std::vector<fpm::Vector<Dim>>& rigid_force() const { return rigid_force_; }

  /// Takes the latest slips, tractions and motions of plates into the state.
  void commit(model::State<Dim>& state) const;
  /// Of what was evaluated the tractions alone, in the state.
  void take_tractions(model::State<Dim>& state) const { state.interface_traction = traction_; }

  /// Work [J/m or J] of the loads of plates since the step's start, at a load parameter.
  double work_of_plates(double load) const;

  /// Displacement [m] of the loaded plate that the curve reports along its load, where that acts; 0
  /// without one.
  double settlement() const;

  std::size_t bytes() const;

 private:
  template <int Rows>
  using Columns = Eigen::Matrix<double, Rows, Eigen::Dynamic>;
  using Motion = typename model::Plate<Dim>::Motion;

  bool move_plates(const model::State<Dim>& state, const fpm::Field<Dim>& displacement,
                   double load);
  fpm::Vector<Dim> motion_of(std::size_t interface, fpm::Index point, double load) const;

  const model::Model<Dim>& model_;
  std::vector<constitutive::InterfaceLaw> divided_;  // laws in the step, of points that weaken
  Eigen::Index points_ = 0;
  Columns<Dim> normal_;         // of each point, out of the first body
  Columns<Dim> slip_;           // [m] of the latest forces
  Columns<Dim> traction_;       // [Pa] of the latest forces
  Columns<Dim * Dim> tangent_;  // [Pa/m] of the latest linearisation
  std::vector<fpm::Vector<Dim>> rigid_force_;
  // Of each interface that is a plate free in some ways.
  std::vector<Motion> motion_;        // of the latest forces
  std::vector<Motion> start_motion_;  // at the start of the step
  std::vector<std::optional<PlateTangent<Dim>>> plate_tangent_;
};

}  // namespace equilibrium
