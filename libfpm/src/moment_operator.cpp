#include "fpm/moment_operator.hpp"

#include <algorithm>

#include "consistency_system.hpp"
#include "fpm/threads.hpp"
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

// Whose weights are in memory at once while an operator is set up: a multiple of the blocks.
constexpr Index part_rows = 4096;

// Where the moments of pairs are kept; not read without pairs.
template <int Dim>
struct Moments {
  Field<Dim>& first;
  Eigen::VectorXd& second;
};

// What a row's weights are made of, and where they go.
template <int Dim>
struct Weighing {
  const Rows<Dim>& rows;
  const Ghosts<Dim>& ghosts;
  Channels channels;
  const ConsistencyCorrection<Dim>& correction;
  detail::WeightedRows& weighted;
  Moments<Dim> moments;
};

template <int Dim>
void set_weights(const Weighing<Dim>& to, Index a, const RowGeometry<Dim>& geometry,
                 RowWeights<Dim>& weights) {
  compute_weights(geometry, to.rows.options().kernel, to.channels.second, weights);
  if (const auto carried = to.rows.correction(a); !carried.empty()) {
    weights.gradient += Eigen::Map<const Eigen::Matrix<double, Dim, Eigen::Dynamic>>(
        carried.data(), Dim, geometry.size());
  } else if (to.correction.corrects(a) && !to.rows.searched(a)) {
    add_consistency(to.ghosts, to.correction.potential, a, to.rows.neighbours(a), geometry,
                    weights);
  }
}

template <int Dim>
void store_row(const Weighing<Dim>& to, Index a, const RowGeometry<Dim>& geometry,
               const RowWeights<Dim>& weights) {
  const auto begin = to.weighted.begin(a);
  std::ranges::copy(to.rows.neighbours(a),
                    to.weighted.id.begin() + static_cast<std::ptrdiff_t>(begin));
  if (to.channels.pair) {
    to.moments.first.row(a).setZero();
    to.moments.second.template segment<Dim * Dim>(a * Dim * Dim).setZero();
  }
  double* at = to.weighted.weight.data() + begin * static_cast<std::size_t>(to.weighted.channels);
  const auto append = [&](const auto& column) {
    at = std::copy_n(column.data(), column.size(), at);
  };
  for (Eigen::Index k = 0; k < geometry.size(); ++k) {
    append(Vector<Dim>(weights.gradient.col(k)));
    if (to.channels.pair) {
      const Vector<Dim> kappa_x = weights.kappa[k] * geometry.offset.col(k);
      *at++ = weights.kappa[k];
      append(kappa_x);
      to.moments.first.row(a) += kappa_x.transpose();
      Eigen::Map<Tensor<Dim>>(to.moments.second.data() + a * Dim * Dim) +=
          kappa_x * geometry.offset.col(k).transpose();
    }
    if (to.channels.second) {
      append(Eigen::Matrix<double, second_gradient_size<Dim>, 1>(weights.second.col(k)));
    }
  }
}

// Of the wanted rows in [first, last). Rows do not see each other: each on some thread.
template <int Dim, class Predicate>
detail::WeightedRows weigh(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts, Channels channels,
                           const ConsistencyCorrection<Dim>& correction, Index first, Index last,
                           const Predicate& is_wanted, Moments<Dim> moments) {
  detail::WeightedRows weighted;
  weighted.channels = channels.count(Dim);
  weighted.first = first;
  weighted.offset.reserve(static_cast<std::size_t>(last - first) + 1);
  for (Index a = first; a < last; ++a) {
    weighted.offset.push_back(weighted.offset.back() +
                              (is_wanted(a) ? rows.neighbours(a).size() : 0));
  }
  weighted.id.resize(weighted.offset.back());
  weighted.weight.resize(weighted.offset.back() * static_cast<std::size_t>(weighted.channels));
  const Weighing<Dim> to{rows, ghosts, channels, correction, weighted, moments};
  constexpr Index per_block = 32;
  for_each_block((last - first + per_block - 1) / per_block, [&](Index block) {
    RowGeometry<Dim> geometry;
    RowWeights<Dim> weights;
    const Index begin = first + block * per_block;
    for (Index a = begin; a < std::min(begin + per_block, last); ++a) {
      if (!is_wanted(a)) continue;
      rows.geometry(a, geometry);
      set_weights(to, a, geometry, weights);
      store_row(to, a, geometry, weights);
    }
  });
  return weighted;
}

template <int Dim>
void require_fit(const ConsistencyCorrection<Dim>& correction, Index rows) {
  const Field<Dim>& potential = correction.potential;
  if (potential.size() == 0) return;
  require_size("consistency potential", potential.rows(), rows);
  require_size("corrected rows", static_cast<Eigen::Index>(correction.corrected.size()), rows);
}

// The blocks of the rows that are set, which are then set as a whole.
std::vector<char> whole_blocks(std::vector<char>& rows, Index block_rows) {
  const auto width = static_cast<std::size_t>(block_rows);
  std::vector<char> blocks((rows.size() + width - 1) / width, 0);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    if (rows[a] != 0) blocks[a / width] = 1;
  }
  for (std::size_t a = 0; a < rows.size(); ++a) rows[a] = blocks[a / width];
  return blocks;
}

}  // namespace

template <int Dim>
MomentOperator<Dim>::MomentOperator(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts,
                                    Channels channels, const ConsistencyCorrection<Dim>& correction)
    : size_(rows.size()), channels_(channels), ghosts_(ghosts) {
  require_fit(correction, size_);
  if (channels.pair) {
    first_moment_.resize(size_, Dim);
    second_moment_.resize(static_cast<Eigen::Index>(size_) * Dim * Dim);
  }
  segment_forward(rows, correction);
  segment_transposed();
}

template <int Dim>
void MomentOperator<Dim>::segment_forward(const Rows<Dim>& rows,
                                          const ConsistencyCorrection<Dim>& correction) {
  const auto all = [](Index /*row*/) { return true; };
  detail::Segmenter segmenter(channel_count(), block_rows, size_ + ghosts_.size());
  for (Index first = 0; first < size_; first += part_rows) {
    segmenter.append(weigh<Dim>(rows, ghosts_, channels_, correction, first,
                                std::min(first + part_rows, size_), all,
                                {first_moment_, second_moment_}));
  }
  forward_ = segmenter.finish();
}

template <int Dim>
void MomentOperator<Dim>::segment_transposed() {
  const Index nodes = size_ + ghosts_.size();
  // The rows that are in a part of the nodes or have an entry there.
  std::vector<std::vector<Index>> sources(
      static_cast<std::size_t>((nodes + part_rows - 1) / part_rows));
  for (Index a = 0; a < size_; ++a) {
    const auto touch = [&](Index b) {
      std::vector<Index>& of_part = sources[static_cast<std::size_t>(b / part_rows)];
      if (of_part.empty() || of_part.back() != a) of_part.push_back(a);
    };
    touch(a);
    for_each_entry(a, [&](Index b, const double*) { touch(b); });
  }
  const auto all = [](Index /*node*/) { return true; };
  detail::Segmenter segmenter(channel_count(), block_rows, size_);
  for (std::size_t part = 0; part < sources.size(); ++part) {
    const Index first = static_cast<Index>(part) * part_rows;
    const detail::Columns columns{first, std::min(first + part_rows, nodes), all};
    segmenter.append(
        detail::transpose_part(sources[part], columns, channel_count(), summed_channels(),
                               [&](Index a, const auto& visit) { for_each_entry(a, visit); }));
  }
  transposed_ = segmenter.finish();
}

// A gradient acts on differences, so its row has a self entry; the caller handles that of pairs.
template <int Dim>
std::vector<char> MomentOperator<Dim>::summed_channels() const {
  std::vector<char> in_sum(static_cast<std::size_t>(channel_count()), 1);
  if (channels_.pair) std::fill_n(in_sum.begin() + Channels::kappa(Dim), 1 + Dim, char{0});
  return in_sum;
}

template <int Dim>
void MomentOperator<Dim>::update(const Rows<Dim>& rows, const std::vector<Index>& changed,
                                 const ConsistencyCorrection<Dim>& correction) {
  require_size("rows", rows.size(), size_);
  const Index nodes = size_ + ghosts_.size();
  // Whose transposed rows change: those that are or were their neighbours.
  std::vector<char> touched(static_cast<std::size_t>(nodes), 0);
  const auto touch = [&](Index b) { touched[static_cast<std::size_t>(b)] = 1; };
  std::vector<char> wanted(static_cast<std::size_t>(size_), 0);
  for (const Index a : changed) {
    wanted[static_cast<std::size_t>(a)] = 1;
    touch(a);
    for_each_entry(a, [&](Index b, const double*) { touch(b); });
    std::ranges::for_each(rows.neighbours(a), touch);
  }
  const std::vector<char> forward_blocks = whole_blocks(wanted, block_rows);
  const std::vector<char> transposed_blocks = whole_blocks(touched, block_rows);
  // Whose rows have entries in theirs.
  std::vector<char> is_source = wanted;
  for (std::size_t block = 0; block < transposed_blocks.size(); ++block) {
    if (transposed_blocks[block] == 0) continue;
    detail::for_each_id(transposed_, block,
                        [&](Index a) { is_source[static_cast<std::size_t>(a)] = 1; });
  }
  std::vector<Index> sources;
  for (Index a = 0; a < size_; ++a) {
    const bool own = touched[static_cast<std::size_t>(a)] != 0;
    if (own || is_source[static_cast<std::size_t>(a)] != 0) sources.push_back(a);
  }

  const auto is_wanted = [&](Index a) { return wanted[static_cast<std::size_t>(a)] != 0; };
  detail::WeightedRows weighted = weigh<Dim>(rows, ghosts_, channels_, correction, 0, size_,
                                             is_wanted, {first_moment_, second_moment_});
  forward_ = detail::segment_anew(forward_, weighted, forward_blocks, block_rows, nodes);
  const auto is_touched = [&](Index b) { return touched[static_cast<std::size_t>(b)] != 0; };
  weighted = detail::transpose_part(sources, detail::Columns{0, nodes, is_touched}, channel_count(),
                                    summed_channels(),
                                    [&](Index a, const auto& visit) { for_each_entry(a, visit); });
  transposed_ = detail::segment_anew(transposed_, weighted, transposed_blocks, block_rows, size_);
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
  for_each_block(blocks, [&](Index block) {
    const auto b = static_cast<std::size_t>(block);
    const detail::KernelRows rows{segments + transposed_.block_begin[b],
                                  segments + transposed_.block_begin[b + 1], transposed_.ids.data(),
                                  transposed_.weights.data()};
    kernel(rows, stress, v, x, stride(), force);
  });
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

template <int Dim>
void for_each_weighted_row(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts, Channels channels,
                           const ConsistencyCorrection<Dim>& correction,
                           const std::function<void(const WeightedRow&)>& visit) {
  const Index n = rows.size();
  require_fit(correction, n);
  Field<Dim> first(channels.pair ? n : 0, Dim);
  Eigen::VectorXd second(channels.pair ? static_cast<Eigen::Index>(n) * Dim * Dim : 0);
  const auto all = [](Index /*row*/) { return true; };
  for (Index begin = 0; begin < n; begin += part_rows) {
    const detail::WeightedRows part =
        weigh<Dim>(rows, ghosts, channels, correction, begin, std::min(begin + part_rows, n), all,
                   {first, second});
    for (Index a = part.first; a < part.last(); ++a) {
      visit({a, part.ids(a), part.weights(a).data()});
    }
  }
}

template void for_each_weighted_row<2>(const Rows<2>&, const Ghosts<2>&, Channels,
                                       const ConsistencyCorrection<2>&,
                                       const std::function<void(const WeightedRow&)>&);
template void for_each_weighted_row<3>(const Rows<3>&, const Ghosts<3>&, Channels,
                                       const ConsistencyCorrection<3>&,
                                       const std::function<void(const WeightedRow&)>&);

template class MomentOperator<2>;
template class MomentOperator<3>;

}  // namespace fpm
