#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fpm/boundary.hpp"
#include "fpm/points.hpp"
#include "fpm/types.hpp"

namespace fpm {

// Boundary terms of the weak form (Chen, Huang & Lyamin 2020, Eq. 3-4). All take the operator at
// the boundary points and the points themselves, add to a nodal field of n particles, allocate
// nothing, run in a fixed order, and throw ShapeError if sizes disagree. An operator made by
// PointOperator::at_particles lumps the same terms to boundary particles.

/// External force of dead tractions: force_b += sum_c N_cb t_c w_c.
/// @param traction  [Pa] m x Dim, per reference area
/// @param[in,out] force  [N, or N/m in 2D] n x Dim
template <int Dim>
void add_traction(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                  const FieldView<Dim>& traction, FieldTarget<Dim> force);

/// The same for one traction on all points.
template <int Dim>
void add_uniform_traction(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                          const Vector<Dim>& traction, FieldTarget<Dim> force);

/// External force of a pressure that follows the boundary: current area and normal by Nanson's
/// formula, force_b -= sum_c N_cb p cof(F_c) n_c w_c with F_c = I + du/dX at the point.
/// @param pressure  [Pa] positive pushes against the body
/// @param displacement  [m] n x Dim, since the operator's reference configuration
/// @returns the first point with det F <= 0, if there is one; `force` then holds that of the
///   points before it.
template <int Dim>
[[nodiscard]] std::optional<Index> add_following_pressure(const PointOperator<Dim>& op,
                                                          const BoundaryPoints<Dim>& points,
                                                          double pressure,
                                                          const FieldView<Dim>& displacement,
                                                          FieldTarget<Dim> force);

/// Derivative of the following pressure's force along `direction`, exact.
template <int Dim>
void add_following_pressure_action(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                                   double pressure, const FieldView<Dim>& displacement,
                                   const FieldView<Dim>& direction, FieldTarget<Dim> force);

/// Displacement prescribed on boundary points by a penalty (Eq. 3-4), with the energy
/// (penalty / 2) sum_c w_c |u(X_c) - ubar_c|^2 over the prescribed components, u = sum_d N_cd u_d.
template <int Dim>
struct PenaltyOptions {
  /// [Pa/m] > 0. A point under the support traction t is off by |t| / penalty; 100 E / spacing
  /// keeps that below 1 % of a spacing for t up to E. The stiffness it adds grows in proportion.
  double penalty = 0.0;
  std::array<bool, Dim> prescribed = filled(true);  ///< which components; a roller has one

  static constexpr std::array<bool, Dim> filled(bool value) {
    std::array<bool, Dim> all{};
    for (bool& entry : all) entry = value;
    return all;
  }
};

/// What is wrong with the options; empty if nothing is.
template <int Dim>
std::vector<std::string> validate(const PenaltyOptions<Dim>& options);

/// Adds the penalty's gradient, penalty N_cb (u(X_c) - ubar_c) w_c, to the residual
/// f_int - f_ext (so it counts as an internal force).
/// @param target  [m] m x Dim, ubar_c; components that are not prescribed are ignored
/// @param displacement  [m] n x Dim
/// @returns the sum of the reactions [N, or N/m in 2D], the force of the support on the body.
template <int Dim>
Vector<Dim> add_penalty_force(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                              const PenaltyOptions<Dim>& options, const FieldView<Dim>& target,
                              const FieldView<Dim>& displacement, FieldTarget<Dim> force);

/// Derivative of the penalty's force along `direction`; symmetric and positive semi-definite.
template <int Dim>
void add_penalty_action(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                        const PenaltyOptions<Dim>& options, const FieldView<Dim>& direction,
                        FieldTarget<Dim> force);

/// Energy of the penalty [J, or J/m in 2D]; `add_penalty_force` is its gradient.
template <int Dim>
double penalty_energy(const PointOperator<Dim>& op, const BoundaryPoints<Dim>& points,
                      const PenaltyOptions<Dim>& options, const FieldView<Dim>& target,
                      const FieldView<Dim>& displacement);

}  // namespace fpm
