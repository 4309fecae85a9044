#include "equilibrium/background_grid.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "equilibrium/elastic_block.hpp"
#include "equilibrium/local_response.hpp"

namespace equilibrium {
namespace {

constexpr double penalty_factor = 10.0;  // times E, on the grid, for prescribed unknowns

}  // namespace

template <int Dim>
BackgroundGrid<Dim>::BackgroundGrid(const model::Model<Dim>& model, double grid_spacing)
    : prescribed_(model.prescribed) {
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
void BackgroundGrid<Dim>::interpolation_of(const Eigen::Matrix<double, 1, Dim>& position,
                                           Eigen::Matrix<fpm::Index, 1 << Dim, 1>& nodes,
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

template <int Dim>
bool BackgroundGrid<Dim>::is_on(const fpm::GhostPlane<Dim>& plane, fpm::Index node) const {
  for (int i = 0; i < Dim; ++i) {
    const double x = origin_[i] + cell_[i] * (node % (cells_[i] + 1));
    node /= cells_[i] + 1;
    const bool on = i == plane.axis ? std::abs(x - plane.position) < 0.5 * cell_[i]
                                    : x >= plane.range_min[i] && x <= plane.range_max[i];
    if (!on) return false;
  }
  return true;
}

// The stiffest of the materials that each node's particles are of.
template <int Dim>
Eigen::VectorXd BackgroundGrid<Dim>::node_moduli(const model::Model<Dim>& model) const {
  Eigen::VectorXd modulus = Eigen::VectorXd::Zero(nodes_);
  for (Eigen::Index a = 0; a < model.size(); ++a) {
    const double own = model.youngs_modulus[model.material[static_cast<std::size_t>(a)]];
    for (const fpm::Index node : corner_.col(a)) modulus[node] = std::max(modulus[node], own);
  }
  return modulus;
}

// Planes of images hold the nodes on them, penalty supports those of their points;
// a stiffness far above the body's would cost the single-precision factor its digits.
template <int Dim>
void BackgroundGrid<Dim>::add_grid_supports(const model::Model<Dim>& model,
                                            std::vector<Eigen::Triplet<double>>& entries) const {
  constexpr int corners = 1 << Dim;
  const Eigen::VectorXd most = penalty_factor *
                               std::pow(model.particles.volume.maxCoeff(), 1.0 - 2.0 / Dim) *
                               node_moduli(model);
  for (const fpm::GhostPlane<Dim>& plane : model.ghosts.planes()) {
    for (fpm::Index node = 0; node < nodes_; ++node) {
      if (!is_on(plane, node)) continue;
      for (int i = 0; i < Dim; ++i) {
        if (plane.held[static_cast<std::size_t>(i)]) {
          entries.emplace_back(node * Dim + i, node * Dim + i, most[node]);
        }
      }
    }
  }
  Eigen::Matrix<fpm::Index, corners, 1> nodes;
  Eigen::Matrix<double, corners, 1> values;
  Eigen::Matrix<double, Dim, corners> gradients;
  // `holds(i)`: whether the spring acts along axis i.
  const auto add_spring = [&](const Eigen::Matrix<double, 1, Dim>& place, double stiffness,
                              auto&& holds) {
    interpolation_of(place, nodes, values, gradients);
    for (const fpm::Index node : nodes) stiffness = std::min(stiffness, most[node]);
    for (int i = 0; i < Dim; ++i) {
      if (!holds(i)) continue;
      for (int p = 0; p < corners; ++p) {
        for (int q = 0; q < corners; ++q) {
          entries.emplace_back(nodes[p] * Dim + i, nodes[q] * Dim + i,
                               stiffness * values[p] * values[q]);
        }
      }
    }
  };
  for (const model::Interface<Dim>& interface : model.interfaces) {
    if (!interface.is_rigid()) continue;  // two bodies are one on the grid
    const auto& points = interface.faces.points;
    const bool sticks = constitutive::sticks(interface.law);
    for (fpm::Index c = 0; c < points.size(); ++c) {
      add_spring(points.position.row(c), interface.stiffness[c] * points.weight[c], [&](int i) {
        const bool gives = interface.plate && interface.plate->free[static_cast<std::size_t>(i)];
        return !gives && (sticks || points.normal(c, i) != 0.0);
      });
    }
  }
  for (const model::PenaltySupport<Dim>& support : model.penalty_supports) {
    for (fpm::Index c = 0; c < support.points.size(); ++c) {
      add_spring(support.points.position.row(c), support.options.penalty * support.points.weight[c],
                 [&](int i) { return support.options.prescribed[static_cast<std::size_t>(i)]; });
    }
  }
}

// Elastic stiffness of the grid by quadrature over the particles, whose interpolation is kept. A
// node meets its 3^Dim neighbours only: their blocks are summed in place, for a list of every
// particle's contributions would be the largest thing in memory.
template <int Dim>
std::vector<Eigen::Triplet<double>> BackgroundGrid<Dim>::grid_stiffness(
    const model::Model<Dim>& model) {
  constexpr int corners = 1 << Dim;
  constexpr int block_size = Dim * Dim;
  constexpr int slots = Dim == 2 ? 9 : 27;
  using Tensor = fpm::Tensor<Dim>;
  const Eigen::Index n = model.size();
  corner_.resize(corners, n);
  weight_.resize(corners, n);
  Eigen::MatrixXd blocks = Eigen::MatrixXd::Zero(slots * block_size, nodes_);
  Eigen::Matrix<fpm::Index, corners, 1> nodes;
  Eigen::Matrix<double, corners, 1> values;
  Eigen::Matrix<double, Dim, corners> gradients;
  for (Eigen::Index a = 0; a < n; ++a) {
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
          if (prescribed_[static_cast<std::size_t>(i * n + a)] != 0) {
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
void BackgroundGrid<Dim>::add_solution(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  const Eigen::Index n = corner_.cols();
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
  if (!(scale > 0.0) || !std::isfinite(scale)) return;
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

template <int Dim>
std::size_t BackgroundGrid<Dim>::bytes() const {
  const auto bytes_of = [](const auto& m) {
    return static_cast<std::size_t>(m.size()) * sizeof(*m.data());
  };
  return bytes_of(corner_) + bytes_of(weight_) + bytes_of(coarse_) + bytes_of(coarse_single_) +
         bytes_of(permutation_.indices()) + prescribed_.size() +
         static_cast<std::size_t>(factor_.nonZeros()) * (sizeof(float) + sizeof(int)) +
         static_cast<std::size_t>(factor_.outerSize()) * sizeof(int);
}

template class BackgroundGrid<2>;
template class BackgroundGrid<3>;

}  // namespace equilibrium
