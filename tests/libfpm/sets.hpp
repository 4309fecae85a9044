#pragma once

#include <Eigen/LU>
#include <fpm/cells.hpp>
#include <fpm/moment_operator.hpp>
#include <limits>
#include <random>
#include <vector>

// Particle sets and fields that the tests share.
namespace fpm_test {

using fpm::Cells;
using fpm::Field;
using fpm::GhostPlane;
using fpm::Ghosts;
using fpm::Index;
using fpm::LatticeLayout;
using fpm::LatticeOptions;
using fpm::ParticleSet;
using fpm::RowOptions;
using fpm::Rows;
using fpm::symmetry_plane;
using fpm::Tensor;
using fpm::Vector;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// R over the spacing: the usual one.
constexpr double support = 2.4;

/// Bound of the round-off of a sum of `terms` products no larger than `largest`, summed in any
/// order and compared with another such sum: each has a relative error below (terms + 1) epsilon
/// per product.
inline double round_off(double terms, double largest) {
  return 2.0 * (terms + 1.0) * terms * epsilon * largest;
}

template <int Dim>
using Counts = Eigen::Matrix<Index, Dim, 1>;

/// A lattice of `cells` cells of the given spacing, its lower corner at `origin` on every axis.
template <int Dim>
LatticeOptions<Dim> lattice(const Counts<Dim>& cells, double spacing = 0.1,
                            LatticeLayout layout = LatticeLayout::cell, double jitter = 0.0,
                            double origin = 0.0) {
  LatticeOptions<Dim> options;
  options.min.setConstant(origin);
  options.max = options.min + spacing * cells.template cast<double>();
  options.spacing = spacing;
  options.layout = layout;
  options.jitter = jitter;
  return options;
}

/// A tree in a box of `cells` finest cells, whose cells grow with the distance from its lower
/// corner up to four spacings.
template <int Dim>
Cells<Dim> graded_cells(const Counts<Dim>& cells, double spacing = 0.1, double jitter = 0.0) {
  const auto box = lattice<Dim>(cells, spacing, LatticeLayout::cell, jitter);
  return Cells<Dim>(box, [&](const Vector<Dim>& lower, const Vector<Dim>& /*upper*/) {
    return std::min(4.0 * spacing, std::max(spacing, 0.4 * (lower - box.min).norm()));
  });
}

template <int Dim>
RowOptions row_options(double spacing = 0.1, bool second = false) {
  RowOptions options;
  options.support_radius = support * spacing;
  options.spacing = spacing;
  options.second = second;
  return options;
}

/// A plane of symmetry in any dimension.
struct SymmetryPlane {
  int axis;
  double position;
};

template <int Dim>
std::vector<GhostPlane<Dim>> planes_of_symmetry(const std::vector<SymmetryPlane>& planes) {
  std::vector<GhostPlane<Dim>> result;
  for (const auto& [axis, position] : planes) result.push_back(symmetry_plane<Dim>(axis, position));
  return result;
}

/// A set with its images and rows.
template <int Dim>
struct Model {
  ParticleSet<Dim> set;
  Ghosts<Dim> ghosts;
  Rows<Dim> rows;

  Model(ParticleSet<Dim> particles, const RowOptions& options,
        const std::vector<SymmetryPlane>& planes = {})
      : set(std::move(particles)),
        ghosts(fpm::make_ghosts(set, planes_of_symmetry<Dim>(planes), options)),
        rows(set, ghosts, options) {}
  explicit Model(const LatticeOptions<Dim>& options, bool second = false,
                 const std::vector<SymmetryPlane>& planes = {})
      : Model(fpm::make_lattice(options), row_options<Dim>(options.spacing, second), planes) {}
};

/// Numbers between -1 and 1 that depend on the seed alone.
inline Eigen::VectorXd random_vector(Eigen::Index n, unsigned seed) {
  std::mt19937_64 generator(seed);
  Eigen::VectorXd v(n);
  for (double& x : v) x = static_cast<double>(generator() >> 11U) * 0x1.0p-52 - 1.0;
  return v;
}

template <int Dim>
Field<Dim> random_field(Eigen::Index n, unsigned seed) {
  return random_vector(n * Dim, seed).template reshaped<Eigen::ColMajor>(n, Dim);
}

/// A full tensor near the identity, without any symmetry.
template <int Dim>
Tensor<Dim> some_tensor(unsigned seed = 7) {
  return Tensor<Dim>::Identity() +
         0.3 * random_vector(Dim * Dim, seed).template reshaped<Eigen::ColMajor>(Dim, Dim);
}

/// x -> translation + A x of every particle.
template <int Dim>
Field<Dim> affine(const Field<Dim>& position, const Tensor<Dim>& a,
                  const Vector<Dim>& translation) {
  return (position * a.transpose()).rowwise() + translation.transpose();
}

}  // namespace fpm_test
