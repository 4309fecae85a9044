#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <utility>
#include <vector>

#include "limit/problem/problem.hpp"

/// The equations of both bounds once more, in 50 digits: nothing of limit's assembly and
/// certificates is used. One soil.
namespace exact_equations {

using Real = boost::multiprecision::cpp_bin_float_50;

/// Far below double precision, far above the last of 50 digits.
inline const Real exact = Real("1e-38");

struct Row {
  std::vector<std::pair<std::size_t, Real>> terms;
  Real right_side = 0;

  Real residual(const std::vector<Real>& x) const {
    Real sum = right_side;
    for (const auto& [i, factor] : terms) sum -= factor * x[i];
    return sum;
  }
};

/// Sum of the terms.
Real value(const Row& row, const std::vector<Real>& x);

/// Least change of x that satisfies the rows: the correction's direction comes from a factorisation
/// in double, its size from residuals in 50 digits, again and again.
/// @return the largest residual that is left
Real satisfy_exactly(std::vector<Row> rows, std::vector<Real>& x);

struct Strength {
  Real cohesion, sine, cosine;
};

Strength strength_of(const limit::problem::Problem& problem);

/// Equilibrium in (xx, yy, xy) of each corner.
std::vector<Row> equilibrium(const limit::problem::Problem& problem, const Real& multiplier);

/// Normal stresses, times a square, that must not be tension: where the footing may lift off.
std::vector<Row> contacts(const limit::problem::Problem& problem);

/// Where soil flows: dilation, two measures of shear, weight; where it `opens`, dilation is free.
struct Flow {
  Row dilation;
  std::array<Row, 2> shear;
  Real weight, ratio;
  bool opens = false;
};

/// Of a quadratic velocity in each triangle, and of its jumps.
std::vector<Flow> flows(const limit::problem::Problem& problem);

/// Power of the dead loads and of the live ones at unit multiplier.
struct Power {
  Real dead = 0, live = 0;
};

Power power_of_loads(const limit::problem::Problem& problem, const std::vector<Real>& velocity);

}  // namespace exact_equations
