#include "model/cubic.hpp"

#include <array>
#include <cstddef>

namespace model {
namespace {

template <int Dim>
using Exponents = std::array<int, Dim>;

template <int Dim>
std::array<Exponents<Dim>, cubic_terms<Dim>> make_monomials() {
  std::array<Exponents<Dim>, cubic_terms<Dim>> all;
  std::size_t k = 0;
  for (int degree = 0; degree <= 3; ++degree) {
    for (int i = degree; i >= 0; --i) {
      if constexpr (Dim == 2) {
        all[k++] = {i, degree - i};
      } else {
        for (int j = degree - i; j >= 0; --j) all[k++] = {i, j, degree - i - j};
      }
    }
  }
  return all;
}

template <int Dim>
const std::array<Exponents<Dim>, cubic_terms<Dim>>& monomials() {
  static const auto all = make_monomials<Dim>();
  return all;
}

template <int Dim>
double value_of(const Exponents<Dim>& exponents, const fpm::Vector<Dim>& x) {
  double product = 1.0;
  for (int i = 0; i < Dim; ++i) {
    for (int k = 0; k < exponents[static_cast<std::size_t>(i)]; ++k) product *= x[i];
  }
  return product;
}

template <int Dim>
double slope_of(Exponents<Dim> exponents, int along, const fpm::Vector<Dim>& x) {
  int& power = exponents[static_cast<std::size_t>(along)];
  if (power == 0) return 0.0;
  const double factor = power--;
  return factor * value_of<Dim>(exponents, x);
}

}  // namespace

template <int Dim>
CubicTerms<Dim> cubic_values(const fpm::Vector<Dim>& x) {
  CubicTerms<Dim> values;
  Eigen::Index k = 0;
  for (const auto& exponents : monomials<Dim>()) values[k++] = value_of<Dim>(exponents, x);
  return values;
}

template <int Dim>
Eigen::Matrix<double, constitutive::stress_size<Dim>, Dim * cubic_terms<Dim>> cubic_strains(
    const fpm::Vector<Dim>& x) {
  constexpr std::array<std::array<int, 2>, 3> shear_axes{{{0, 1}, {1, 2}, {2, 0}}};
  constexpr Eigen::Index n = cubic_terms<Dim>;
  Eigen::Matrix<double, constitutive::stress_size<Dim>, Dim * n> strain;
  strain.setZero();
  for (Eigen::Index k = 0; k < n; ++k) {
    for (int axis = 0; axis < Dim; ++axis) {
      const double slope = slope_of<Dim>(monomials<Dim>()[static_cast<std::size_t>(k)], axis, x);
      strain(axis, axis * n + k) += slope;
      for (int s = 3; s < constitutive::stress_size<Dim>; ++s) {
        const auto [i, j] = shear_axes[static_cast<std::size_t>(s - 3)];
        if (i == axis) strain(s, j * n + k) += slope;
        if (j == axis) strain(s, i * n + k) += slope;
      }
    }
  }
  return strain;
}

template CubicTerms<2> cubic_values<2>(const fpm::Vector<2>&);
template CubicTerms<3> cubic_values<3>(const fpm::Vector<3>&);
template Eigen::Matrix<double, 4, 20> cubic_strains<2>(const fpm::Vector<2>&);
template Eigen::Matrix<double, 6, 60> cubic_strains<3>(const fpm::Vector<3>&);

}  // namespace model
