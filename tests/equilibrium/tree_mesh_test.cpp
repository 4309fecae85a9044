// Elements of a balanced tree: continuous across hanging nodes, exact on linear fields.
#include "equilibrium/tree_mesh.hpp"

#include <gtest/gtest.h>

#include "constitutive/material.hpp"
#include "equilibrium/elastic_block.hpp"

namespace {

using equilibrium::GridPoint;
using equilibrium::TreeMesh;

template <int Dim>
fpm::Cells<Dim> cells(int extent) {
  fpm::LatticeOptions<Dim> box;
  box.min.setConstant(-0.3);
  box.max.setConstant(-0.3 + 0.1 * extent);
  box.spacing = 0.1;
  return fpm::Cells<Dim>(box, [&](const fpm::Vector<Dim>& lower, const fpm::Vector<Dim>&) {
    return std::max(0.1, 0.4 * (lower - box.min).norm());
  });
}

// Values of all nodes from random ones of the free nodes.
template <int Dim>
Eigen::VectorXd nodal_values(const TreeMesh<Dim>& mesh) {
  Eigen::VectorXd values = Eigen::VectorXd::Random(mesh.nodes());
  values.tail(mesh.nodes() - mesh.free_nodes()).setZero();
  mesh.for_each_dependence([&](fpm::Index node, fpm::Index parent, double share) {
    EXPECT_GE(node, mesh.free_nodes());
    EXPECT_LT(parent, mesh.free_nodes());
    values[node] += share * values[parent];
  });
  return values;
}

template <int Dim>
double value_at(const TreeMesh<Dim>& mesh, const Eigen::VectorXd& nodal,
                const fpm::Vector<Dim>& place) {
  const GridPoint<Dim> at = mesh.at(place.transpose());
  double value = 0.0;
  for (int p = 0; p < at.corners; ++p) value += at.values[p] * nodal[at.nodes[p]];
  return value;
}

// On both sides of the face of every cell the interpolated field is the same.
template <int Dim>
void expect_continuity(const fpm::Cells<Dim>& set) {
  const TreeMesh<Dim> mesh(set);
  ASSERT_LT(mesh.free_nodes(), mesh.nodes());
  const Eigen::VectorXd nodal = nodal_values(mesh);
  constexpr double aside = 1e-9;
  set.for_each_pair([&](fpm::Index low, fpm::Index high, int axis) {
    const fpm::Index narrow = set.width(low) <= set.width(high) ? low : high;
    fpm::Vector<Dim> place = set.lower(narrow) + 0.3 * (set.upper(narrow) - set.lower(narrow));
    place[axis] = set.upper(low)[axis];
    fpm::Vector<Dim> below = place, above = place;
    below[axis] -= aside;
    above[axis] += aside;
    // Values below 1, slopes below 2 over the finest spacing.
    EXPECT_NEAR(value_at(mesh, nodal, below), value_at(mesh, nodal, above), 4.0 * aside / 0.1);
  });
}

TEST(TreeMesh, IsContinuousAcrossHangingNodes) {
  expect_continuity(cells<2>(24));
  expect_continuity(cells<2>(21));
  expect_continuity(cells<3>(12));
}

// u K u of a linear displacement is twice the elastic energy of its strain, and the forces K u act
// at the faces of the box alone: sum over all nodes of f = 0 and of u f for rigid u likewise.
template <int Dim>
void expect_energy(const fpm::Cells<Dim>& set) {
  const TreeMesh<Dim> mesh(set.coarsened(1));
  const constitutive::ElasticModuli moduli{.lame = 2.0, .shear = 1.5};
  typename TreeMesh<Dim>::Stiffness stiffness(mesh);
  for (fpm::Index a = 0; a < set.size(); ++a) {
    const double volume = std::pow(set.width(a), Dim);
    const Eigen::Matrix<double, 1, Dim> place = set.site(a).transpose();
    mesh.for_each_quadrature_point(
        mesh.at(place), place, set.width(a), [&](const GridPoint<Dim>& at, double share) {
          for (int p = 0; p < at.corners; ++p) {
            for (int q = 0; q < at.corners; ++q) {
              stiffness.add(
                  at, p, q,
                  share * volume *
                      equilibrium::elastic_block<Dim>(moduli, fpm::Vector<Dim>(at.gradients.col(p)),
                                                      fpm::Vector<Dim>(at.gradients.col(q))));
            }
          }
        });
  }
  auto entries = stiffness.entries();
  mesh.eliminate(entries);
  Eigen::SparseMatrix<double> k(mesh.free_nodes() * Dim, mesh.free_nodes() * Dim);
  k.setFromTriplets(entries.begin(), entries.end());
  EXPECT_LT((k - Eigen::SparseMatrix<double>(k.transpose())).norm(), 1e-14 * k.norm());

  fpm::Tensor<Dim> gradient;
  for (int i = 0; i < Dim; ++i) {
    for (int j = 0; j < Dim; ++j) gradient(i, j) = 0.3 + i - 0.7 * j;
  }
  const fpm::Tensor<Dim> strain = 0.5 * (gradient + gradient.transpose());
  const double volume = std::pow(set.lattice().max[0] - set.lattice().min[0], Dim);
  const double energy = volume * (moduli.lame * std::pow(strain.trace(), 2) +
                                  2.0 * moduli.shear * strain.squaredNorm());
  Eigen::VectorXd u(k.rows());
  for (fpm::Index node = 0; node < mesh.free_nodes(); ++node) {
    u.segment<Dim>(node * Dim) = gradient * mesh.place(node);
  }
  EXPECT_NEAR(u.dot(k * u), energy, 1e-12 * energy);
  const fpm::Tensor<Dim> spin = gradient - gradient.transpose();
  for (fpm::Index node = 0; node < mesh.free_nodes(); ++node) {
    u.segment<Dim>(node * Dim) = spin * mesh.place(node) + fpm::Vector<Dim>::Ones();
  }
  EXPECT_LT((k * u).norm(), 1e-12 * k.norm() * u.norm());
}

TEST(TreeMesh, HasTheEnergyOfLinearFields) {
  expect_energy(cells<2>(24));
  expect_energy(cells<2>(21));
  expect_energy(cells<3>(12));
}

}  // namespace
