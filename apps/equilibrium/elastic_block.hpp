#pragma once

#include "constitutive/material.hpp"
#include "model/model.hpp"

namespace equilibrium {

/// Elastic moduli of a particle.
template <int Dim>
constitutive::ElasticModuli moduli_of(const model::Model<Dim>& model, Eigen::Index particle) {
  return constitutive::moduli(model.laws[model.law[static_cast<std::size_t>(particle)]]);
}

/// Stiffness of two nodes with gradients g, h in an isotropic body of unit volume.
template <int Dim>
fpm::Tensor<Dim> elastic_block(const constitutive::ElasticModuli& m, const fpm::Vector<Dim>& g,
                               const fpm::Vector<Dim>& h) {
  return m.lame * g * h.transpose() + m.shear * h * g.transpose() +
         m.shear * g.dot(h) * fpm::Tensor<Dim>::Identity();
}

}  // namespace equilibrium
