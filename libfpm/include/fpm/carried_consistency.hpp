#pragma once

#include <vector>

#include "fpm/ghosts.hpp"
#include "fpm/moment_operator.hpp"
#include "fpm/rows.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// The configuration in which rows were searched anew.
template <int Dim>
struct ReSearchedConfiguration {
  Eigen::VectorXd volume;  ///< [m^Dim] n, current
  /// [-] Dim^2 x n: deformation gradient of each row, from its reference before the re-search.
  Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic> deformation_gradient;
};

/// What was carried.
struct CarriedConsistency {
  /// The part of the change that is left, relative; round-off where the deformation is homogeneous,
  /// small where it is smooth.
  double left = 0.0;
  std::vector<Index> rows;  ///< rows whose weights changed, rebuilt ones among them, ascending
};

/// Carries the consistency correction through a re-search.
///
/// With v the current volumes and g = F^-T G the current gradient weights, a constant stress loads
/// particle b by sum_a v_a g_ab: on the sets that `consistency_correction` made, the boundary's
/// area vector. New neighbourhoods change that sum; potentials as there, over the rebuilt rows and
/// the rows they met or meet, restore it: what a re-search leaves out of balance is the variation
/// of stress alone. The work is in proportion to the number of rebuilt rows. Rows keep linear
/// exactness.
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/re-search.md).
///
/// @param before  operator of the rows as they were, correction included
/// @param rebuilt  what `rows.research` returned
/// @param rows  as searched anew; what the rows around had before is kept
/// @throws ShapeError if sizes disagree.
template <int Dim>
CarriedConsistency carry_consistency(const MomentOperator<Dim>& before, const Ghosts<Dim>& ghosts,
                                     const std::vector<Index>& rebuilt,
                                     const ReSearchedConfiguration<Dim>& now, Rows<Dim>& rows);

}  // namespace fpm
