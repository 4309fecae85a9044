#include "fpm/stencil.hpp"

#include <Eigen/LU>

namespace fpm {
namespace {

template <class Matrix>
double condition_one_norm(const Matrix& m, const Matrix& inverse) {
  return m.cwiseAbs().colwise().sum().maxCoeff() * inverse.cwiseAbs().colwise().sum().maxCoeff();
}

// All lengths are scaled by R and all volumes by V_a, so that the condition numbers mean something.
template <int Dim>
void compute_first_order(const RowGeometry<Dim>& row, Kernel kernel, RowWeights<Dim>& weights) {
  using MomentMatrix = Eigen::Matrix<double, Dim + 1, Dim + 1>;
  using Basis = Eigen::Matrix<double, Dim + 1, 1>;
  const double radius = row.support_radius;
  const Eigen::Index count = row.size();
  Eigen::Matrix<double, Dim + 1, Eigen::Dynamic> q(Dim + 1, count);

  MomentMatrix moment = MomentMatrix::Zero();
  moment(0, 0) = 1.0;  // the row itself: W(0) = 1, X = 0, W_,j = 0
  double spread = 0.0;
  for (Eigen::Index b = 0; b < count; ++b) {
    const Vector<Dim> x = row.offset.col(b) / radius;
    const double r = x.norm();
    const KernelValue w = evaluate(kernel, r * radius, radius);
    Basis basis;
    basis << 1.0, x;
    q(0, b) = w.value;
    q.col(b).template tail<Dim>() = (-w.derivative * radius / r) * x;
    moment += (row.volume[b] / row.own_volume) * q.col(b) * basis.transpose();
    weights.kappa[b] = row.volume[b] * w.value;
    spread += weights.kappa[b] * row.offset.col(b).squaredNorm();
  }
  weights.kappa /= spread;

  const MomentMatrix inverse = moment.inverse();
  weights.condition = condition_one_norm(moment, inverse);
  weights.own_value = inverse(0, 0);
  for (Eigen::Index b = 0; b < count; ++b) {
    const Basis h = inverse * q.col(b) * (row.volume[b] / row.own_volume);
    weights.value[b] = h[0];
    weights.gradient.col(b) = h.template tail<Dim>() / radius;
  }
}

template <int Dim>
void compute_second_order(const RowGeometry<Dim>& row, RowWeights<Dim>& weights) {
  constexpr int terms = Dim + second_gradient_size<Dim>;
  using Basis = Eigen::Matrix<double, terms, 1>;
  using FitMatrix = Eigen::Matrix<double, terms, terms>;
  const double radius = row.support_radius;
  const auto taylor = [](const Vector<Dim>& x) {
    Basis p;
    p.template head<Dim>() = x;
    int k = Dim;
    for (int i = 0; i < Dim; ++i) {
      p[k++] = 0.5 * x[i] * x[i];
      for (int j = i + 1; j < Dim; ++j) p[k++] = x[i] * x[j];
    }
    return p;
  };

  // kappa is W V up to a factor, which cancels here.
  const double scale = radius * radius;
  FitMatrix fit = FitMatrix::Zero();
  for (Eigen::Index b = 0; b < row.size(); ++b) {
    const Basis p = taylor(row.offset.col(b) / radius);
    fit += (scale * weights.kappa[b]) * p * p.transpose();
  }
  const FitMatrix inverse = fit.inverse();
  weights.second_condition = condition_one_norm(fit, inverse);
  for (Eigen::Index b = 0; b < row.size(); ++b) {
    const Basis p = taylor(row.offset.col(b) / radius);
    const Basis z = inverse * p * (scale * weights.kappa[b]);
    weights.second.col(b) = z.template tail<second_gradient_size<Dim>>() / (radius * radius);
  }
}

}  // namespace

template <int Dim>
void compute_weights(const RowGeometry<Dim>& row, Kernel kernel, bool second,
                     RowWeights<Dim>& weights) {
  const Eigen::Index count = row.size();
  require_size("row volumes", row.volume.size(), count);
  weights.value.resize(count);
  weights.gradient.resize(Dim, count);
  weights.kappa.resize(count);
  weights.second.resize(second_gradient_size<Dim>, second ? count : 0);
  weights.second_condition = 0.0;
  compute_first_order(row, kernel, weights);
  if (second) compute_second_order(row, weights);
}

template void compute_weights<2>(const RowGeometry<2>&, Kernel, bool, RowWeights<2>&);
template void compute_weights<3>(const RowGeometry<3>&, Kernel, bool, RowWeights<3>&);

}  // namespace fpm
