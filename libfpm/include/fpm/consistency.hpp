#pragma once

#include <vector>

#include "fpm/ghosts.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// The consistency correction of a set's first rows.
template <int Dim>
struct ConsistencyCorrection {
  Field<Dim> potential;         ///< n x Dim, nu; empty for no correction
  std::vector<char> corrected;  ///< per row, whether it is corrected

  bool corrects(Index row) const {
    return potential.rows() > 0 && corrected[static_cast<std::size_t>(row)] != 0;
  }
  std::size_t bytes() const {
    return static_cast<std::size_t>(potential.size()) * sizeof(double) + corrected.size();
  }
};

/// Computes the consistency correction.
///
/// Gradients are exact on linear fields, but their integral sum_a V_a G_ab differs from the
/// boundary area vector s_b, so a constant stress would load the particles near boundaries and on
/// irregular sets. Adding V_a kappa_ab (T_a nu)_ab to the gradient weights, T_a nu being the part
/// of nu_b - nu_a that no linear field explains, mends it without losing linear exactness; nu
/// solves S nu = s - sum_a V_a G_a with the symmetric S = sum_a V_a^2 T_a^T diag(kappa_a) T_a.
/// Only rows whose neighbourhoods are not balanced (sum kappa X = 0) are corrected, all others
/// where that does not suffice: inside a lattice rows keep the stencil they share.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/consistency.md).
///
/// @param rows  first search; no row re-searched
/// @param area_vector  [m^(Dim-1)] n x Dim, s_b; over all particles sum s = 0 and
///   sum s x X = |Omega| I (boundary.hpp computes it)
/// @returns nu to a relative residual of 1e-10 per component, or round-off; none if nothing but
///   round-off is missing. Cost: one sparse solve over the corrected rows, or one per
///   component if there are images.
/// @throws ShapeError if sizes disagree; std::runtime_error if the factorisation fails or the
///   tolerance is not reached, as it cannot be if s does not close the surface.
template <int Dim>
ConsistencyCorrection<Dim> consistency_correction(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                                  const Field<Dim>& area_vector);

/// Force patch error of a set: sum_a V_a G_ab - s_b, n x Dim, before any correction.
template <int Dim>
Field<Dim> consistency_defect(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                              const Field<Dim>& area_vector);

}  // namespace fpm
