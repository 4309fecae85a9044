#pragma once

#include <Eigen/Core>
#include <cmath>

#include "constitutive/elastic.hpp"
#include "constitutive/spectral.hpp"
#include "constitutive/state.hpp"

namespace constitutive::detail {

/// Takes a return in principal stress space into the state: its stress, and the plastic strains by
/// which elasticity explains what it removed of the trial `x`.
template <int Dim>
void accept_return(const ElasticModuli& moduli, const Spectrum& x, const Eigen::Vector3d& returned,
                   PointState<Dim>& state) {
  state.stress = recompose<Dim>(returned, x.directions);
  const Eigen::Vector3d removed = x.values - returned;
  const double p = removed.mean();
  const double sqrt_j2 = std::sqrt((removed.array() - p).square().sum() / 2);
  state.plastic_strain += equivalent_elastic_strain(moduli, p, sqrt_j2);
  state.plastic_volume_strain += p / moduli.bulk;
}

}  // namespace constitutive::detail
