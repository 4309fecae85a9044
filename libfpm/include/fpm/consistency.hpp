#pragma once

#include "fpm/ghosts.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// Potential of the consistency correction.
///
/// Gradients are exact on linear fields, but their integral sum_a V_a G_ab differs from the
/// boundary area vector s_b, so a constant stress would load the particles near boundaries and on
/// irregular sets. Adding V_a kappa_ab (T_a nu)_ab to the gradient weights, T_a nu being the part
/// of nu_b - nu_a that no linear field explains, mends it without losing linear exactness; nu
/// solves S nu = s - sum_a V_a G_a with the symmetric S = sum_a V_a^2 T_a^T diag(kappa_a) T_a.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/consistency.md).
///
/// @param rows  first search; no row re-searched
/// @param area_vector  [m^(Dim-1)] n x Dim, s_b; over all particles sum s = 0 and
///   sum s x X = |Omega| I (boundary.hpp computes it)
/// @returns nu, n x Dim, to a relative residual of 1e-10 per component, or round-off. Cost: one
/// sparse
///   factorisation, or one per component if there are images.
/// @throws ShapeError if sizes disagree; std::runtime_error if the factorisation fails or the
///   tolerance is not reached, as it cannot be if s does not close the surface.
template <int Dim>
Field<Dim> consistency_potential(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                 const Field<Dim>& area_vector);

/// Force patch error of a set: sum_a V_a G_ab - s_b, n x Dim, before any correction.
template <int Dim>
Field<Dim> consistency_defect(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                              const Field<Dim>& area_vector);

}  // namespace fpm
