#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace fpm {

/// Index of a particle, a neighbour or a ghost; 32 bits halve the traffic of the neighbour lists.
using Index = std::int32_t;

/// A vector of the Dim-dimensional space. `Real` is double, or a type with the arithmetic of double
/// that holds the numbers of several particles side by side (the lanes of a vector register).
template <int Dim, class Real = double>
using Vector = Eigen::Matrix<Real, Dim, 1>;

/// A second-order tensor of the Dim-dimensional space; `Real` as for `Vector`.
template <int Dim, class Real = double>
using Tensor = Eigen::Matrix<Real, Dim, Dim>;

/// A nodal field, component-major: column i holds component i of every particle (n x Dim).
/// The same memory seen as one vector of length n Dim is what a solver works on.
template <int Dim>
using Field = Eigen::Matrix<double, Eigen::Dynamic, Dim>;

/// Number of distinct second derivatives: 3 in 2D (XX, XY, YY), 6 in 3D.
template <int Dim>
inline constexpr int second_gradient_size = Dim*(Dim + 1) / 2;

/// Misuse by a programmer: two sizes that must agree do not; the message names both.
class ShapeError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Throws ShapeError unless `found == expected`.
inline void require_size(const char* what, Eigen::Index found, Eigen::Index expected) {
  if (found != expected) {
    throw ShapeError(std::string(what) + " has size " + std::to_string(found) + ", expected " +
                     std::to_string(expected));
  }
}

}  // namespace fpm
