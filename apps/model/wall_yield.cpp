#include "model/wall_yield.hpp"

#include <algorithm>

#include "constitutive/utilisation.hpp"

namespace model {
namespace {

// By how much stress along the wall differs from what presses across it. In plane strain what acts
// across the plane is in between where the ground flows.
template <int Dim>
Eigen::Matrix3d difference_along(const Eigen::Matrix3d& stress, const Eigen::Vector3d& normal) {
  const Eigen::Matrix3d unit = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d along = unit - normal * normal.transpose();
  Eigen::Matrix3d differs = along * (stress - normal.dot(stress * normal) * unit) * along;
  if constexpr (Dim == 2) {
    const double in_plane = differs(0, 0) + differs(1, 1);
    differs(2, 2) = std::clamp(differs(2, 2), std::min(0.0, in_plane), std::max(0.0, in_plane));
  }
  return differs;
}

}  // namespace

template <int Dim>
std::optional<constitutive::StressVector<Dim>> yielding_on_wall(
    const constitutive::Material& law, const constitutive::PointState<Dim>& point,
    const fpm::Vector<Dim>& normal, const fpm::Vector<Dim>& bears) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero(), t = Eigen::Vector3d::Zero();
  n.head<Dim>() = normal;
  t.head<Dim>() = bears;
  const double pressing = n.dot(t);
  const Eigen::Matrix3d differs = difference_along<Dim>(constitutive::to_matrix(point.stress), n);
  // With the shear on the wall, and nothing along it.
  const Eigen::Vector3d shear = t - pressing * n;
  const Eigen::Matrix3d borne =
      pressing * Eigen::Matrix3d::Identity() + n * shear.transpose() + shear * n.transpose();
  const auto with = [&](double share) {
    return constitutive::from_matrix<Dim>(borne + share * differs);
  };
  const auto used = [&](double share) {
    return constitutive::utilisation<Dim>(law, with(share), point.plastic_volume_strain,
                                          point.plastic_strain);
  };
  constexpr double most = 4.0;  // beyond, the difference is noise
  double low = 0.0, high = 1.0;
  if (!(used(low) < 1.0)) return std::nullopt;
  while (used(high) < 1.0) {
    low = high;
    high *= 2.0;
    if (high > most) return std::nullopt;
  }
  constexpr double rounding = 1e-12;
  while (high - low > rounding * high) {
    const double middle = 0.5 * (low + high);
    (used(middle) < 1.0 ? low : high) = middle;
  }
  return with(low);
}

template std::optional<constitutive::StressVector<2>> yielding_on_wall<2>(
    const constitutive::Material&, const constitutive::PointState<2>&, const fpm::Vector<2>&,
    const fpm::Vector<2>&);
template std::optional<constitutive::StressVector<3>> yielding_on_wall<3>(
    const constitutive::Material&, const constitutive::PointState<3>&, const fpm::Vector<3>&,
    const fpm::Vector<3>&);

}  // namespace model
