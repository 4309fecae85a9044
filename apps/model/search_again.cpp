#include "model/search_again.hpp"

#include <Eigen/LU>

#include "fpm/carried_consistency.hpp"
#include "fpm/consistency.hpp"
#include "fpm/moment_operator.hpp"

namespace model {
namespace {

template <int Dim>
double determinant_of(const Eigen::Matrix<double, Dim * Dim, Eigen::Dynamic>& gradient,
                      Eigen::Index a) {
  return Eigen::Map<const fpm::Tensor<Dim>>(gradient.col(a).data()).determinant();
}

template <int Dim>
std::vector<fpm::Vector<Dim>> motion_of_planes(const Model<Dim>& model, double load) {
  std::vector<fpm::Vector<Dim>> motion = model.plane_drive;
  for (fpm::Vector<Dim>& of_plane : motion) of_plane *= load;
  for (std::size_t p = 0; p < model.plane_held.size(); ++p) motion[p] += model.plane_held[p];
  return motion;
}

// Displacements of particles and images, component by component.
template <int Dim>
Eigen::VectorXd extended_displacement(const Model<Dim>& model, const State<Dim>& state,
                                      const fpm::MomentOperator<Dim>& op,
                                      const std::vector<fpm::Vector<Dim>>& motion) {
  Eigen::VectorXd extended(op.stride() * Dim);
  op.extend(state.displacement.data(), extended.data());
  if (motion.empty()) return extended;
  const fpm::Field<Dim> of_images = model.ghosts.of_motion(motion);
  for (int i = 0; i < Dim; ++i) {
    extended.segment(i * op.stride() + model.size(), of_images.rows()) += of_images.col(i);
  }
  return extended;
}

// F of a row, by its first neighbourhood.
template <int Dim>
fpm::Tensor<Dim> gradient_since_start(const fpm::MomentOperator<Dim>& op,
                                      const Eigen::VectorXd& displacement, fpm::Index row) {
  const auto at = [&](fpm::Index node) {
    fpm::Vector<Dim> u;
    for (int i = 0; i < Dim; ++i) u[i] = displacement[i * op.stride() + node];
    return u;
  };
  const fpm::Vector<Dim> own = at(row);
  fpm::Tensor<Dim> gradient = fpm::Tensor<Dim>::Identity();
  op.for_each_entry(row, [&](fpm::Index b, const double* weights) {
    gradient += (at(b) - own) * Eigen::Map<const fpm::Vector<Dim>>(weights).transpose();
  });
  return gradient;
}

}  // namespace

template <int Dim>
void search_again(const State<Dim>& former, const std::vector<fpm::Index>& source,
                  const Model<Dim>& after, double load, State<Dim>& carried) {
  std::vector<fpm::Index> searched;
  Eigen::VectorXd volume = after.particles.volume;
  for (std::size_t k = 0; k < source.size(); ++k) {
    const fpm::Index b = source[k];
    if (b < 0 || !carried.layout.finite) continue;
    volume[static_cast<Eigen::Index>(k)] =
        former.rows.reference_volume()[b] * determinant_of<Dim>(former.deformation_gradient, b);
    if (former.rows.searched(b)) searched.push_back(static_cast<fpm::Index>(k));
  }
  if (searched.empty()) return;
  fpm::ConsistencyCorrection<Dim> correction;
  if (after.consistency) {
    correction = fpm::consistency_correction(carried.rows, after.ghosts, after.area_vector);
  }
  const fpm::MomentOperator<Dim> initial(carried.rows, after.ghosts, after.channels, correction);
  const auto motion = motion_of_planes(after, load);
  const Eigen::VectorXd displacement = extended_displacement(after, carried, initial, motion);
  for (const fpm::Index a : searched) {
    Eigen::Map<fpm::Tensor<Dim>>(carried.deformation_gradient.col(a).data()) =
        gradient_since_start(initial, displacement, a);
    carried.searched_volume_ratio[a] = 1.0;
  }
  const fpm::Field<Dim> position = after.particles.position + carried.displacement;
  const auto rebuilt =
      carried.rows.research(searched, position, volume, after.driven_particle, motion);
  if (after.consistency) {
    (void)fpm::carry_consistency<Dim>(initial, after.ghosts, rebuilt,
                                      {volume, carried.deformation_gradient}, carried.rows);
  }
  for (const fpm::Index a : rebuilt) {
    carried.searched_volume_ratio[a] = volume[a] / after.particles.volume[a];
    Eigen::Map<fpm::Tensor<Dim>>(carried.deformation_gradient.col(a).data()).setIdentity();
  }
}

template void search_again<2>(const State<2>&, const std::vector<fpm::Index>&, const Model<2>&,
                              double, State<2>&);
template void search_again<3>(const State<3>&, const std::vector<fpm::Index>&, const Model<3>&,
                              double, State<3>&);

}  // namespace model
