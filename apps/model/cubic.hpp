#pragma once

#include <Eigen/Core>

#include "constitutive/tensor.hpp"
#include "fpm/types.hpp"

namespace model {

/// Number of monomials up to the third degree: 10 in the plane, 20 in space.
template <int Dim>
inline constexpr Eigen::Index cubic_terms = Dim == 2 ? 10 : 20;

/// A value for each monomial, the constant and the Dim linear ones first.
template <int Dim>
using CubicTerms = Eigen::Matrix<double, cubic_terms<Dim>, 1>;

/// The monomials at a place.
template <int Dim>
CubicTerms<Dim> cubic_values(const fpm::Vector<Dim>& x);

/// Strain there of the displacement whose component i is sum_k c[i * cubic_terms + k] monomial_k:
/// one column for each c.
template <int Dim>
Eigen::Matrix<double, constitutive::stress_size<Dim>, Dim * cubic_terms<Dim>> cubic_strains(
    const fpm::Vector<Dim>& x);

}  // namespace model
