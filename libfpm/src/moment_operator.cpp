#include "fpm/moment_operator.hpp"

#include <algorithm>

#include "consistency_system.hpp"
#include "operator_kernels.hpp"
#include "segmented_rows.hpp"

namespace fpm {
namespace {

// Adds V_a kappa_ab (T_a nu)_ab to the gradient weights; consistency.hpp says what nu is.
template <int Dim>
void add_consistency(const Ghosts<Dim>& ghosts, const Field<Dim>& potential, Index row,
                     std::span<const Index> neighbours, const RowGeometry<Dim>& geometry,
                     RowWeights<Dim>& weights) {
  const Index n = static_cast<Index>(potential.rows());
  const Eigen::Index count = geometry.size();
  Eigen::Matrix<double, Dim, Eigen::Dynamic> difference(Dim, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Index b = neighbours[static_cast<std::size_t>(k)];
    Vector<Dim> other =
        b < n ? Vector<Dim>(potential.row(b).transpose()) : ghosts.image(potential, b - n);
    difference.col(k) = other - potential.row(row).transpose();
  }
  weights.gradient +=
      geometry.own_volume * detail::weighted_remainder(geometry, weights, difference);
}

// Where the moments of pairs are kept; not read without pairs.
template <int Dim>
struct Moments {
  Field<Dim>& first;
  Eigen::VectorXd& second;
};

// Rows do not see each other: each on some thread.
template <int Dim>
detail::WeightedRows weigh(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts, Channels channels,
                           const ConsistencyCorrection<Dim>& correction, Moments<Dim> moments) {
  const Index size = rows.size();
  detail::WeightedRows weighted;
  weighted.channels = channels.count(Dim);
  weighted.offset.reserve(static_cast<std::size_t>(size) + 1);
  for (Index a = 0; a < size; ++a) {
    weighted.offset.push_back(weighted.offset.back() + rows.neighbours(a).size());
  }
  weighted.id.resize(weighted.offset.back());
  weighted.weight.resize(weighted.offset.back() * static_cast<std::size_t>(weighted.channels));
#pragma omp parallel
  {
    RowGeometry<Dim> geometry;
    RowWeights<Dim> weights;
#pragma omp for schedule(static)
    for (Index a = 0; a < size; ++a) {
      const auto neighbours = rows.neighbours(a);
      rows.geometry(a, geometry);
      compute_weights(geometry, rows.options().kernel, channels.second, weights);
      if (const auto carried = rows.correction(a); !carried.empty()) {
        weights.gradient += Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(
            carried.data(), Dim, geometry.size());
      } else if (correction.corrects(a) && !rows.searched(a)) {
        add_consistency(ghosts, correction.potential, a, neighbours, geometry, weights);
      }
      const auto begin = weighted.offset[static_cast<std::size_t>(a)];
      std::ranges::copy(neighbours, weighted.id.begin() + static_cast<std::ptrdiff_t>(begin));
      double* at = weighted.weight.data() + begin * static_cast<std::size_t>(weighted.channels);
      const auto append = [&](const auto& column) {
        at = std::copy_n(column.data(), column.size(), at);
      };
      for (Eigen::Index k = 0; k < geometry.size(); ++k) {
        append(Vector<Dim>(weights.gradient.col(k)));
        if (channels.pair) {
          const Vector<Dim> kappa_x = weights.kappa[k] * geometry.offset.col(k);
          *at++ = weights.kappa[k];
          append(kappa_x);
          moments.first.row(a) += kappa_x.transpose();
          Eigen::Map<Tensor<Dim>>(moments.second.data() + a * Dim * Dim) +=
              kappa_x * geometry.offset.col(k).transpose();
        }
        if (channels.second) {
          append(Eigen::Matrix<double, second_gradient_size<Dim>, 1>(weights.second.col(k)));
        }
      }
    }
  }
  return weighted;
}

}  // namespace

template <int Dim>
MomentOperator<Dim>::MomentOperator(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                    Channels channels, const ConsistencyCorrection<Dim>& correction)
    : size_(rows.size()), channels_(channels), ghosts_(ghosts) {
  const Field<Dim>& potential = correction.potential;
  if (potential.size() > 0) {
    require_size("consistency potential", potential.rows(), size_);
    require_size("corrected rows", static_cast<Eigen::Index>(correction.corrected.size()), size_);
  }
  if (channels.pair) {
    first_moment_.setZero(size_, Dim);
    second_moment_.setZero(static_cast<Eigen::Index>(size_) * Dim * Dim);
  }
  detail::WeightedRows weighted =
      weigh<Dim>(rows, ghosts_, channels_, correction, {first_moment_, second_moment_});
  // A gradient acts on differences, so its row has a self entry; the caller handles that of pairs.
  std::vector<char> in_sum(static_cast<std::size_t>(channel_count()), 1);
  if (channels.pair) std::fill_n(in_sum.begin() + Channels::kappa(Dim), 1 + Dim, char{0});
  const Index nodes = size_ + ghosts_.size();
  forward_ = detail::segment(weighted, block_rows, nodes);
  weighted = detail::transpose(weighted, nodes, in_sum);
  transposed_ = detail::segment(weighted, block_rows, size_);
}

template <int Dim>
int MomentOperator<Dim>::stress_count() const {
  return Dim * Dim + (channels_.pair ? 1 + Dim + 2 * Dim * Dim : 0) +
         (channels_.second ? second_gradient_size<Dim> * Dim : 0);
}

template <int Dim>
void MomentOperator<Dim>::extend(const double* field, double* extended) const {
  for (int i = 0; i < Dim; ++i) {
    std::copy_n(field + static_cast<Eigen::Index>(i) * size_, size_, extended + i * stride());
    std::fill_n(extended + i * stride() + size_ + ghosts_.size(), padding, 0.0);
  }
  ghosts_.extend_vectors(extended, size_, stride());
}

template <int Dim>
void MomentOperator<Dim>::extend_positions(const double* position, double* extended) const {
  extend(position, extended);
  ghosts_.extend_positions(extended, size_, stride());
}

template <int Dim>
void MomentOperator<Dim>::gather(Index block, const double* extended, double* moments) const {
  const auto b = static_cast<std::size_t>(block);
  const auto* segments = forward_.segments.data();
  const detail::KernelRows rows{segments + forward_.block_begin[b],
                                segments + forward_.block_begin[b + 1], forward_.ids.data(),
                                forward_.weights.data()};
  detail::kernels<Dim>(channels_).gather(rows, extended, stride(), block_first(block), moments,
                                         block_stride);
}

template <int Dim>
void MomentOperator<Dim>::scatter(const double* stress, const double* v, const double* x,
                                  double* force) const {
  const auto kernel = detail::kernels<Dim>(channels_).scatter;
  const auto* segments = transposed_.segments.data();
  const auto blocks = static_cast<Index>(transposed_.block_begin.size()) - 1;
#pragma omp parallel for schedule(static)
  for (Index block = 0; block < blocks; ++block) {
    const auto b = static_cast<std::size_t>(block);
    const detail::KernelRows rows{segments + transposed_.block_begin[b],
                                  segments + transposed_.block_begin[b + 1], transposed_.ids.data(),
                                  transposed_.weights.data()};
    kernel(rows, stress, v, x, stride(), force);
  }
  ghosts_.fold_forces(force, size_, stride());
}

template <int Dim>
double MomentOperator<Dim>::shared_share() const {
  double shared = 0.0;
  for (const auto& segment : forward_.segments) {
    if (segment.kind == SegmentedRows::Kind::shared) shared += segment.count;
  }
  return size_ == 0 ? 0.0 : shared / size_;
}

template class MomentOperator<2>;
template class MomentOperator<3>;

}  // namespace fpm
