#include "equilibrium/two_level_preconditioner.hpp"

#include <Eigen/LU>

#include "equilibrium/elastic_block.hpp"
#include "equilibrium/given_unknowns.hpp"
#include "fpm/subpoints.hpp"
#include "fpm/threads.hpp"

namespace equilibrium {

template <int Dim>
TwoLevelPreconditioner<Dim>::TwoLevelPreconditioner(const model::Model<Dim>& model,
                                                    const fpm::Rows<Dim>& initial_rows,
                                                    double coarse_over_spacing)
    : size_(model.size()), prescribed_(model.prescribed), given_(given_unknowns(model.prescribed)) {
  build_blocks(model, initial_rows);
  if (!model.interfaces.empty()) springs_ = InterfaceSprings<Dim>(model, block_inverse_);
  if (coarse_over_spacing > 0.0) {
    grid_ = BackgroundGrid<Dim>(model, coarse_over_spacing);
  }
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::build_blocks(const model::Model<Dim>& model,
                                               const fpm::Rows<Dim>& initial_rows) {
  using Tensor = fpm::Tensor<Dim>;
  using Vector = fpm::Vector<Dim>;
  using Second = Eigen::Matrix<double, fpm::second_gradient_size<Dim>, 1>;
  const bool pair = model.channels.pair;
  const bool second = model.channels.second;
  Blocks sum(Dim * Dim, size_);
  sum.setZero();
  const auto add = [&](fpm::Index node, const Tensor& block) {
    if (node >= size_) node = model.ghosts.source(node - static_cast<fpm::Index>(size_));
    Eigen::Map<Tensor>(sum.col(node).data()) += block;
  };
  const auto add_row = [&](const fpm::WeightedRow& row) {
    const fpm::Index a = row.row;
    const constitutive::ElasticModuli m = moduli_of(model, a);
    const double volume = model.particles.volume[a];
    const double spring =
        pair ? model.pair_control.stiffness_ratio * volume * model.youngs_modulus_of(a) : 0.0;
    Vector own = Vector::Zero();
    Second own_second = Second::Zero();
    double own_kappa = 0.0;
    const auto subpoint_block = [&](const Second& h) {
      Tensor block = Tensor::Zero();
      for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
        const Vector xi = fpm::subpoint_offset<Dim>(k, volume);
        const Vector g = fpm::second_weight_at<Dim>(h, xi);
        // The deviator alone works at the sub-points, in the plane that of the plane.
        block += fpm::subpoint_weights[k] * m.shear * volume *
                 (g.squaredNorm() * Tensor::Identity() + (1.0 - 2.0 / Dim) * g * g.transpose());
      }
      return block;
    };
    const double* w = row.weights;
    for (const fpm::Index b : row.neighbours) {
      const Vector g = Eigen::Map<const Vector>(w);
      own -= g;
      Tensor block = volume * elastic_block<Dim>(m, g, g);
      if (pair) {
        block += spring * w[fpm::Channels::kappa(Dim)] * Tensor::Identity();
        own_kappa += w[fpm::Channels::kappa(Dim)];
      }
      if (second) {
        const Second h = Eigen::Map<const Second>(w + model.channels.second_gradient(Dim));
        own_second -= h;
        block += subpoint_block(h);
      }
      add(b, block);
      w += model.channels.count(Dim);
    }
    Tensor block =
        volume * elastic_block<Dim>(m, own, own) + spring * own_kappa * Tensor::Identity();
    if (second) block += subpoint_block(own_second);
    add(a, block);
  };
  fpm::for_each_weighted_row<Dim>(initial_rows, model.ghosts, model.channels, {}, add_row);
  add_penalty_blocks(model, sum);
  invert_blocks(sum);
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::add_penalty_blocks(const model::Model<Dim>& model,
                                                     Blocks& sum) const {
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      const double stiffness = support.options.penalty * support.points.weight[c];
      support.op.for_each_value(c, [&](fpm::Index a, double value, const auto& /*sign*/) {
        for (int i = 0; i < Dim; ++i) {
          if (!support.options.prescribed[static_cast<std::size_t>(i)]) continue;
          sum(i * Dim + i, a) += stiffness * value * value;
        }
      });
    }
  }
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::invert_blocks(const Blocks& sum) {
  using Tensor = fpm::Tensor<Dim>;
  block_inverse_.resize(Dim * Dim, size_);
  for (Eigen::Index a = 0; a < size_; ++a) {
    Tensor block = Eigen::Map<const Tensor>(sum.col(a).data());
    for (int i = 0; i < Dim; ++i) {
      if (prescribed_[static_cast<std::size_t>(i * size_ + a)] == 0) continue;
      block.row(i).setZero();
      block.col(i).setZero();
      block(i, i) = 1.0;
    }
    Eigen::Map<Tensor>(block_inverse_.col(a).data()) = block.inverse();
  }
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::apply_block(Eigen::Index a, const Eigen::VectorXd& r,
                                              Eigen::VectorXd& z) const {
  const Eigen::Index n = size_;
  const Eigen::Map<const fpm::Tensor<Dim>> inverse(block_inverse_.col(a).data());
  fpm::Vector<Dim> local;
  for (int i = 0; i < Dim; ++i) local[i] = r[i * n + a];
  const fpm::Vector<Dim> result = inverse * local;
  for (int i = 0; i < Dim; ++i) z[i * n + a] = result[i];
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  const bool with_grid = !grid_.empty();
  const bool with_springs = !springs_.empty();
  if (with_grid) grid_.solve(r);
  constexpr Eigen::Index per_block = 128;
  fpm::for_each_row(size_, per_block, [&](Eigen::Index a) {
    apply_block(a, r, z);
    if (with_grid && !with_springs) grid_.add_solution(a, z);
  });
  if (with_springs) {
    springs_.correct(z);
    for (Eigen::Index a = 0; with_grid && a < size_; ++a) grid_.add_solution(a, z);
  }
  for (const Eigen::Index k : given_) z[k] = 0.0;
}

template <int Dim>
std::size_t TwoLevelPreconditioner<Dim>::bytes() const {
  return static_cast<std::size_t>(block_inverse_.size()) * sizeof(double) + prescribed_.size() +
         given_.size() * sizeof(Eigen::Index) + springs_.bytes() + grid_.bytes();
}

template class TwoLevelPreconditioner<2>;
template class TwoLevelPreconditioner<3>;

}  // namespace equilibrium
