#include "constitutive/spectral.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

namespace constitutive {

Spectrum spectrum(const StressVector<2>& v) {
  const double half_difference = (v[0] - v[1]) / 2;
  const double centre = (v[0] + v[1]) / 2;
  const double radius = std::hypot(half_difference, v[3]);
  const double angle = std::atan2(v[3], half_difference) / 2;
  const double c = std::cos(angle), s = std::sin(angle);
  const Eigen::Vector3d major(c, s, 0), minor(-s, c, 0), normal(0, 0, 1);
  Spectrum out;
  if (v[2] > centre + radius) {
    out.values << v[2], centre + radius, centre - radius;
    out.directions << normal, major, minor;
  } else if (v[2] < centre - radius) {
    out.values << centre + radius, centre - radius, v[2];
    out.directions << major, minor, normal;
  } else {
    out.values << centre + radius, v[2], centre - radius;
    out.directions << major, normal, minor;
  }
  return out;
}

Spectrum spectrum(const StressVector<3>& v) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(to_matrix(v));
  return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

template <int Dim>
StressVector<Dim> recompose(const Eigen::Vector3d& values, const Eigen::Matrix3d& directions) {
  return from_matrix<Dim>(directions * values.asDiagonal() * directions.transpose());
}

template <int Dim>
TangentMatrix<Dim> isotropic_function_derivative(const Spectrum& x, const Eigen::Vector3d& y,
                                                 const Eigen::Matrix3d& jacobian) {
  constexpr double equal_gap = 0x1p-26;
  const double scale = x.values.cwiseAbs().maxCoeff();
  std::array<StressVector<Dim>, 3> projector;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d n = x.directions.col(i);
    projector[static_cast<std::size_t>(i)] = from_matrix<Dim>(n * n.transpose());
  }
  TangentMatrix<Dim> t = TangentMatrix<Dim>::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      t += jacobian(i, j) * projector[static_cast<std::size_t>(i)] *
           with_engineering_shear(projector[static_cast<std::size_t>(j)]).transpose();
    }
    const int next = (i + 1) % 3;
    const double gap = x.values[i] - x.values[next];
    const double theta =
        std::abs(gap) > equal_gap * scale
            ? (y[i] - y[next]) / gap
            : (jacobian(i, i) - jacobian(i, next) - jacobian(next, i) + jacobian(next, next)) / 2;
    const Eigen::Vector3d n = x.directions.col(i), m = x.directions.col(next);
    const StressVector<Dim> shear = from_matrix<Dim>((n * m.transpose() + m * n.transpose()) / 2);
    t += 2 * theta * shear * with_engineering_shear(shear).transpose();
  }
  return t;
}

template StressVector<2> recompose<2>(const Eigen::Vector3d&, const Eigen::Matrix3d&);
template StressVector<3> recompose<3>(const Eigen::Vector3d&, const Eigen::Matrix3d&);
template TangentMatrix<2> isotropic_function_derivative<2>(const Spectrum&, const Eigen::Vector3d&,
                                                           const Eigen::Matrix3d&);
template TangentMatrix<3> isotropic_function_derivative<3>(const Spectrum&, const Eigen::Vector3d&,
                                                           const Eigen::Matrix3d&);

}  // namespace constitutive
