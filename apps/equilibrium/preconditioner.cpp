#include "equilibrium/preconditioner.hpp"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>

#include "equilibrium/local_response.hpp"

namespace equilibrium {
namespace {

constexpr double penalty_factor = 10.0;  // times E, on the grid, for prescribed unknowns

constitutive::ElasticModuli moduli_of(const auto& model, Eigen::Index particle) {
  return constitutive::moduli(model.materials[model.material[static_cast<std::size_t>(particle)]]);
}

// Stiffness of two nodes with gradients g, h in an isotropic body of unit volume.
template <int Dim>
fpm::Tensor<Dim> elastic_block(const constitutive::ElasticModuli& m, const fpm::Vector<Dim>& g,
                               const fpm::Vector<Dim>& h) {
  return m.lame * g * h.transpose() + m.shear * h * g.transpose() +
         m.shear * g.dot(h) * fpm::Tensor<Dim>::Identity();
}

}  // namespace

template <int Dim>
TwoLevelPreconditioner<Dim>::TwoLevelPreconditioner(const model::Model<Dim>& model,
                                                    const fpm::MomentOperator<Dim>& op,
                                                    double coarse_over_spacing)
    : size_(model.size()), prescribed_(model.prescribed) {
  build_blocks(model, op);
  if (coarse_over_spacing > 0.0) build_grid(model, coarse_over_spacing * model.spacing);
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::build_blocks(const model::Model<Dim>& model,
                                               const fpm::MomentOperator<Dim>& op) {
  using Tensor = fpm::Tensor<Dim>;
  using Vector = fpm::Vector<Dim>;
  const bool pair = model.channels.pair;
  const bool second = model.channels.second;
  const int second_channel = Dim + (pair ? 1 + Dim : 0);
  Blocks sum(Dim * Dim, size_);
  sum.setZero();
  const auto add = [&](fpm::Index node, const Tensor& block) {
    if (node >= size_) node = model.ghosts.source(node - static_cast<fpm::Index>(size_));
    Eigen::Map<Tensor>(sum.col(node).data()) += block;
  };
  for (fpm::Index a = 0; a < size_; ++a) {
    const constitutive::ElasticModuli m = moduli_of(model, a);
    const double volume = model.particles.volume[a];
    const double spring =
        pair ? model.pair_control.stiffness_ratio * volume *
                   model.youngs_modulus[model.material[static_cast<std::size_t>(a)]]
             : 0.0;
    Vector own = Vector::Zero();
    Eigen::Vector3d own_second = Eigen::Vector3d::Zero();
    double own_kappa = 0.0;
    const auto subpoint_block = [&](const Eigen::Vector3d& h) {
      Tensor block = Tensor::Zero();
      if constexpr (Dim == 2) {
        for (std::size_t k = 0; k < fpm::subpoint_count; ++k) {
          const Vector xi = fpm::subpoint_offset(k, volume);
          const Vector g{h[0] * xi[0] + h[1] * xi[1], h[1] * xi[0] + h[2] * xi[1]};
          // The in-plane deviator alone works at the sub-points.
          block +=
              fpm::subpoint_weights[k] * m.shear * volume * g.squaredNorm() * Tensor::Identity();
        }
      }
      return block;
    };
    op.for_each_entry(a, [&](fpm::Index b, const double* w) {
      const Vector g = Eigen::Map<const Vector>(w);
      own -= g;
      Tensor block = volume * elastic_block<Dim>(m, g, g);
      if (pair) {
        block += spring * w[Dim] * Tensor::Identity();
        own_kappa += w[Dim];
      }
      if (second) {
        const Eigen::Vector3d h = Eigen::Map<const Eigen::Vector3d>(w + second_channel);
        own_second -= h;
        block += subpoint_block(h);
      }
      add(b, block);
    });
    Tensor block =
        volume * elastic_block<Dim>(m, own, own) + spring * own_kappa * Tensor::Identity();
    if (second) block += subpoint_block(own_second);
    add(a, block);
  }
  add_penalty_blocks(model, sum);
  invert_blocks(sum);
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::add_penalty_blocks(const model::Model<Dim>& model,
                                                     Blocks& sum) const {
  using Vector = fpm::Vector<Dim>;
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    fpm::Field<Dim> values = fpm::Field<Dim>::Zero(size_, Dim);
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      values.setZero();
      support.op.add_transposed_value(c, Vector::Ones(), values);
      const double stiffness = support.options.penalty * support.points.weight[c];
      for (Eigen::Index a = 0; a < size_; ++a) {
        for (int i = 0; i < Dim; ++i) {
          if (!support.options.prescribed[static_cast<std::size_t>(i)]) continue;
          sum(i * Dim + i, a) += stiffness * values(a, i) * values(a, i);
        }
      }
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
void TwoLevelPreconditioner<Dim>::interpolation_of(
    const Eigen::Matrix<double, 1, Dim>& position, Eigen::Matrix<fpm::Index, 1 << Dim, 1>& nodes,
    Eigen::Matrix<double, 1 << Dim, 1>& values,
    Eigen::Matrix<double, Dim, 1 << Dim>& gradients) const {
  Eigen::Matrix<fpm::Index, Dim, 1> at;
  fpm::Vector<Dim> xi;
  for (int i = 0; i < Dim; ++i) {
    const double x = (position[i] - origin_[i]) / cell_[i];
    at[i] = std::clamp(static_cast<fpm::Index>(std::floor(x)), 0, cells_[i] - 1);
    xi[i] = x - at[i];
  }
  for (int corner = 0; corner < (1 << Dim); ++corner) {
    fpm::Index node = 0;
    double value = 1.0;
    fpm::Vector<Dim> gradient = fpm::Vector<Dim>::Ones();
    for (int i = Dim - 1; i >= 0; --i) {
      const bool upper = ((corner >> i) & 1) != 0;
      node = node * (cells_[i] + 1) + at[i] + (upper ? 1 : 0);
      const double shape = upper ? xi[i] : 1.0 - xi[i];
      for (int j = 0; j < Dim; ++j) {
        gradient[j] *= i == j ? (upper ? 1.0 : -1.0) / cell_[i] : shape;
      }
      value *= shape;
    }
    nodes[corner] = node;
    values[corner] = value;
    gradients.col(corner) = gradient;
  }
}

// Mirrors hold the normal displacement of the nodes on them, penalty supports that of their points;
// a stiffness far above the body's would cost the single-precision factor its digits.
template <int Dim>
void TwoLevelPreconditioner<Dim>::add_grid_supports(
    const model::Model<Dim>& model, std::vector<Eigen::Triplet<double>>& entries) const {
  constexpr int corners = 1 << Dim;
  const double most = penalty_factor * model.youngs_modulus.front() *
                      std::pow(model.particles.volume.maxCoeff(), 1.0 - 2.0 / Dim);
  for (const auto& [axis, upper] : model.mirror_faces) {
    for (fpm::Index node = 0; node < nodes_; ++node) {
      fpm::Index rest = node;
      for (int i = 0; i < axis; ++i) rest /= cells_[i] + 1;
      if (rest % (cells_[axis] + 1) != (upper ? cells_[axis] : 0)) continue;
      entries.emplace_back(node * Dim + axis, node * Dim + axis, most);
    }
  }
  Eigen::Matrix<fpm::Index, corners, 1> nodes;
  Eigen::Matrix<double, corners, 1> values;
  Eigen::Matrix<double, Dim, corners> gradients;
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      interpolation_of(support.points.position.row(c), nodes, values, gradients);
      const double stiffness = std::min(most, support.options.penalty * support.points.weight[c]);
      for (int i = 0; i < Dim; ++i) {
        if (!support.options.prescribed[static_cast<std::size_t>(i)]) continue;
        for (int p = 0; p < corners; ++p) {
          for (int q = 0; q < corners; ++q) {
            entries.emplace_back(nodes[p] * Dim + i, nodes[q] * Dim + i,
                                 stiffness * values[p] * values[q]);
          }
        }
      }
    }
  }
}

// Elastic stiffness of the grid by quadrature over the particles, whose interpolation is kept. A
// node meets its 3^Dim neighbours only: their blocks are summed in place, for a list of every
// particle's contributions would be the largest thing in memory.
template <int Dim>
std::vector<Eigen::Triplet<double>> TwoLevelPreconditioner<Dim>::grid_stiffness(
    const model::Model<Dim>& model) {
  constexpr int corners = 1 << Dim;
  constexpr int block_size = Dim * Dim;
  constexpr int slots = Dim == 2 ? 9 : 27;
  using Tensor = fpm::Tensor<Dim>;
  corner_.resize(corners, size_);
  weight_.resize(corners, size_);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(slots * block_size, nodes_);
  Eigen::Matrix<fpm::Index, corners, 1> nodes;
  Eigen::Matrix<double, corners, 1> values;
  Eigen::Matrix<double, Dim, corners> gradients;
  for (Eigen::Index a = 0; a < size_; ++a) {
    interpolation_of(model.particles.position.row(a), nodes, values, gradients);
    corner_.col(a) = nodes;
    weight_.col(a) = values.template cast<float>();
    const constitutive::ElasticModuli m = moduli_of(model, a);
    const double volume = model.particles.volume[a];
    const double penalty = penalty_factor *
                           model.youngs_modulus[model.material[static_cast<std::size_t>(a)]] *
                           std::pow(volume, 1.0 - 2.0 / Dim);
    for (int p = 0; p < corners; ++p) {
      for (int q = 0; q < corners; ++q) {
        Tensor block = volume * elastic_block<Dim>(m, fpm::Vector<Dim>(gradients.col(p)),
                                                   fpm::Vector<Dim>(gradients.col(q)));
        for (int i = 0; i < Dim; ++i) {
          if (prescribed_[static_cast<std::size_t>(i * size_ + a)] != 0) {
            block(i, i) += penalty * values[p] * values[q];
          }
        }
        int slot = 0;
        for (int i = Dim - 1; i >= 0; --i) slot = 3 * slot + 1 + ((q >> i) & 1) - ((p >> i) & 1);
        blocks.col(nodes[p]).template segment<block_size>(slot * block_size) += detail::flat(block);
      }
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(blocks.size()));
  for (fpm::Index node = 0; node < nodes_; ++node) {
    for (int slot = 0; slot < slots; ++slot) {
      const Eigen::Map<const Tensor> block(blocks.col(node).data() + slot * block_size);
      if ((block.array() == 0.0).all()) continue;  // also what lies beyond the grid
      fpm::Index other = node, stride = 1;
      for (int i = 0, rest = slot; i < Dim; ++i, rest /= 3) {
        other += (rest % 3 - 1) * stride;
        stride *= cells_[i] + 1;
      }
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) {
          entries.emplace_back(node * Dim + i, other * Dim + j, block(i, j));
        }
      }
    }
  }
  return entries;
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::build_grid(const model::Model<Dim>& model, double grid_spacing) {
  origin_ = model.box_min;
  const fpm::Vector<Dim> extent = model.box_max - origin_;
  nodes_ = 1;
  for (int i = 0; i < Dim; ++i) {
    cells_[i] = std::max(1, static_cast<fpm::Index>(std::lround(extent[i] / grid_spacing)));
    cell_[i] = extent[i] / cells_[i];
    nodes_ *= cells_[i] + 1;
  }
  std::vector<Eigen::Triplet<double>> entries = grid_stiffness(model);
  add_grid_supports(model, entries);
  Eigen::SparseMatrix<double> stiffness(nodes_ * Dim, nodes_ * Dim);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  // Grid nodes that no particle sees keep a row of their own.
  const double floor = 1e-10 * stiffness.diagonal().maxCoeff();
  for (Eigen::Index k = 0; k < stiffness.rows(); ++k) stiffness.coeffRef(k, k) += floor;
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factorisation(stiffness);
  if (factorisation.info() != Eigen::Success) {
    throw std::runtime_error(
        "the elastic stiffness of the background grid is not positive definite: "
        "is the body supported against every rigid motion?");
  }
  factor_ = factorisation.matrixL().nestedExpression().template cast<float>();
  permutation_ = factorisation.permutationP();
  coarse_.resize(nodes_ * Dim);
  coarse_single_.resize(nodes_ * Dim);
}

template <int Dim>
void TwoLevelPreconditioner<Dim>::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  const Eigen::Index n = size_;
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Map<const fpm::Tensor<Dim>> inverse(block_inverse_.col(a).data());
    fpm::Vector<Dim> local;
    for (int i = 0; i < Dim; ++i) local[i] = r[i * n + a];
    const fpm::Vector<Dim> result = inverse * local;
    for (int i = 0; i < Dim; ++i) z[i * n + a] = result[i];
  }
  if (nodes_ > 0) {
    constexpr int corners = 1 << Dim;
    coarse_.setZero();
    for (Eigen::Index a = 0; a < n; ++a) {
      for (int i = 0; i < Dim; ++i) {
        const double load =
            prescribed_[static_cast<std::size_t>(i * n + a)] != 0 ? 0.0 : r[i * n + a];
        for (int p = 0; p < corners; ++p) {
          coarse_[corner_(p, a) * Dim + i] += static_cast<double>(weight_(p, a)) * load;
        }
      }
    }
    // Scaled, so that the range of single precision is never left whatever the units.
    const double scale = coarse_.cwiseAbs().maxCoeff();
    if (scale > 0.0 && std::isfinite(scale)) {
      coarse_single_.noalias() = permutation_ * (coarse_ / scale).template cast<float>();
      factor_.template triangularView<Eigen::Lower>().solveInPlace(coarse_single_);
      factor_.transpose().template triangularView<Eigen::Upper>().solveInPlace(coarse_single_);
      coarse_ = (permutation_.transpose() * coarse_single_).template cast<double>() * scale;
      for (Eigen::Index a = 0; a < n; ++a) {
        for (int p = 0; p < corners; ++p) {
          const double w = weight_(p, a);
          for (int i = 0; i < Dim; ++i) z[i * n + a] += w * coarse_[corner_(p, a) * Dim + i];
        }
      }
    }
  }
  for (Eigen::Index k = 0; k < z.size(); ++k) {
    if (prescribed_[static_cast<std::size_t>(k)] != 0) z[k] = 0.0;
  }
}

template <int Dim>
std::size_t TwoLevelPreconditioner<Dim>::bytes() const {
  return static_cast<std::size_t>(block_inverse_.size()) * sizeof(double) +
         static_cast<std::size_t>(corner_.size()) * (sizeof(fpm::Index) + sizeof(float)) +
         static_cast<std::size_t>(factor_.nonZeros()) * (sizeof(float) + sizeof(int));
}

template class TwoLevelPreconditioner<2>;
template class TwoLevelPreconditioner<3>;

}  // namespace equilibrium
