#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "fpm/moment_operator.hpp"
#include "model/model.hpp"
#include "model/state.hpp"

namespace equilibrium {

/// What keeps a body at rest under its initial stress.
///
/// That stress is exact in the continuum; on particles its forces and the lumped weight differ by
/// what the approximation makes of a stress that is not constant, mostly beside the faces. As a
/// dead load of its own the difference lets nothing move that would not move in the continuum.
template <int Dim>
struct InitialBalance {
  Eigen::VectorXd load;      // [N/m or N] dead load; none at unknowns that a support holds
  fpm::Field<Dim> reaction;  // to be added to the supports', by particle: they bear the same in all
  std::vector<fpm::Vector<Dim>> plane_force;  // likewise to that of each moving plane, or empty
  // Likewise to State::side_reaction, if there is one.
  typename model::State<Dim>::template Columns<model::State<Dim>::side_rows> side_reaction;
};

/// Adds what the images carry onto the particles, plane by plane, to rows of the planes' sides.
/// @param force  extended to the images, components `stride` apart
/// @param moving  only of planes that a drive moves, or of the others
template <int Dim>
void add_side_reactions(
    const model::Model<Dim>& model, const double* force, Eigen::Index stride,
    Eigen::Ref<typename model::State<Dim>::template Columns<model::State<Dim>::side_rows>> sides,
    std::optional<bool> moving = std::nullopt);

/// @param op  on the initial rows, with the consistency correction if it is on
template <int Dim>
InitialBalance<Dim> balance_initial_stress(const model::Model<Dim>& model,
                                           const fpm::MomentOperator<Dim>& op);

}  // namespace equilibrium
