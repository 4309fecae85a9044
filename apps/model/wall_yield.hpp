#pragma once

#include <optional>

#include "constitutive/material.hpp"
#include "constitutive/tensor.hpp"
#include "fpm/types.hpp"

namespace model {

/// The stress [Pa] on a wall of ground that is yielding there: it bears the wall's traction, and
/// along the wall it differs from what presses across it as the particles' stress does, by as much
/// more or less as takes it to the yield surface. Of their own stress the mean is not told by flow
/// that keeps its volume.
/// @param stress  [Pa] the particles' at the wall, whose plastic strains these are
/// @param normal  unit  @param bears  [Pa] traction
/// A tension cut-off does not count.
/// @return nothing, if the traction alone is beyond yield, or four times the difference is not
template <int Dim>
std::optional<constitutive::StressVector<Dim>> yielding_on_wall(
    const constitutive::Material& law, const constitutive::PointState<Dim>& point,
    const fpm::Vector<Dim>& normal, const fpm::Vector<Dim>& bears);

}  // namespace model
