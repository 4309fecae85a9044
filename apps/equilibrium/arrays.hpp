#pragma once

#include <Eigen/Core>

#include "fpm/types.hpp"

namespace equilibrium {

/// What decides how large the arrays of an equilibrium are: numbers of particles, those that a
/// scene has no use for being 0.
struct ArraySizes {
  Eigen::Index particles = 0;
  Eigen::Index extended = 0;          // particles, images and padding: MomentOperator::stride
  Eigen::Index stress_entries = 0;    // per particle: MomentOperator::stress_count
  Eigen::Index pairs = 0;             // with pair control
  Eigen::Index subpoints = 0;         // with sub-points
  Eigen::Index viscosity = 0;         // with the paper's viscosity
  Eigen::Index moving_images = 0;     // with a side driven by ghosts
  Eigen::Index held = 0;              // with a side held by ghosts
  Eigen::Index viscosity_finite = 0;  // the same in finite strain
  Eigen::Index following = 0;         // with loads that follow the boundary
  Eigen::Index tangent_entries = 0;   // of all particles (TangentLayout)
  Eigen::Index rotation_entries = 0;  // likewise
};

/// What stays the same during a step. As every struct of arrays here it lists them once, by
/// visit(name, array, rows, columns) with the size that each should have: what allocates, counts or
/// checks them walks that list.
template <int Dim>
struct StepArrays {
  template <int Rows>
  using Columns = Eigen::Matrix<double, Rows, Eigen::Dynamic>;
  static constexpr int second_size = Dim * fpm::second_gradient_size<Dim>;

  ArraySizes sizes;
  double load = 0.0;         // load parameter at the end of the step
  Eigen::VectorXd external;  // [N/m or N] dead loads
  fpm::Field<Dim> start_position;
  Eigen::VectorXd position;              // from a point next to the body, extended to the images
  fpm::Field<Dim> image_motion;          // what the planes' motion of the step adds to the images
  Columns<second_size> second_gradient;  // H_a(n), with sub-points
  Columns<Dim> memory_first;             // sum kappa e(n)
  Columns<Dim * Dim> memory_second;      // sum kappa e(n) x X
  Columns<Dim * Dim> pair_gradient;      // of the motion, since Xref
  Eigen::VectorXd pair_stiffness;        // k_a

  template <class Self, class Visitor>
  static void for_each_array(Self& self, Visitor&& visit) {
    const ArraySizes& n = self.sizes;
    visit("external", self.external, n.particles * Dim, 1);
    visit("start_position", self.start_position, n.particles, Dim);
    visit("position", self.position, n.extended * Dim, 1);
    visit("image_motion", self.image_motion, n.moving_images, Dim);
    visit("second_gradient", self.second_gradient, second_size, n.subpoints);
    visit("memory_first", self.memory_first, Dim, n.pairs);
    visit("memory_second", self.memory_second, Dim * Dim, n.pairs);
    visit("pair_gradient", self.pair_gradient, Dim * Dim, n.pairs);
    visit("pair_stiffness", self.pair_stiffness, n.pairs, 1);
  }
};

/// Work arrays of an evaluation.
template <int Dim>
struct EvaluationArrays {
  ArraySizes sizes;
  Eigen::VectorXd extended;                  // the increment, or the direction of a Jacobian action
  Eigen::VectorXd stress;                    // generalised, as MomentOperator::scatter reads it
  Eigen::VectorXd force;                     // extended to the images
  Eigen::VectorXd own_force;                 // of the pairs of a row on itself
  Eigen::VectorXd unmasked;                  // full residual, reactions included
  fpm::Field<Dim> plane_reaction;            // what the images carry onto held planes, by particle
  Eigen::VectorXd following;                 // [N/m or N] loads that follow the boundary
  Eigen::VectorXd base_increment;            // of the latest linearise, where a term needs it
  fpm::Field<Dim> displacement;              // total, where a boundary term needs it
  fpm::Field<Dim * Dim> inverse_transposed;  // F^-T of each row, with the paper's viscosity
  Eigen::VectorXd volume;                    // V_a, with the paper's viscosity

  template <class Self, class Visitor>
  static void for_each_array(Self& self, Visitor&& visit) {
    const ArraySizes& n = self.sizes;
    visit("extended", self.extended, n.extended * Dim, 1);
    visit("stress", self.stress, n.extended * n.stress_entries, 1);
    visit("force", self.force, n.extended * Dim, 1);
    visit("own_force", self.own_force, n.particles * Dim, 1);
    visit("unmasked", self.unmasked, n.particles * Dim, 1);
    visit("plane_reaction", self.plane_reaction, n.held, Dim);
    visit("following", self.following, n.following * Dim, 1);
    visit("base_increment", self.base_increment, n.particles * Dim, 1);
    visit("displacement", self.displacement, n.particles, Dim);
    visit("inverse_transposed", self.inverse_transposed, n.viscosity_finite, Dim * Dim);
    visit("volume", self.volume, n.viscosity, 1);
  }
};

/// Tangents of all particles, in the order of TangentLayout; allocated by the first linearisation,
/// as many a method never asks for one.
struct TangentArrays {
  ArraySizes sizes;
  double unit = 1.0;         // [J] that `stress` is measured in
  Eigen::VectorXf stress;    // d(P, T) / d(gradient, second gradient)
  Eigen::VectorXf rotation;  // dQ / d(gradient), with the incremental control

  template <class Self, class Visitor>
  static void for_each_array(Self& self, Visitor&& visit) {
    visit("tangent", self.stress, self.sizes.tangent_entries, 1);
    visit("rotation_tangent", self.rotation, self.sizes.rotation_entries, 1);
  }
};

/// Gives each array its size, and zeros.
template <class Arrays>
void allocate(Arrays& arrays, const ArraySizes& sizes) {
  arrays.sizes = sizes;
  Arrays::for_each_array(arrays, [](const char*, auto& array, Eigen::Index rows,
                                    Eigen::Index columns) { array.setZero(rows, columns); });
}

/// Memory of the arrays [bytes].
template <class Arrays>
std::size_t bytes_of(const Arrays& arrays) {
  std::size_t sum = 0;
  Arrays::for_each_array(arrays, [&](const char*, const auto& array, Eigen::Index, Eigen::Index) {
    sum += static_cast<std::size_t>(array.size()) * sizeof(*array.data());
  });
  return sum;
}

}  // namespace equilibrium
