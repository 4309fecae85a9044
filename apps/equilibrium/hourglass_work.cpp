#include "equilibrium/hourglass_work.hpp"

#include "constitutive/objective.hpp"
#include "fpm/threads.hpp"

namespace equilibrium {
namespace {

template <int Dim>
fpm::Tensor<Dim> rotation_of_step(const model::State<Dim>& state, fpm::Index a,
                                  const fpm::Tensor<Dim>& increment) {
  using Tensor = fpm::Tensor<Dim>;
  if (!state.layout.finite) return Tensor::Identity();
  const Eigen::Map<const Tensor> start(state.deformation_gradient.col(a).data());
  return constitutive::objective_increment<Dim>(increment, Tensor(start + 0.5 * increment))
      .rotation;
}

}  // namespace

template <int Dim>
double hourglass_work(const LoopData<Dim>& data) {
  const fpm::MomentOperator<Dim>& op = data.op;
  const model::State<Dim>& state = data.state;
  if (!op.channels().pair) return 0.0;
  using Tensor = fpm::Tensor<Dim>;
  using Vector = fpm::Vector<Dim>;
  const Eigen::Index stride = op.stride();
  const Eigen::VectorXd& increment = data.evaluation.extended;
  const auto difference = [&](const Eigen::VectorXd& field, fpm::Index a, fpm::Index b) {
    Vector d;
    for (int i = 0; i < Dim; ++i) d[i] = field[i * stride + b] - field[i * stride + a];
    return d;
  };
  // Added up in the order of the rows, whatever the threads.
  Eigen::VectorXd work_of(op.size());
  constexpr fpm::Index per_block = 32;
  fpm::for_each_row(op.size(), per_block, [&](fpm::Index a) {
    Tensor gradient = Tensor::Zero();
    op.for_each_entry(a, [&](fpm::Index b, const double* w) {
      gradient += difference(increment, a, b) * Eigen::Map<const Eigen::Matrix<double, 1, Dim>>(w);
    });
    Tensor defect = Tensor::Identity();
    if (state.layout.incremental && state.released[a] > 0.0) {
      defect -= rotation_of_step(state, a, gradient);
    }
    const Eigen::Map<const Tensor> begin(data.step.pair_gradient.col(a).data());
    double row = 0.0;
    op.for_each_entry(a, [&](fpm::Index b, const double* w) {
      const double kappa = w[fpm::Channels::kappa(Dim)];
      if (kappa <= 0.0) return;
      const Vector x = Eigen::Map<const Vector>(w + fpm::Channels::kappa_x(Dim)) / kappa;
      const Vector change = difference(increment, a, b) - gradient * x;
      const Vector memory = difference(data.step.position, a, b) - begin * x;
      row += kappa * (change + defect * memory).dot(change);
    });
    work_of[a] = data.step.pair_stiffness[a] * row;
  });
  double work = 0.0;
  for (const double each : work_of) work += each;
  return work;
}

template double hourglass_work<2>(const LoopData<2>&);
template double hourglass_work<3>(const LoopData<3>&);

}  // namespace equilibrium
