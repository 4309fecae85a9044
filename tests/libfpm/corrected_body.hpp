#pragma once

#include <fpm/boundary.hpp>
#include <fpm/boundary_loads.hpp>
#include <fpm/consistency.hpp>
#include <vector>

#include "operator_reference.hpp"

// Bodies with the consistency correction, and the loads of constant stresses on them.
namespace fpm_test {

using fpm::Face;
using fpm::MomentOperator;
using fpm::PointOperator;

// The relative residual that the solver promises for each component, in the 2-norm.
constexpr double solver_tolerance = 1e-10;

/// A box of particles, its boundary and its correction; x = box.min[0] may be a plane of symmetry.
template <int Dim>
struct Corrected {
  LatticeOptions<Dim> box;
  Model<Dim> model;
  std::vector<Face> faces;
  fpm::BoundaryPoints<Dim> points;
  PointOperator<Dim> at_points;
  Field<Dim> area;
  fpm::ConsistencyCorrection<Dim> correction;
  MomentOperator<Dim> op;

  Corrected(const LatticeOptions<Dim>& lattice, bool symmetric)
      : Corrected(Cells<Dim>(lattice), symmetric) {}
  Corrected(const Cells<Dim>& cells, bool symmetric)
      : box(cells.lattice()),
        model(
            make_particles(cells), row_options<Dim>(box.spacing),
            symmetric ? std::vector<SymmetryPlane>{{0, box.min[0]}} : std::vector<SymmetryPlane>{}),
        faces(fpm::all_faces<Dim>()) {
    if (symmetric) faces.erase(faces.begin());
    if (box.layout == LatticeLayout::vertex && box.jitter == 0.0 && !symmetric) {
      area = fpm::tributary_area_vectors(box, faces);
      std::vector<Index> particles;
      for (const Face& face : faces) {
        const auto tributary = fpm::tributary_points(box, face);
        points.append(tributary.points);
        particles.insert(particles.end(), tributary.particle.begin(), tributary.particle.end());
      }
      at_points = PointOperator<Dim>::at_particles(model.set, model.ghosts, particles,
                                                   row_options<Dim>(box.spacing));
    } else {
      for (const Face& face : faces) points.append(boundary_quadrature(cells, face));
      std::vector<Index> own;
      for (Index c = 0; c < points.size(); ++c) {
        own.push_back(cells.containing(points.position.row(c).transpose()));
      }
      at_points = PointOperator<Dim>(model.set, model.ghosts, points.position,
                                     row_options<Dim>(box.spacing), own);
      area = area_vectors(at_points, points);
    }
    correction = consistency_correction(model.rows, model.ghosts, area);
    op = MomentOperator<Dim>(model.rows, model.ghosts, {}, correction);
  }

  Index size() const { return op.size(); }

  /// Internal force of a constant stress, by either operator.
  Field<Dim> internal_force(const MomentOperator<Dim>& by, const Tensor<Dim>& stress) const {
    const Eigen::MatrixXd all =
        model.set.volume * Eigen::RowVectorXd(stress.reshaped().transpose());
    const Field<Dim> zero = Field<Dim>::Zero(size(), Dim);
    return scattered(by, all, zero, zero);
  }

  /// Force of the tractions sigma n on the faces.
  Field<Dim> external_force(const Tensor<Dim>& stress) const {
    Field<Dim> force = Field<Dim>::Zero(size(), Dim);
    add_traction(at_points, points, Field<Dim>(points.normal * stress.transpose()), force);
    return force;
  }
};

/// A symmetric stress; with a plane of symmetry normal to x, one that it admits.
template <int Dim>
Tensor<Dim> some_stress(bool symmetric) {
  Tensor<Dim> stress = some_tensor<Dim>() + some_tensor<Dim>().transpose();
  for (int i = 1; i < Dim && symmetric; ++i) stress(0, i) = stress(i, 0) = 0.0;
  return stress;
}

/// The gradient weights of a row.
template <int Dim>
std::vector<double> gradient_weights(const MomentOperator<Dim>& op, Index row) {
  std::vector<double> all;
  op.for_each_entry(row, [&](Index, const double* g) { all.insert(all.end(), g, g + Dim); });
  return all;
}

}  // namespace fpm_test
