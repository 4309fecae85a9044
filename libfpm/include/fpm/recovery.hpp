#pragma once

#include <vector>

#include "fpm/ghosts.hpp"
#include "fpm/kernel.hpp"
#include "fpm/particles.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// How a field is recovered from one that alternates from particle to particle.
struct RecoveryOptions {
  Kernel kernel = Kernel::cubic_spline;
  /// [m] > 0. From 3.2 spacings on, the cubic spline leaves less than 1 % of what alternates from
  /// one particle to the next. Where spacings differ (ParticleSet::spacing), of the finest.
  double radius = 0.0;
};

/// The smooth field behind one that alternates: at each particle the value of the linear function
/// that fits the field around it best, weighted by W V.
///
/// Nodal integration has modes of the mean stress, signs alternating by rows, by columns or both,
/// that exert no force on the particles and so are not determined. Linear fields are kept to
/// round-off, at faces, too; along a direction in which a neighbourhood has no extent (a seam of
/// one row) the fit is constant.
/// @param particles  where they are and what volumes they have now; of their bodies only a
///   particle's own takes part
/// @param planes  of these, mirrors serve: the field's image there is its mirror image
/// @returns n values, in the unit of the field. Independent of the number of threads.
/// @throws ShapeError if sizes disagree; std::invalid_argument unless the radius is positive
/// Departure: not in Chen, Huang & Lyamin 2020 (share/doc/decisions/recovered-mean-stress.md).
template <int Dim>
Eigen::VectorXd recover(const ParticleSet<Dim>& particles,
                        const Eigen::Ref<const Eigen::VectorXd>& field,
                        const std::vector<GhostPlane<Dim>>& planes, const RecoveryOptions& options);

}  // namespace fpm
