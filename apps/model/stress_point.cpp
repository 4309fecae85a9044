#include "model/stress_point.hpp"

#include <algorithm>
#include <cmath>

#include "model/selection.hpp"
#include "scene/derived.hpp"
#include "scene/element_body.hpp"
#include "scene/ground.hpp"
#include "scene/scene.hpp"

namespace model {
namespace {

// Stress may jump where the material changes, within one body as well.
template <int Dim>
fpm::ParticleSet<Dim> by_material(const Model<Dim>& model) {
  fpm::ParticleSet<Dim> particles = model.particles;
  particles.body.resize(model.material.size(), 0);
  const auto bodies = *std::ranges::max_element(particles.body) + 1;
  for (std::size_t a = 0; a < particles.body.size(); ++a) {
    particles.body[a] += bodies * static_cast<fpm::Index>(model.material[a]);
  }
  return particles;
}

// Those of the point's body that its rows lead to in two steps. What lies as near beyond a slot is
// made another body's.
template <int Dim>
fpm::ParticleSet<Dim> within_reach(fpm::ParticleSet<Dim> particles,
                                   const fpm::PointOperator<Dim>& point, fpm::Index own) {
  std::vector<fpm::Index> near;
  point.for_each_value(
      0, [&](fpm::Index a, double /*weight*/, const auto& /*sign*/) { near.push_back(a); });
  const fpm::Index body = particles.body[static_cast<std::size_t>(own)];
  const fpm::Index beyond = *std::ranges::max_element(particles.body) + 1;
  const double step = point.support_radius(0);
  for (fpm::Index a = 0; a < particles.size(); ++a) {
    auto& of = particles.body[static_cast<std::size_t>(a)];
    const auto leads_here = [&](fpm::Index b) {
      return (particles.position.row(a) - particles.position.row(b)).norm() <= step;
    };
    if (of == body && std::ranges::none_of(near, leads_here)) of = beyond;
  }
  return particles;
}

// The material of a stress at a point is that of the region the point is in, which may be another
// one than the nearest particle's. On a joint, chords of an arc included, it is the latter.
template <int Dim>
Eigen::Index particle_of_stress(const scene::Scene& scene, const shape::Outline& outline,
                                const std::vector<double>& at, const Model<Dim>& model) {
  constexpr double on_joint = 0.01;  // of the spacing
  const Eigen::Index nearest = nearest_particle(scene, at, model);
  const double spacing = model.spacing_at(nearest);
  const auto here = scene::materials_of_regions_at(scene, outline, at, on_joint * spacing);
  const auto is_here = [&](Eigen::Index a) {
    const auto material = model.material[static_cast<std::size_t>(a)];
    return std::ranges::count(here, static_cast<std::size_t>(material)) > 0;
  };
  if (here.empty() || is_here(nearest)) return nearest;
  const Eigen::Map<const Eigen::Matrix<double, 1, Dim>> place(at.data());
  Eigen::Index best = nearest;
  double least = 2.0 * spacing;  // further off it has been dug away, or given to its neighbours
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double distance = (model.particles.position.row(a) - place).norm();
    if (distance >= least || !is_here(a)) continue;
    least = distance;
    best = a;
  }
  return best;
}

}  // namespace

// Linear in the particles of the nearest one's material; an image behind a mirror has the stress of
// its particle seen there.
template <int Dim>
constitutive::StressVector<Dim> InterpolatedStress<Dim>::of(const State<Dim>& state) const {
  constitutive::StressVector<Dim> sum = constitutive::StressVector<Dim>::Zero();
  point.for_each_value(0, [&](fpm::Index a, double weight, const auto& sign) {
    sum += weight * behind_mirror<Dim>(state.stress.col(a), sign);
  });
  if (mean) {
    const Eigen::VectorXd means = state.stress.template topRows<3>().colwise().mean().transpose();
    sum.template head<3>().array() += mean->scalar_value(0, means) - sum.template head<3>().mean();
  }
  return sum;
}

// Away from a wall the particles' error falls to a half in half a spacing, and so does what mends
// it.
template <int Dim>
constitutive::StressVector<Dim> StressPoint<Dim>::of(const State<Dim>& state) const {
  if (!around) return state.stress.col(particle);
  const constitutive::StressVector<Dim> here = around->of(state);
  if (!wall) return here;
  const constitutive::StressVector<Dim> foot = wall->foot.of(state);
  return here + wall->share * (wall->fit.of(state, foot) - foot);
}

template <int Dim>
StressPoints<Dim>::StressPoints(const scene::Scene& scene, const Model<Dim>& model)
    : scene_(scene),
      model_(model),
      particles_(by_material(model)),
      walls_(wall_points(scene, model)) {
  if (!scene.region.empty() && !scene::is_solid(scene)) outline_ = scene::outline_of(scene);
}

template <int Dim>
InterpolatedStress<Dim> StressPoints<Dim>::around(const fpm::Vector<Dim>& place,
                                                  fpm::Index own) const {
  const fpm::Field<Dim> point = place.transpose();
  const std::vector<fpm::Index> owner{own};
  InterpolatedStress<Dim> result;
  result.point =
      fpm::PointOperator<Dim>(particles_, model_.ghosts, point, model_.row_options, owner);
  const auto material = static_cast<std::size_t>(model_.material[static_cast<std::size_t>(own)]);
  if (!scene::is_nearly_incompressible(scene_.material[material])) return result;
  fpm::RowOptions wide = model_.row_options;
  wide.support_radius *= 2.0;  // as of recovered_mean_stress
  try {
    result.mean = fpm::PointOperator<Dim>(within_reach(particles_, result.point, own),
                                          model_.ghosts, point, wide, owner);
  } catch (const fpm::PoorNeighbourhood&) {
    // The mean is that of the point's own rows, then.
  }
  return result;
}

template <int Dim>
StressPoint<Dim> StressPoints<Dim>::at(const std::vector<double>& asked) const {
  StressPoint<Dim> result;
  const Eigen::Index nearest = outline_ ? particle_of_stress(scene_, *outline_, asked, model_)
                                        : nearest_particle(scene_, asked, model_);
  const auto own = static_cast<fpm::Index>(nearest);
  result.particle = own;
  try {
    const fpm::Vector<Dim> place = Eigen::Map<const fpm::Vector<Dim>>(asked.data());
    InterpolatedStress<Dim> here = around(place, own);
    const double reach = model_.spacing_at(result.particle);
    if (const auto foot = foot_on_wall(walls_, place, reach)) {
      InterpolatedStress<Dim> on_wall = around(foot->place, own);
      auto fit = WallStress<Dim>::at(scene_, model_, walls_,
                                     within_reach(particles_, on_wall.point, own), *foot, own);
      if (fit) result.wall = {std::move(on_wall), std::move(*fit), 1.0 - foot->distance / reach};
    }
    result.around = std::move(here);
  } catch (const fpm::PoorNeighbourhood&) {
    // Too few for a gradient.
  }
  return result;
}

template struct InterpolatedStress<2>;
template struct InterpolatedStress<3>;
template struct StressPoint<2>;
template struct StressPoint<3>;
template class StressPoints<2>;
template class StressPoints<3>;

}  // namespace model
