#include "equilibrium/initial_balance.hpp"

#include <cmath>

#include "constitutive/tensor.hpp"

namespace equilibrium {
namespace {

constexpr int up = 1;

// Nodal forces of the initial stress, extended to the images.
template <int Dim>
Eigen::VectorXd forces_of_stress(const model::Model<Dim>& model,
                                 const fpm::MomentOperator<Dim>& op) {
  const Eigen::Index n = model.size(), stride = op.stride();
  Eigen::VectorXd generalised = Eigen::VectorXd::Zero(stride * op.stress_count());
  for (Eigen::Index a = 0; a < n; ++a) {
    const fpm::Tensor<Dim> sigma = constitutive::spatial_part<Dim>(
        constitutive::StressVector<Dim>(model.initial_stress.col(a)));
    for (int k = 0; k < Dim * Dim; ++k) {
      generalised[k * stride + a] = model.particles.volume[a] * sigma.data()[k];
    }
  }
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(stride * Dim);
  Eigen::VectorXd force(stride * Dim);
  op.scatter(generalised.data(), nothing.data(), nothing.data(), force.data());
  return force;
}

// Of the initial tractions: those of the bodies, and what rigid bodies bear of them.
template <int Dim>
void add_interface_forces(const model::Model<Dim>& model, Eigen::Index stride,
                          Eigen::VectorXd& force, fpm::Field<Dim>& borne) {
  fpm::Field<Dim> by_bodies = fpm::Field<Dim>::Zero(model.size(), Dim);
  fpm::Field<Dim> by_rigid = by_bodies;
  for (const model::Interface<Dim>& interface : model.interfaces) {
    for (fpm::Index c = 0; c < interface.faces.points.size(); ++c) {
      const fpm::Vector<Dim> traction = interface.initial_traction.row(c).transpose();
      interface.faces.add_force(c, traction, interface.is_rigid() ? by_rigid : by_bodies);
    }
  }
  for (int i = 0; i < Dim; ++i) {
    force.segment(i * stride, model.size()) += by_bodies.col(i) + by_rigid.col(i);
  }
  borne -= by_rigid;
}

bool moves(const auto& model, std::size_t plane) {
  return !model.wall_bears && !model.plane_drive.empty() && !model.plane_drive[plane].isZero();
}

}  // namespace

template <int Dim>
void add_side_reactions(
    const model::Model<Dim>& model, const double* force, Eigen::Index stride,
    Eigen::Ref<typename model::State<Dim>::template Columns<model::State<Dim>::side_rows>> sides,
    std::optional<bool> moving) {
  const auto& planes = model.ghosts.planes();
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].symmetry || (moving && moves(model, p) != *moving)) continue;
    fpm::Field<Dim> of_plane = fpm::Field<Dim>::Zero(model.size(), Dim);
    model.ghosts.add_reactions(p, force, model.size(), stride, of_plane);
    sides.template middleRows<Dim>(static_cast<Eigen::Index>(model.plane_side[p]) * Dim) +=
        of_plane.transpose();
  }
}

// The supports bear weight and traction, to the last particle: what is missing is shared out by how
// much each bears, also where some press against others.
template <int Dim>
void bear_the_whole(const model::Model<Dim>& model, const Eigen::VectorXd& first,
                    Eigen::Index stride, const fpm::Field<Dim>& borne,
                    InitialBalance<Dim>& balance) {
  const double shared = borne.col(up).cwiseAbs().sum();
  if (shared == 0.0) return;
  const Eigen::Index n = model.size();
  const double missing = -model.initial_load.segment(up * n, n).sum() - borne.col(up).sum();
  const Eigen::VectorXd more = missing / shared * borne.col(up).cwiseSign();
  balance.reaction.col(up) += more.cwiseProduct(borne.col(up));
  if (!model.layout.thin) return;
  auto by_sides = balance.side_reaction;
  by_sides.setZero();
  add_side_reactions<Dim>(model, first.data(), stride, by_sides, false);
  for (int side = 0; side < 2 * Dim; ++side) {
    const int row = side * Dim + up;
    balance.side_reaction.row(row) += more.transpose().cwiseProduct(by_sides.row(row));
  }
}

// Whether the ground presses along this axis on a wall that is driven by its particles.
template <int Dim>
bool is_across_wall(const model::Model<Dim>& model, int axis) {
  return model.wall_force && (*model.wall_force)[axis] != 0.0;
}

template <int Dim>
bool is_driven(const model::Model<Dim>& model, Eigen::Index a) {
  for (int i = 0; i < Dim; ++i) {
    if (model.drive[i * model.size() + a] != 0.0) return true;
  }
  return false;
}

// A wall's particles have in them what the approximation leaves of the stress across their side on
// the next ones, where it is a dead load: with the opposite one on the wall it bears what it
// should.
template <int Dim>
void bear_at_the_wall(const model::Model<Dim>& model, const Eigen::VectorXd& force,
                      Eigen::Index stride, InitialBalance<Dim>& balance) {
  if (!model.wall_force) return;
  const Eigen::Index n = model.size();
  for (int i = 0; i < Dim; ++i) {
    if (!is_across_wall(model, i)) continue;
    double borne = 0.0, shared = 0.0;
    const auto for_each = [&](auto&& visit) {
      for (Eigen::Index a = 0; a < n; ++a) {
        if (!is_driven(model, a) || model.prescribed[static_cast<std::size_t>(i * n + a)] == 0) {
          continue;
        }
        visit(i * n + a, force[i * stride + a] - model.initial_load[i * n + a]);
      }
    };
    for_each([&](Eigen::Index, double here) {
      borne += here;
      shared += std::abs(here);
    });
    if (shared == 0.0) continue;
    const double missing = (*model.wall_force)[i] - borne;
    for_each(
        [&](Eigen::Index k, double here) { balance.load[k] = -missing * std::abs(here) / shared; });
  }
}

template <int Dim>
InitialBalance<Dim> balance_initial_stress(const model::Model<Dim>& model,
                                           const fpm::MomentOperator<Dim>& op) {
  const Eigen::Index n = model.size();
  Eigen::VectorXd force = forces_of_stress(model, op);
  InitialBalance<Dim> balance;
  balance.load.setZero(model.unknowns());
  // What moves bears nothing at first, unless it is a wall.
  fpm::Field<Dim> borne = fpm::Field<Dim>::Zero(n, Dim);
  fpm::Field<Dim> by_moving = borne;
  const auto& planes = model.ghosts.planes();
  balance.plane_force.assign(model.plane_drive.size(), fpm::Vector<Dim>::Zero());
  std::vector<fpm::Vector<Dim>> on_planes;
  model.ghosts.plane_forces(force.data(), n, op.stride(), on_planes);
  for (std::size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].symmetry) continue;
    model.ghosts.add_reactions(p, force.data(), n, op.stride(),
                               moves(model, p) ? by_moving : borne);
    if (moves(model, p)) balance.plane_force[p] = -on_planes[p];
  }
  balance.reaction = -by_moving;
  if (model.layout.thin) {
    balance.side_reaction.setZero(Eigen::NoChange, n);
    add_side_reactions(model, force.data(), op.stride(), balance.side_reaction, true);
    balance.side_reaction *= -1.0;
  }
  const Eigen::VectorXd first = model.layout.thin ? force : Eigen::VectorXd();
  add_interface_forces(model, op.stride(), force, borne);
  for (int i = 0; i < Dim; ++i) {
    for (Eigen::Index a = 0; a < n; ++a) {
      const Eigen::Index k = i * n + a;
      const double difference = force[i * op.stride() + a] - model.initial_load[k];
      // Of particles that are driven, too, across a wall of theirs.
      const bool held = model.prescribed[static_cast<std::size_t>(k)] != 0 &&
                        (model.drive[k] == 0.0 || is_across_wall(model, i));
      if (held) {
        borne(a, i) += difference;
      } else {
        balance.load[k] = difference;
      }
    }
  }
  bear_at_the_wall(model, force, op.stride(), balance);
  bear_the_whole(model, first, op.stride(), borne, balance);
  return balance;
}

template void add_side_reactions<2>(
    const model::Model<2>&, const double*, Eigen::Index,
    Eigen::Ref<model::State<2>::Columns<model::State<2>::side_rows>>, std::optional<bool>);
template void add_side_reactions<3>(
    const model::Model<3>&, const double*, Eigen::Index,
    Eigen::Ref<model::State<3>::Columns<model::State<3>::side_rows>>, std::optional<bool>);
template struct InitialBalance<2>;
template struct InitialBalance<3>;
template InitialBalance<2> balance_initial_stress<2>(const model::Model<2>&,
                                                     const fpm::MomentOperator<2>&);
template InitialBalance<3> balance_initial_stress<3>(const model::Model<3>&,
                                                     const fpm::MomentOperator<3>&);

}  // namespace equilibrium
