#include "fpm/viscosity.hpp"

#include "fpm/threads.hpp"

namespace fpm {
namespace {

constexpr Index per_block = 128;  // rows that a thread takes at once

}  // namespace

std::vector<std::string> validate(const ViscosityOptions& options) {
  if (options.theta >= 0.0) return {};
  return {"the viscosity number theta must not be negative"};
}

template <int Dim>
Eigen::VectorXd smoothing_lengths(const Rows<Dim>& rows) {
  const double ratio = support_over_smoothing_length(rows.options().kernel);
  Eigen::VectorXd length(rows.size());
  RowGeometry<Dim> row;
  for (Index a = 0; a < rows.size(); ++a) {
    rows.geometry(a, row);
    length[a] = row.support_radius / ratio;
  }
  return length;
}

template <int Dim>
PairViscosity<Dim>::PairViscosity(const MomentOperator<Dim>& op, const Eigen::VectorXd& modulus,
                                  const Eigen::VectorXd& smoothing_length)
    : ghosts_(op.ghosts()), size_(op.size()) {
  require_size("moduli", modulus.size(), size_);
  require_size("smoothing lengths", smoothing_length.size(), size_);
  const Index nodes = size_ + ghosts_.size();
  modulus_.resize(nodes);
  smoothing_length_.resize(nodes);
  for (Index b = 0; b < nodes; ++b) {
    const Index particle = b < size_ ? b : ghosts_.source(b - size_);
    modulus_[b] = modulus[particle];
    smoothing_length_[b] = smoothing_length[particle];
  }

  node_begin_.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (Index a = 0; a < size_; ++a) {
    op.for_each_entry(a, [&](Index b, const double* weights) {
      neighbour_.push_back(b);
      gradient_.push_back(Eigen::Map<const Vector<Dim>>(weights));
      ++node_begin_[static_cast<std::size_t>(b) + 1];
    });
    row_begin_.push_back(neighbour_.size());
  }
  for (std::size_t b = 1; b < node_begin_.size(); ++b) node_begin_[b] += node_begin_[b - 1];
  node_pair_.resize(neighbour_.size());
  std::vector<std::size_t> fill(node_begin_.begin(), node_begin_.end() - 1);
  for (std::size_t k = 0; k < neighbour_.size(); ++k) {
    node_pair_[fill[static_cast<std::size_t>(neighbour_[k])]++] = k;
  }

  midpoint_.resize(nodes, Dim);
  field_.resize(nodes, Dim);
  pair_force_.resize(neighbour_.size());
  node_force_.resize(nodes, Dim);
}

template <int Dim>
void PairViscosity<Dim>::set_midpoint(const FieldView<Dim>& position,
                                      const FieldView<Dim>& increment) {
  require_size("positions", position.rows(), size_);
  require_size("increments", increment.rows(), size_);
  midpoint_.topRows(size_) = position + 0.5 * increment;
  ghosts_.extend_positions(midpoint_.data(), size_, midpoint_.rows());
}

template <int Dim>
void PairViscosity<Dim>::set_field(const FieldView<Dim>& field) {
  require_size("field", field.rows(), size_);
  field_.topRows(size_) = field;
  ghosts_.extend_vectors(field_.data(), size_, field_.rows());
}

template <int Dim>
void PairViscosity<Dim>::compute_pairs(double theta, const FieldView<Dim * Dim>& inverse_transposed,
                                       const Eigen::Ref<const Eigen::VectorXd>& volume) {
  const bool deformed = inverse_transposed.rows() > 0;
  if (deformed) require_size("inverse gradients", inverse_transposed.rows(), size_);
  require_size("volumes", volume.size(), size_);
  for_each_row(size_, per_block, [&](Index a) {
    Tensor<Dim> push = volume[a] * Tensor<Dim>::Identity();
    if (deformed) {
      for (int k = 0; k < Dim * Dim; ++k) push(k % Dim, k / Dim) = inverse_transposed(a, k);
      push *= volume[a];
    }
    const auto row = static_cast<std::size_t>(a);
    for (std::size_t k = row_begin_[row]; k < row_begin_[row + 1]; ++k) {
      const Index b = neighbour_[k];
      const Vector<Dim> x = (midpoint_.row(a) - midpoint_.row(b)).transpose();
      const double approach = x.dot((field_.row(a) - field_.row(b)).transpose());
      const double core = 0.05 * (smoothing_length_[a] + smoothing_length_[b]);
      const double modulus = 0.5 * (modulus_[a] + modulus_[b]);
      const double pi = theta * modulus * approach / (x.squaredNorm() + core * core);
      pair_force_[k] = pi * (push * gradient_[k]);
    }
  });
}

template <int Dim>
void PairViscosity<Dim>::sum_pairs(FieldTarget<Dim> force) {
  const auto nodes = static_cast<Index>(node_force_.rows());
  for_each_row(nodes, per_block, [&](Index b) {
    const auto node = static_cast<std::size_t>(b);
    Vector<Dim> sum = Vector<Dim>::Zero();
    for (std::size_t k = node_begin_[node]; k < node_begin_[node + 1]; ++k) {
      sum += pair_force_[node_pair_[k]];
    }
    if (b < size_) {
      for (std::size_t k = row_begin_[node]; k < row_begin_[node + 1]; ++k) sum -= pair_force_[k];
    }
    node_force_.row(b) = sum.transpose();
  });
  ghosts_.fold_forces(node_force_.data(), size_, node_force_.rows());
  force += node_force_.topRows(size_);
}

template <int Dim>
void PairViscosity<Dim>::add_force(double theta, const FieldView<Dim>& position,
                                   const FieldView<Dim>& increment,
                                   const FieldView<Dim * Dim>& inverse_transposed,
                                   const Eigen::Ref<const Eigen::VectorXd>& volume,
                                   FieldTarget<Dim> force) {
  add_action(theta, position, increment, increment, inverse_transposed, volume, force);
}

template <int Dim>
void PairViscosity<Dim>::add_action(double theta, const FieldView<Dim>& position,
                                    const FieldView<Dim>& increment,
                                    const FieldView<Dim>& direction,
                                    const FieldView<Dim * Dim>& inverse_transposed,
                                    const Eigen::Ref<const Eigen::VectorXd>& volume,
                                    FieldTarget<Dim> force) {
  require_size("force", force.rows(), size_);
  set_midpoint(position, increment);
  set_field(direction);
  compute_pairs(theta, inverse_transposed, volume);
  sum_pairs(force);
}

template <int Dim>
std::size_t PairViscosity<Dim>::bytes() const {
  const auto doubles = modulus_.size() + smoothing_length_.size() + midpoint_.size() +
                       field_.size() + node_force_.size();
  return static_cast<std::size_t>(doubles) * sizeof(double) +
         (row_begin_.size() + node_begin_.size() + node_pair_.size()) * sizeof(std::size_t) +
         neighbour_.size() * sizeof(Index) +
         (gradient_.size() + pair_force_.size()) * sizeof(Vector<Dim>);
}

template Eigen::VectorXd smoothing_lengths<2>(const Rows<2>&);
template Eigen::VectorXd smoothing_lengths<3>(const Rows<3>&);
template class PairViscosity<2>;
template class PairViscosity<3>;

}  // namespace fpm
