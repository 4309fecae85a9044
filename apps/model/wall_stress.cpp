#include "model/wall_stress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "constitutive/elastic.hpp"
#include "constitutive/material.hpp"
#include "constitutive/utilisation.hpp"
#include "model/cubic.hpp"
#include "model/planes.hpp"
#include "model/wall_yield.hpp"
#include "scene/course.hpp"
#include "scene/derived.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

constexpr double reach = 4.25;       // [spacings] radius of the fit
constexpr double wall_weight = 0.5;  // beta
constexpr double beside = 1.5;       // [spacings] of the particles next to the point

// Smooth, and zero from the radius on.
double weight_at(double r) {
  const double inside = 1.0 - r * r;
  return inside > 0.0 ? inside * inside : 0.0;
}

// n . s of a stress in Voigt's order.
template <int Dim>
fpm::Vector<Dim> traction(const constitutive::StressVector<Dim>& s, const fpm::Vector<Dim>& n) {
  if constexpr (Dim == 2) {
    return {s[0] * n[0] + s[3] * n[1], s[3] * n[0] + s[1] * n[1]};
  } else {
    return {s[0] * n[0] + s[3] * n[1] + s[5] * n[2], s[3] * n[0] + s[1] * n[1] + s[4] * n[2],
            s[5] * n[0] + s[4] * n[1] + s[2] * n[2]};
  }
}

// What of it acts along the wall: P s P with P = I - n n.
template <int Dim>
fpm::Tensor<Dim> tangential(const constitutive::StressVector<Dim>& s, const fpm::Vector<Dim>& n) {
  fpm::Tensor<Dim> tensor;
  for (int i = 0; i < Dim; ++i) tensor.col(i) = traction<Dim>(s, fpm::Vector<Dim>::Unit(i));
  const fpm::Tensor<Dim> along = fpm::Tensor<Dim>::Identity() - n * n.transpose();
  return along * tensor * along;
}

// Whether stress is what the elastic strain since the beginning has added to what was there.
template <int Dim>
bool follows_from_strain(const scene::Scene& scene, const Model<Dim>& model, fpm::Index own) {
  if (model.pore_pressure.size() > 0 || scene::has_new_ground(scene)) return false;
  if (!model.reduced_laws.empty()) return false;
  return !std::holds_alternative<constitutive::ModifiedCamClay>(
      model.laws[model.law[static_cast<std::size_t>(own)]]);
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

template <int Dim>
std::optional<WallStress<Dim>> WallStress<Dim>::at(const scene::Scene& scene,
                                                   const Model<Dim>& model,
                                                   const std::vector<WallPoint<Dim>>& walls,
                                                   const fpm::ParticleSet<Dim>& particles,
                                                   const Foot<Dim>& foot, fpm::Index own) {
  if (!follows_from_strain(scene, model, own)) return std::nullopt;
  WallStress result;
  result.model_ = &model;
  result.own_ = own;
  result.normal_ = foot.normal;
  result.fades_ = scene.course.fades;
  result.begins_at_rest_ = scene.course.stage == 0;
  result.spacing_ = model.spacing_at(own);
  result.radius_ = reach * result.spacing_;
  const auto& moduli = constitutive::moduli(model.laws[model.law[static_cast<std::size_t>(own)]]);
  result.stiffness_ = constitutive::elastic_stiffness<Dim>(moduli);
  result.modulus_ = model.youngs_modulus_of(own);
  std::vector<fpm::Vector<Dim>> places, on;
  if (!result.take_particles(particles, mirrors(scene, model), foot.place, places))
    return std::nullopt;
  if (!result.take_walls(walls, particles, foot, on)) return std::nullopt;
  const auto material = static_cast<std::size_t>(model.material[static_cast<std::size_t>(own)]);
  if (!scene::is_nearly_incompressible(scene.material[material])) {
    result.take_thickness(walls, particles, foot);
  }
  result.take_initial(places, on);
  if (result.fits_ == 0.0) return std::nullopt;
  result.factor(places, on);
  if (result.fit_.rank() < result.fit_.cols()) return std::nullopt;
  return result;
}

// Those around the point, images behind mirrors included; false if there are too few, if one is
// held or of another law.
template <int Dim>
bool WallStress<Dim>::take_particles(const fpm::ParticleSet<Dim>& particles,
                                     const std::vector<char>& mirrors,
                                     const fpm::Vector<Dim>& point,
                                     std::vector<fpm::Vector<Dim>>& places) {
  const auto at = [](fpm::Index a) { return static_cast<std::size_t>(a); };
  const Model<Dim>& model = *model_;
  const auto n = static_cast<fpm::Index>(particles.size());
  fpm::Field<Dim> position(n + model.ghosts.size(), Dim);
  position.topRows(n) = particles.position;
  model.ghosts.extend_positions(position.data(), n, position.rows());
  for (fpm::Index b = 0; b < static_cast<fpm::Index>(position.rows()); ++b) {
    const fpm::Vector<Dim> offset = position.row(b).transpose() - point;
    const double r = offset.norm() / radius_;
    const bool image = b >= n;
    if (r >= 1.0 || (image && !model.ghosts.made_by(b - n, mirrors))) continue;
    const fpm::Index a = image ? model.ghosts.source(b - n) : b;
    if (model.law[at(a)] != model.law[at(own_)]) return false;
    if (particles.body[at(a)] != particles.body[at(own_)]) continue;  // beyond a slot
    fpm::Vector<Dim> sign = fpm::Vector<Dim>::Ones();
    for (int i = 0; i < Dim; ++i) {
      if (model.prescribed[at(i * n + a)] != 0) return false;
      if (image) sign[i] = model.ghosts.sign(b - n, i);
    }
    const double cell = std::pow(spacing_, Dim);
    const double close = weight_at(offset.norm() / (beside * spacing_));
    if (close > 0.0) beside_.emplace_back(served_.size(), close);
    served_.push_back({a, sign, std::sqrt(weight_at(r) * particles.volume[a] / cell)});
    places.push_back(offset);
  }
  double sum = 0.0;
  for (const auto& [k, share] : beside_) sum += share;
  for (auto& [k, share] : beside_) share /= sum;
  constexpr std::size_t times = 2;  // as many particles as coefficients
  return served_.size() >= times * static_cast<std::size_t>(cubic_terms<Dim>);
}

// Those around the point; false if there is none, or one whose traction is not known, or that rises
// steeply from the tangent: at a corner that points inwards stress is singular.
template <int Dim>
bool WallStress<Dim>::take_walls(const std::vector<WallPoint<Dim>>& walls,
                                 const fpm::ParticleSet<Dim>& particles, const Foot<Dim>& foot,
                                 std::vector<fpm::Vector<Dim>>& on) {
  constexpr double near = 1.3;                  // radii
  constexpr double steep = 0.3, facing = -0.7;  // cosines of 70 and 135 degrees
  const fpm::Vector<Dim>& point = foot.place;
  const auto body_of = [&](fpm::Index a) { return particles.body[static_cast<std::size_t>(a)]; };
  for (const PenaltySupport<Dim>& support : model_->penalty_supports) {
    for (Eigen::Index c = 0; c < support.points.size(); ++c) {
      const fpm::Vector<Dim> offset = support.points.position.row(c).transpose() - point;
      if (offset.norm() < radius_) return false;
    }
  }
  const double piece = std::pow(spacing_, Dim - 1);
  for (const WallPoint<Dim>& wall : walls) {
    const fpm::Vector<Dim> offset = wall.position - point;
    const double r = offset.norm() / radius_;
    if (r >= near) continue;
    const bool beyond = wall.particle >= 0 && body_of(wall.particle) != body_of(own_);
    const double turned = wall.normal.dot(foot.normal);
    const bool faces = beyond && turned < facing;  // the other side of a slot
    if (turned < steep && !faces && offset.dot(foot.normal) > 0.0) return false;
    if (beyond) continue;
    if (r >= 1.0) continue;
    if (!wall.is_known) return false;
    area_ += wall.area;
    const double weight = std::sqrt(wall_weight * weight_at(r) * wall.area / piece) / modulus_;
    if (walls_.empty() || offset.norm() < on[nearest_].norm()) nearest_ = walls_.size();
    const bool is_beside = offset.norm() < beside * spacing_;
    walls_.push_back({wall.normal, wall.constant, wall.growing, Stress::Zero(), weight, is_beside});
    on.push_back(offset);
  }
  return !walls_.empty();
}

// The particle next to the wall straight across the body, if that is free and less than 18 spacings
// away: rows that walls cut let a body of so many cells bend by 6.5 / cells^2 too much, and from
// there on that is less than what the particles' own stress is off by. Next to incompressibility
// the latter is more than that in any body.
template <int Dim>
void WallStress<Dim>::take_thickness(const std::vector<WallPoint<Dim>>& walls,
                                     const fpm::ParticleSet<Dim>& particles,
                                     const Foot<Dim>& foot) {
  double least = 18.0 * spacing_;
  const WallPoint<Dim>* across = nullptr;
  for (const WallPoint<Dim>& wall : walls) {
    const fpm::Vector<Dim> offset = wall.position - foot.place;
    const double depth = -offset.dot(foot.normal);
    const double aside = (offset + depth * foot.normal).norm();
    if (depth <= 0.0 || depth >= least || aside > spacing_) continue;
    if (!wall.is_known || wall.is_image) continue;
    if (wall.normal.dot(foot.normal) > -0.5) continue;
    least = depth;
    across = &wall;
  }
  if (across == nullptr) return;
  Eigen::Index nearest = 0;
  (particles.position.rowwise() - across->position.transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  across_ = static_cast<fpm::Index>(nearest);
}

// The linear function that fits what was there before the first step.
template <int Dim>
void WallStress<Dim>::take_initial(const std::vector<fpm::Vector<Dim>>& places,
                                   const std::vector<fpm::Vector<Dim>>& on) {
  const auto& initial =
      model_->initial_stress.size() > 0 ? model_->initial_stress : model_->stress_at_rest;
  if (initial.size() == 0) return;
  const auto n = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd rows(n, Dim + 1);
  Eigen::Matrix<double, Eigen::Dynamic, stress_rows> right(n, stress_rows);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Served& one = served_[static_cast<std::size_t>(k)];
    rows(k, 0) = one.weight;
    rows.row(k).template tail<Dim>() =
        one.weight / radius_ * places[static_cast<std::size_t>(k)].transpose();
    right.row(k) = one.weight * behind_mirror<Dim>(initial.col(one.particle), one.sign).transpose();
  }
  const Eigen::MatrixXd linear = rows.colPivHouseholderQr().solve(right);
  initial_ = linear.row(0).transpose();
  // Around a hole that was there before, stress is not linear, and the displacement that made it is
  // not known. A linear one leaves round-off.
  constexpr double all = 0.01, none = 0.03;
  const double norm = right.norm();
  const double left = norm > 0.0 ? (rows * linear - right).norm() / norm : 0.0;
  fits_ = std::clamp((none - left) / (none - all), 0.0, 1.0);
  for (std::size_t k = 0; k < on.size(); ++k) {
    walls_[k].initial = initial_ + linear.template bottomRows<Dim>().transpose() * on[k] / radius_;
  }
}

template <int Dim>
void WallStress<Dim>::factor(const std::vector<fpm::Vector<Dim>>& places,
                             const std::vector<fpm::Vector<Dim>>& on) {
  constexpr Eigen::Index n = cubic_terms<Dim>;
  const auto particles = static_cast<Eigen::Index>(places.size());
  const auto points = static_cast<Eigen::Index>(on.size());
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(Dim * (particles + points), Dim * n);
  for (Eigen::Index k = 0; k < particles; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const CubicTerms<Dim> values = served_[i].weight * cubic_values<Dim>(places[i] / radius_);
    for (int axis = 0; axis < Dim; ++axis) {
      rows.row(Dim * k + axis).segment<n>(axis * n) = values.transpose();
    }
  }
  for (Eigen::Index k = 0; k < points; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const auto stress = (stiffness_ * cubic_strains<Dim>(on[i] / radius_)).eval();
    for (Eigen::Index c = 0; c < stress.cols(); ++c) {
      rows.col(c).segment<Dim>(Dim * (particles + k)) =
          walls_[i].weight * traction<Dim>(stress.col(c), walls_[i].normal);
    }
  }
  fit_.compute(rows);
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
  return bears + left_over * (traction<Dim>(wall.initial, wall.normal) - wall.constant);
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
    right.segment<Dim>(row) = wall.weight * (borne_by(wall, state.programme.load, left_over) -
                                             traction<Dim>(wall.initial, wall.normal));
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
