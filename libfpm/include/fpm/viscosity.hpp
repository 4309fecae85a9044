#pragma once

#include <string>
#include <vector>

#include "fpm/moment_operator.hpp"
#include "fpm/points.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// Strength of the pseudo-viscosity.
struct ViscosityOptions {
  /// theta [-] >= 0, per step. With rho c^2 = E in Eq. 15 it is alpha ls / (c dt), so the paper's
  /// alpha = 1 means a step of dt = ls / (c theta). In elasticity it stiffens the response by about
  /// 0.7 theta / (number of steps): keep theta / steps <= 0.01.
  double theta = 0.01;
};

/// What is wrong with the options; empty if nothing is.
std::vector<std::string> validate(const ViscosityOptions& options);

/// ls [m] of every row, R / (R / ls of the kernel), after any widening of its support.
template <int Dim>
Eigen::VectorXd smoothing_lengths(const Rows<Dim>& rows);

/// Pseudo-viscosity against zero-energy modes (Chen, Huang & Lyamin 2020, Eq. 15-20).
///
/// For each pair of a row, with x_ab = x_a - x_b at the middle of the step and du its increment,
///   Pi_ab = theta E_ab x_ab . (du_a - du_b) / (|x_ab|^2 + (0.1 ls_ab)^2),
///   f_b += t,  f_a -= t,  t = V_a Pi_ab F_a^-T G_ab,
/// E_ab and ls_ab being the pair's means. The force belongs to f_int. It conserves linear momentum
/// to round-off on any graph, and sees no rigid motion of a step, however large its rotation.
/// Departure: the paper's force is a difference of h_ab and h_ba (Eq. 17), which needs symmetric
/// neighbour lists; the directed form does not (share/doc/decisions/viscosity.md).
///
/// Pair forces are computed per row and summed per particle in a fixed order, both in parallel:
/// results do not depend on the number of threads. Calls do not allocate, but use buffers of the
/// object, so one object serves one caller at a time.
template <int Dim>
class PairViscosity {
 public:
  PairViscosity() = default;

  /// Copies the gradient weights of `op`; make a new one after a re-search.
  /// @param modulus  [Pa] E of each particle
  /// @param smoothing_length  [m] ls of each particle
  /// @throws ShapeError if sizes disagree.
  PairViscosity(const MomentOperator<Dim>& op, const Eigen::VectorXd& modulus,
                const Eigen::VectorXd& smoothing_length);

  /// Adds the viscous force of the increment.
  /// @param position  [m] n x Dim, at the beginning of the step
  /// @param increment  [m] n x Dim, du
  /// @param inverse_transposed  [-] F_a^-T, component (i, J) in column J Dim + i; no rows for the
  ///   identity (small strains)
  /// @param volume  [m^Dim] n, V_a
  /// @param[in,out] force  [N, or N/m in 2D] n x Dim
  /// @throws ShapeError if sizes disagree.
  void add_force(double theta, const FieldView<Dim>& position, const FieldView<Dim>& increment,
                 const FieldView<Dim * Dim>& inverse_transposed,
                 const Eigen::Ref<const Eigen::VectorXd>& volume, FieldTarget<Dim> force);

  /// Adds the force's linear part along `direction`, with midpoint, F and V those of `increment`:
  /// the action of the paper's k^v (Eq. 20, 24, 30). The exact derivative where the configuration
  /// is held, as at small strains; elsewhere it leaves out terms of the order of the increment.
  void add_action(double theta, const FieldView<Dim>& position, const FieldView<Dim>& increment,
                  const FieldView<Dim>& direction, const FieldView<Dim * Dim>& inverse_transposed,
                  const Eigen::Ref<const Eigen::VectorXd>& volume, FieldTarget<Dim> force);

  /// Memory of the pairs and the buffers [bytes].
  std::size_t bytes() const;

 private:
  void set_midpoint(const FieldView<Dim>& position, const FieldView<Dim>& increment);
  void set_field(const FieldView<Dim>& field);
  void compute_pairs(double theta, const FieldView<Dim * Dim>& inverse_transposed,
                     const Eigen::Ref<const Eigen::VectorXd>& volume);
  void sum_pairs(FieldTarget<Dim> force);

  Ghosts<Dim> ghosts_;
  Index size_ = 0;
  Eigen::VectorXd modulus_;           // images included
  Eigen::VectorXd smoothing_length_;  // images included
  std::vector<std::size_t> row_begin_{0};
  std::vector<Index> neighbour_;
  std::vector<Vector<Dim>> gradient_;
  std::vector<std::size_t> node_begin_{0};  // pairs by their neighbour, images included
  std::vector<std::size_t> node_pair_;

  Field<Dim> midpoint_;  // images included
  Field<Dim> field_;     // images included
  std::vector<Vector<Dim>> pair_force_;
  Field<Dim> node_force_;  // images included
};

}  // namespace fpm
