#include "model/wall_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "constitutive/utilisation.hpp"
#include "model/cubic.hpp"
#include "model/wall_yield.hpp"

namespace model {
namespace {

// What of it acts along the wall: P s P with P = I - n n.
template <int Dim>
fpm::Tensor<Dim> tangential(const constitutive::StressVector<Dim>& s, const fpm::Vector<Dim>& n) {
  const fpm::Tensor<Dim> along = fpm::Tensor<Dim>::Identity() - n * n.transpose();
  return along * constitutive::spatial_part<Dim>(s) * along;
}

}  // namespace

template <int Dim>
constitutive::StressVector<Dim> behind_mirror(constitutive::StressVector<Dim> stress,
                                              const fpm::Vector<Dim>& sign) {
  constexpr std::array<std::array<int, 2>, 3> shear_axes{{{0, 1}, {1, 2}, {2, 0}}};
  for (int k = 3; k < constitutive::stress_size<Dim>; ++k) {
    const auto [i, j] = shear_axes[static_cast<std::size_t>(k - 3)];
    stress[k] *= sign[i] * sign[j];
  }
  return stress;
}

// Which part of what the stage's changes left unbalanced here is still there.
template <int Dim>
double WallStress<Dim>::unbalanced(const State<Dim>& state, const Stress& stress) const {
  if (state.unbalanced.rows() == 0) return 0.0;
  double force = 0.0;
  for (const Served& one : served_) force += state.unbalanced.row(one.particle).norm();
  constexpr double round_off = 0.01;  // more than the solver's tolerance
  if (force <= round_off * area_ * std::max(stress.norm(), initial_.norm())) return 0.0;
  return 1.0 - fades_ * state.programme.progress;
}

template <int Dim>
double WallStress<Dim>::share(const State<Dim>& state, const Stress& stress,
                              const Eigen::VectorXd& coefficients) const {
  return std::min({fits_, 1.0 - yielded(state, stress), small(state, coefficients)});
}

// How much of the strain around is plastic: all from a twentieth of the elastic strain on.
template <int Dim>
double WallStress<Dim>::yielded(const State<Dim>& state, const Stress& stress) const {
  if (state.plastic_strain.size() == 0) return 0.0;
  double most = 0.0;
  for (const Served& one : served_) most = std::max(most, state.plastic_strain[one.particle]);
  constexpr double all_of = 20.0;
  const double elastic = stress.norm() / modulus_;
  return most > 0.0 ? std::min(1.0, all_of * most / elastic) : 0.0;
}

// How much of a stress counts that bears the walls where they were in the beginning.
template <int Dim>
double WallStress<Dim>::small(const State<Dim>& state, const Eigen::VectorXd& coefficients) const {
  if (!state.layout.finite) return 1.0;
  constexpr double all = 0.02, none = 0.1;  // displacement gradients
  const Eigen::Index n = coefficients.size() / Dim;
  double square = 0.0;
  for (int axis = 0; axis < Dim; ++axis) {
    square += coefficients.segment<Dim>(axis * n + 1).squaredNorm();
  }
  return std::clamp((none - std::sqrt(square)) / (none - all), 0.0, 1.0);
}

// The stress of a particle over that before the first step.
template <int Dim>
constitutive::StressVector<Dim> WallStress<Dim>::added_to(const State<Dim>& state,
                                                          fpm::Index a) const {
  Stress added = state.stress.col(a);
  if (model_->initial_stress.size() > 0) added -= model_->initial_stress.col(a);
  if (model_->stress_at_rest.size() > 0) added -= model_->stress_at_rest.col(a);
  return added;
}

// Stress along the wall of a thin body is what bends it if it changes its sign on the way across.
template <int Dim>
double WallStress<Dim>::unbent(const State<Dim>& state) const {
  if (across_ < 0) return 1.0;
  const auto along = [&](fpm::Index a) { return tangential<Dim>(added_to(state, a), normal_); };
  const auto here = along(own_), across = along(across_);
  constexpr double none = 0.5, all = 0.75;  // the bending share of it
  const double bent = (here - across).norm(), both = (here + across).norm();
  return both > 0.0 ? std::clamp((all - bent / both) / (all - none), 0.0, 1.0) : 0.0;
}

// Beside a traction that jumps, or the end of a crack, no cubic function bears what the walls do:
// how much of the stress added around is missing there says so.
template <int Dim>
double WallStress<Dim>::explained(const State<Dim>& state, const Eigen::VectorXd& right) const {
  double particles = 0.0, points = 0.0, stress = 0.0;
  for (const Served& one : served_) {
    const double square = one.weight * one.weight;
    particles += square;
    stress += square * added_to(state, one.particle).squaredNorm();
  }
  for (const Wall& wall : walls_) points += wall.weight * wall.weight;
  if (!(stress > 0.0)) return 0.0;  // at rest the particles know what was there
  Eigen::VectorXd left = fit_.householderQ().adjoint() * right;
  left.head(fit_.cols()).setZero();
  left.applyOnTheLeft(fit_.householderQ());
  const double borne = left.tail(Dim * static_cast<Eigen::Index>(walls_.size())).norm();
  const double missing = borne / std::sqrt(points) / std::sqrt(stress / particles);
  // A round bore of ten cells to the radius leaves 0.06, of five up to 0.19; three cells from a
  // corner that points inwards it is 0.07, at the edge of a load 0.16 to 0.43.
  constexpr double all = 0.06, none = 0.15;
  return std::clamp((none - missing) / (none - all), 0.0, 1.0);
}

template <int Dim>
fpm::Vector<Dim> WallStress<Dim>::borne_by(const Wall& wall, double load, double left_over) const {
  const fpm::Vector<Dim> bears = wall.constant + load * wall.growing;
  if (left_over == 0.0) return bears;
  return bears +
         left_over * (constitutive::spatial_part<Dim>(wall.initial) * wall.normal - wall.constant);
}

// What the cubic functions are to be: displacements, and what walls bear beyond the initial stress.
template <int Dim>
Eigen::VectorXd WallStress<Dim>::wanted(const State<Dim>& state, double left_over) const {
  Eigen::VectorXd right(fit_.rows());
  Eigen::Index row = 0;
  for (const Served& one : served_) {
    right.segment<Dim>(row) =
        one.weight / radius_ *
        one.sign.cwiseProduct(state.displacement.row(one.particle).transpose());
    row += Dim;
  }
  for (const Wall& wall : walls_) {
    right.segment<Dim>(row) =
        wall.weight * (borne_by(wall, state.programme.load, left_over) -
                       constitutive::spatial_part<Dim>(wall.initial) * wall.normal);
    row += Dim;
  }
  return right;
}

// By how much what presses on the wall differs next to the point.
template <int Dim>
double WallStress<Dim>::jump_of_pressure(const State<Dim>& state) const {
  const auto pressing = [&](const Wall& wall) {
    return wall.normal.dot(borne_by(wall, state.programme.load, 0.0));
  };
  double most = 0.0;
  for (const Wall& wall : walls_) {
    if (wall.is_beside)
      most = std::max(most, std::abs(pressing(wall) - pressing(walls_[nearest_])));
  }
  return most;
}

// Where the ground is yielding its strength says what the strain no longer does.
// @param here  the particles' stress on the wall, and the plastic strains there
template <int Dim>
constitutive::StressVector<Dim> WallStress<Dim>::yielding(const State<Dim>& state,
                                                          constitutive::PointState<Dim> here,
                                                          const fpm::Vector<Dim>& bears,
                                                          const Stress& stress,
                                                          double known) const {
  const auto& law = model_->laws[model_->law[static_cast<std::size_t>(own_)]];
  constexpr double none = 0.95, all = 0.99;  // of its strength
  double yielding = 0.0;                     // share of the particles next to the point
  here.stress.setZero();                     // one's may be far from its neighbours': their mean
  for (const auto& [k, share] : beside_) {
    const auto& [a, sign, weight] = served_[k];
    const Stress there = state.stress.col(a);
    const double used = constitutive::utilisation<Dim>(law, there, state.plastic_volume_strain[a],
                                                       state.plastic_strain[a]);
    if (state.plastic_strain[a] > 0.0) {
      yielding += share * std::clamp((used - none) / (all - none), 0.0, 1.0);
    }
    here.stress += share * behind_mirror<Dim>(there, sign);
  }
  constexpr double few = 0.25, most = 0.75, one_load = 0.1;
  const double part = known * std::clamp((yielding - few) / (most - few), 0.0, 1.0);
  if (part == 0.0 || jump_of_pressure(state) > one_load * here.stress.norm()) return stress;
  const auto yields = yielding_on_wall<Dim>(law, here, normal_, bears);
  return yields ? Stress(stress + part * (*yields - stress)) : stress;
}

template <int Dim>
constitutive::StressVector<Dim> WallStress<Dim>::of(const State<Dim>& state,
                                                    const Stress& interpolated) const {
  Stress stress = interpolated;
  const double left_over = unbalanced(state, interpolated);
  // What walls bore when a later stage began is not known.
  const double known = begins_at_rest_ ? 1.0 : 1.0 - left_over;
  const bool plastic = state.plastic_strain.size() > 0;
  constitutive::PointState<Dim> here, after;
  here.stress = interpolated;
  if (plastic) {
    here.plastic_strain = state.plastic_strain[own_];
    here.plastic_volume_strain = state.plastic_volume_strain[own_];
  }
  if (known > 0.0) {
    const Eigen::VectorXd right = wanted(state, left_over);
    const Eigen::VectorXd coefficients = fit_.solve(right);
    const Stress fitted =
        initial_ + stiffness_ * (cubic_strains<Dim>(fpm::Vector<Dim>::Zero()) * coefficients);
    stress += known * share(state, interpolated, coefficients) * unbent(state) *
              explained(state, right) * (fitted - interpolated);
    if (plastic) {
      stress = yielding(state, here, borne_by(walls_[nearest_], state.programme.load, left_over),
                        stress, known * yielded(state, interpolated) * small(state, coefficients));
    }
  }
  if (!plastic) return stress;
  // What is extrapolated to a wall may be beyond yield where no particle is.
  const auto law = model_->law[static_cast<std::size_t>(own_)];
  const auto outcome = constitutive::update<Dim>(model_->laws[law], stress, here, after);
  return outcome.failed ? interpolated : after.stress;
}

template constitutive::StressVector<2> behind_mirror<2>(constitutive::StressVector<2>,
                                                        const fpm::Vector<2>&);
template constitutive::StressVector<3> behind_mirror<3>(constitutive::StressVector<3>,
                                                        const fpm::Vector<3>&);
template class WallStress<2>;
template class WallStress<3>;

}  // namespace model
