// What a stress on a wall is made of: the particles and the walls around, and the fit to them.
#include <algorithm>
#include <cmath>

#include "constitutive/elastic.hpp"
#include "model/cubic.hpp"
#include "model/planes.hpp"
#include "model/wall_stress.hpp"
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
          walls_[i].weight *
          (constitutive::spatial_part<Dim>(Stress(stress.col(c))) * walls_[i].normal);
    }
  }
  fit_.compute(rows);
}

template std::optional<WallStress<2>> WallStress<2>::at(const scene::Scene&, const Model<2>&,
                                                        const std::vector<WallPoint<2>>&,
                                                        const fpm::ParticleSet<2>&, const Foot<2>&,
                                                        fpm::Index);
template std::optional<WallStress<3>> WallStress<3>::at(const scene::Scene&, const Model<3>&,
                                                        const std::vector<WallPoint<3>>&,
                                                        const fpm::ParticleSet<3>&, const Foot<3>&,
                                                        fpm::Index);

}  // namespace model
