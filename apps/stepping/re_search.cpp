#include "stepping/re_search.hpp"

#include <Eigen/LU>
#include <utility>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "fpm/carried_consistency.hpp"
#include "scene/scene.hpp"

namespace stepping {

// Rows that have strained plastically since their last search get new neighbours; stress and
// history stay with the particle, and the next step absorbs the small loss of equilibrium.
// Departure: with hysteresis, and without a separate return to equilibrium
// (share/doc/decisions/re-search.md).
template <int Dim>
Eigen::Index re_search(const scene::Scene& scene, const model::Model<Dim>& model,
                       model::State<Dim>& state, equilibrium::Equilibrium<Dim>& equilibrium) {
  if (!scene.re_search.enabled || !state.layout.finite || !state.layout.plastic) return 0;
  const Eigen::VectorXd gained = state.plastic_strain - state.plastic_strain_at_search;
  if (!(gained.maxCoeff() > scene.re_search.trigger)) return 0;
  const double threshold = scene.re_search.trigger * scene.re_search.hysteresis;
  std::vector<fpm::Index> rows;
  for (fpm::Index a = 0; a < gained.size(); ++a) {
    if (gained[a] > threshold) rows.push_back(a);
  }
  const Eigen::Index n = model.size();
  Eigen::VectorXd ratio(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    ratio[a] =
        Eigen::Map<const fpm::Tensor<Dim>>(state.deformation_gradient.col(a).data()).determinant();
  }
  const Eigen::VectorXd volume = state.rows.reference_volume().cwiseProduct(ratio);
  const fpm::Field<Dim> position = model.particles.position + state.displacement;
  std::vector<fpm::Vector<Dim>> plane_motion = model.plane_drive;
  for (fpm::Vector<Dim>& motion : plane_motion) motion *= state.programme.load;
  for (std::size_t p = 0; p < model.plane_held.size(); ++p) plane_motion[p] += model.plane_held[p];
  const auto rebuilt =
      state.rows.research(rows, position, volume, model.driven_particle, plane_motion);
  std::vector<fpm::Index> changed = rebuilt;
  if (model.consistency) {
    changed = fpm::carry_consistency<Dim>(equilibrium.moment_operator(), model.ghosts, rebuilt,
                                          {volume, state.deformation_gradient}, state.rows)
                  .rows;
  }
  for (const fpm::Index a : rebuilt) {
    state.searched_volume_ratio[a] *= ratio[a];
    Eigen::Map<fpm::Tensor<Dim>>(state.deformation_gradient.col(a).data()).setIdentity();
  }
  // A row that could not be rebuilt waits for as much strain again.
  for (const fpm::Index a : rows) {
    state.plastic_strain_at_search[a] = state.plastic_strain[a];
  }
  if (!rebuilt.empty()) equilibrium.follow_re_search(changed);
  ++state.programme.re_searches;
  return static_cast<Eigen::Index>(rebuilt.size());
}

template Eigen::Index re_search(const scene::Scene&, const model::Model<2>&, model::State<2>&,
                                equilibrium::Equilibrium<2>&);
template Eigen::Index re_search(const scene::Scene&, const model::Model<3>&, model::State<3>&,
                                equilibrium::Equilibrium<3>&);

}  // namespace stepping
