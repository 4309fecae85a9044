#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "constitutive/tensor.hpp"
#include "fpm/rows.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/types.hpp"

namespace model {

/// Which primary fields a scene needs; what it does not need has no columns.
struct StateLayout {
  bool finite = true;        // deformation gradient, volume ratio
  bool plastic = false;      // plastic strains
  bool subpoints = false;    // deviators of the sub-points
  bool incremental = false;  // memory of the incremental hourglass control
  bool staged = false;       // what the changes of a stage have left unbalanced
  bool thin = false;         // what opposite sides that hold the same particles bear each
};

/// Where the load programme stands.
struct ProgrammeState {
  std::int64_t step = 0;        // converged steps so far
  std::int64_t stage = 0;       // of the scene's stages, from 0
  double progress = 0.0;        // of the stage, in [0, 1]
  double load = 0.0;            // load parameter: without stages the progress
  double next_increment = 0.0;  // of the progress
  double last_increment =
      0.0;  // of the progress, of the last converged step; 0: none in this stage
  std::int64_t easy_steps = 0;  // consecutive steps below the easy number of evaluations
  std::int64_t re_searches = 0;
  double hourglass_work = 0.0;  // [J/m or J] accumulated
  double external_work = 0.0;   // [J/m or J] accumulated work of the reactions and loads
  // Whether a dead load keeps the initial stress at rest. Runs of earlier schemas began without
  // one, and go on as they began.
  std::int64_t balanced = 1;

  template <class Visitor>
  void for_each_field(Visitor&& visit) {
    visit("step", "-", step);
    visit("stage", "-", stage);
    visit("progress", "-", progress);
    visit("load", "-", load);
    visit("next_increment", "-", next_increment);
    visit("last_increment", "-", last_increment);
    visit("easy_steps", "-", easy_steps);
    visit("research_events", "-", re_searches);  // the name in files of the first schema
    visit("hourglass_work", "J", hourglass_work);
    visit("external_work", "J", external_work);
    visit("balanced", "-", balanced);
  }
  bool operator==(const ProgrammeState&) const = default;
};

/// The primary state of a run at a converged step; all else is rebuilt from it and the scene.
/// One column per particle, so that local work on a particle touches few cache lines.
template <int Dim>
struct State {
  static constexpr int stress_rows = constitutive::stress_size<Dim>;
  static constexpr int subpoint_rows = static_cast<int>(fpm::subpoint_count) * stress_rows;
  static constexpr int side_rows = 2 * Dim * Dim;
  static constexpr int rotations = Dim == 2 ? 1 : 3;
  template <int Rows>
  using Columns = Eigen::Matrix<double, Rows, Eigen::Dynamic>;

  StateLayout layout;
  fpm::Field<Dim> displacement;              // n x Dim, component-major
  fpm::Field<Dim> increment;                 // of the last converged step
  Columns<Dim * Dim> deformation_gradient;   // F_a(n), column-major, since the row's reference
  Eigen::VectorXd searched_volume_ratio;     // volume at the last search over initial volume
  Columns<stress_rows> stress;               // Cauchy, tension positive; of the particle
  Columns<subpoint_rows> subpoint_deviator;  // of each of the four sub-points
  Eigen::VectorXd plastic_strain;            // accumulated equivalent
  Eigen::VectorXd plastic_volume_strain;     // accumulated
  Eigen::VectorXd plastic_strain_at_search;  // at the row's last search
  Eigen::VectorXd plastic_increment;         // of the last converged step
  Eigen::VectorXd released;                  // omega: 1 once the row has yielded, else 0
  fpm::Field<Dim> reaction;                  // at prescribed unknowns, 0 elsewhere
  // Of it what images carry: side by side of the box, all components of each.
  Columns<side_rows> side_reaction;
  fpm::Field<Dim> unbalanced;       // forces left at the stage's beginning; they fade in it
  Columns<Dim> interface_slip;      // of each point of the interfaces
  Columns<Dim> interface_traction;  // there, on the first body
  // Of each point of supports by penalty, where stages change the ground: at which it is held.
  fpm::Field<Dim> penalty_target;
  // Of each plate that is free in some ways, since it began: of the point about which it turns, and
  // about the axes.
  Columns<Dim> plate_displacement;
  Columns<rotations> plate_rotation;
  // What the last step's solve learnt of the tangent, which the next one begins with: changes of
  // the increment and of the residual, a column per pair, each over the length of the latter
  // (jfnk::SecantPairs).
  Eigen::MatrixXf secant_step;
  Eigen::MatrixXf secant_change;
  fpm::Rows<Dim> rows;
  ProgrammeState programme;

  /// @param n  particles
  /// @param points  of the interfaces
  /// @param penalty_points  of the supports by penalty whose targets are kept
  /// @param plates  that are free in some ways
  void resize(Eigen::Index n, Eigen::Index points, Eigen::Index penalty_points,
              Eigen::Index plates) {
    const auto count = [n](bool needed) { return needed ? n : 0; };
    displacement.setZero(n, Dim);
    increment.setZero(n, Dim);
    deformation_gradient.setZero(Dim * Dim, count(layout.finite));
    for (int i = 0; i < Dim; ++i) deformation_gradient.row(i * Dim + i).setOnes();
    searched_volume_ratio.setOnes(count(layout.finite));
    stress.setZero(stress_rows, n);
    subpoint_deviator.setZero(subpoint_rows, count(layout.subpoints));
    plastic_strain.setZero(count(layout.plastic));
    plastic_volume_strain.setZero(count(layout.plastic));
    plastic_strain_at_search.setZero(count(layout.plastic && layout.finite));
    plastic_increment.setZero(count(layout.plastic));
    released.setZero(count(layout.incremental));
    reaction.setZero(n, Dim);
    side_reaction.setZero(side_rows, count(layout.thin));
    unbalanced.setZero(count(layout.staged), Dim);
    interface_slip.setZero(Dim, points);
    interface_traction.setZero(Dim, points);
    penalty_target.setZero(penalty_points, Dim);
    plate_displacement.setZero(Dim, plates);
    plate_rotation.setZero(rotations, plates);
  }

  /// Visits every particle field, visit(name, unit, matrix); fields a scene does not need are
  /// empty.
  template <class Visitor>
  void for_each_particle_field(Visitor&& visit) {
    visit("displacement", "m", displacement);
    visit("increment", "m", increment);
    visit("deformation_gradient", "-", deformation_gradient);
    visit("searched_volume_ratio", "-", searched_volume_ratio);
    visit("stress", "Pa", stress);
    visit("subpoint_deviator", "Pa", subpoint_deviator);
    visit("plastic_strain", "-", plastic_strain);
    visit("plastic_volume_strain", "-", plastic_volume_strain);
    visit("plastic_strain_at_search", "-", plastic_strain_at_search);
    visit("plastic_increment", "-", plastic_increment);
    visit("released", "-", released);
    visit("reaction", Dim == 2 ? "N/m" : "N", reaction);
    visit("side_reaction", Dim == 2 ? "N/m" : "N", side_reaction);
    visit("unbalanced", Dim == 2 ? "N/m" : "N", unbalanced);
  }

  /// Likewise for the points of the interfaces.
  template <class Visitor>
  void for_each_interface_field(Visitor&& visit) {
    visit("slip", "m", interface_slip);
    visit("traction", "Pa", interface_traction);
  }

  /// Likewise for the points of the supports by penalty; a scene that needs none has no such field.
  template <class Visitor>
  void for_each_penalty_field(Visitor&& visit) {
    if (penalty_target.rows() > 0) visit("target", "m", penalty_target);
  }

  /// Likewise for the secant pairs, of which there are none before the first step.
  template <class Visitor>
  void for_each_secant_field(Visitor&& visit) {
    visit("step", Dim == 2 ? "m2/N" : "m/N", secant_step);
    visit("change", "-", secant_change);
  }

  /// Likewise for the plates that are free in some ways.
  template <class Visitor>
  void for_each_plate_field(Visitor&& visit) {
    if (plate_rotation.cols() == 0) return;
    visit("displacement", "m", plate_displacement);
    visit("rotation", "rad", plate_rotation);
  }
};

}  // namespace model
