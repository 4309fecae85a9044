#pragma once

#include "constitutive/mixed.hpp"

namespace constitutive {

/// A material whose return is that of one stress: sub-points that share a pressure are not for it.
template <class M>
concept WithoutSubpoints = M::without_subpoints;

/// Sub-points that share one pressure are not for it: failed, always.
template <WithoutSubpoints Material, std::size_t M, int Dim>
MixedResult<M, Dim> mixed_return(const Material&, const MixedTrial<M, Dim>&,
                                 const std::array<double, M>&, double) {
  MixedResult<M, Dim> r;
  r.outcome.failed = true;
  return r;
}

/// Beside `mixed_return`, whose failure leaves nothing to be linearised: the identity.
template <WithoutSubpoints Material, std::size_t M, int Dim>
MixedTangent<M, Dim> mixed_tangent(const Material& material, const MixedTrial<M, Dim>& trial,
                                   const std::array<double, M>& weights,
                                   double plastic_volume_strain, const MixedResult<M, Dim>& r) {
  return mixed_tangent(Elastic{material.moduli}, trial, weights, plastic_volume_strain, r);
}

}  // namespace constitutive
