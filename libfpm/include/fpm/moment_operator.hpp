#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "fpm/consistency.hpp"
#include "fpm/ghosts.hpp"
#include "fpm/rows.hpp"
#include "fpm/stencil.hpp"
#include "fpm/types.hpp"

namespace fpm {

/// The rows of a sparse operator in the layout its kernels want: runs of consecutive rows that
/// share one stencil (lattices), and groups of up to four rows with weights of their own, whose
/// entries stand side by side as the rows do (at faces, after a re-search) or anywhere.
struct SegmentedRows {
  enum class Kind : std::uint8_t {
    shared,   ///< one stencil for all; ids are offsets from the row
    aligned,  ///< four rows; ids are those of the first one, each row's one more than that before
              ///< it
    own       ///< ids of each row
  };
  struct Segment {
    Index first = 0;  ///< first row
    Index count = 0;  ///< rows; at most 4 if not shared
    Index width = 0;  ///< entries per row
    Kind kind = Kind::own;
    std::size_t id_begin = 0;      ///< into ids: width entries, 4 width if own
    std::size_t weight_begin = 0;  ///< into weights: width (shared) or 4 width, of `channels` each
  };
  std::vector<Segment> segments;
  std::vector<Index> block_begin;  ///< first segment of each block of 64 rows, and the end
  std::vector<Index> ids;
  std::vector<double> weights;
  Index row_count = 0;

  std::size_t bytes() const {
    return segments.size() * sizeof(Segment) + block_begin.size() * sizeof(Index) +
           ids.size() * sizeof(Index) + weights.size() * sizeof(double);
  }
};

/// The approximation of all rows as one constant sparse operator per reference configuration.
///
/// Forward, `gather` takes differences u_b - u_a of a nodal field to moments per row: the gradient
/// sum (u_b - u_a) x G_ab and, as far as the channels ask, sum kappa (u_b - u_a),
/// sum (u_b - u_a) x kappa X and the second gradient sum (u_b - u_a) x h_ab.
/// Transposed, `scatter` takes generalised stresses per row to nodal forces, the exact adjoint,
/// as a gather over the transposed rows: the order of every sum is fixed, so results do not depend
/// on the number of threads.
///
/// Rows are processed in blocks of at most `block_rows`; a caller loops over blocks, in parallel if
/// it likes, and does its local work on a block while it is in cache.
template <int Dim>
class MomentOperator {
 public:
  static constexpr Index block_rows = 64;
  static constexpr Index block_stride = block_rows + 8;  ///< leading dimension of block buffers
  static constexpr Index padding = 8;                    ///< readable entries behind a nodal array

  MomentOperator() = default;

  /// Builds the layout from the rows.
  /// @param correction  of the first rows, or none; rows that were re-searched ignore it
  MomentOperator(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts, Channels channels,
                 const ConsistencyCorrection<Dim>& correction = {});

  /// Follows rows that have been re-searched or corrected since, in proportion to their number:
  /// what gather and scatter give is what they give when built anew, to the bit.
  /// @param changed  those rows, ascending
  /// @param correction  as at first
  void update(const Rows<Dim>& rows, const std::vector<Index>& changed,
              const ConsistencyCorrection<Dim>& correction = {});

  Index size() const { return size_; }
  Channels channels() const { return channels_; }
  int channel_count() const { return channels_.count(Dim); }
  const Ghosts<Dim>& ghosts() const { return ghosts_; }

  /// Length between the components of an extended nodal array (particles, ghosts, padding).
  Eigen::Index stride() const { return size_ + ghosts_.size() + padding; }

  /// Number of stress entries per row that `scatter` reads: Dim per gradient and second-gradient
  /// channel; for pairs 1 + Dim + 2 Dim^2 (see PairStress).
  int stress_count() const;

  Index block_count() const { return static_cast<Index>(forward_.block_begin.size()) - 1; }
  Index block_first(Index block) const { return block * block_rows; }
  Index block_size(Index block) const {
    const Index left = size_ - block * block_rows;
    return left < block_rows ? left : block_rows;
  }

  /// Copies a nodal vector field (component-major, n Dim) and its images into an extended array of
  /// `stride() * Dim`; the padding is zeroed.
  void extend(const double* field, double* extended) const;
  /// The same for positions.
  void extend_positions(const double* position, double* extended) const;

  /// Moments of one block: moments[(channel * Dim + i) * block_stride + row in block].
  /// No allocation; safe to call from several threads with buffers of their own.
  void gather(Index block, const double* extended, double* moments) const;

  /// Forces of all nodes from generalised stresses, force += nothing: overwritten.
  ///
  /// Entry e of row a is stress[e * stride() + a]. Entries: P_iJ at J Dim + i (J gradient channel);
  /// with pairs, k, then c_i, then A_ij at i Dim + j, then B_iJ at i Dim + J, meaning the force
  /// kappa_ab (k v_b + c + A x_b) - B (kappa X)_ab on node b; then T_iK at K Dim + i.
  /// The reaction of a pair's force on its own row is the caller's (it knows it from the moments).
  /// @param v  extended nodal field the pair stiffness k acts on (ignored without pairs)
  /// @param x  extended nodal field A acts on (ignored without pairs)
  /// @param[out] force  extended, stride() * Dim; the images' forces are folded onto the particles
  void scatter(const double* stress, const double* v, const double* x, double* force) const;

  /// [m] and [m^0]: sum_b kappa X (Dim) and sum_b kappa X x X (Dim^2) of a row; with pairs only.
  Vector<Dim> first_moment(Index row) const { return first_moment_.row(row).transpose(); }
  Tensor<Dim> second_moment(Index row) const {
    return Eigen::Map<const Tensor<Dim>>(second_moment_.data() + row * Dim * Dim);
  }

  /// The same as arrays over the rows: component i of the first moments, one per row; the second
  /// moments, Dim^2 per row, column-major.
  const double* first_moments(int i) const { return first_moment_.col(i).data(); }
  const double* second_moments() const { return second_moment_.data(); }

  /// Calls visit(neighbour, weights) for every entry of a row: weights points to channel_count()
  /// values. For set-up and output; the hot paths are gather and scatter.
  template <class Visitor>
  void for_each_entry(Index row, Visitor&& visit) const;

  /// Memory held by the layout [bytes].
  std::size_t bytes() const {
    return forward_.bytes() + transposed_.bytes() +
           static_cast<std::size_t>(first_moment_.size() + second_moment_.size()) * sizeof(double);
  }

  /// Share of the rows that use a shared stencil, for reports.
  double shared_share() const;

 private:
  std::vector<char> summed_channels() const;
  void segment_forward(const Rows<Dim>& rows, const ConsistencyCorrection<Dim>& correction);
  void segment_transposed();

  Index size_ = 0;
  Channels channels_;
  Ghosts<Dim> ghosts_;
  SegmentedRows forward_;
  SegmentedRows transposed_;  // rows: particles, then ghosts
  Field<Dim> first_moment_;
  Eigen::VectorXd second_moment_;
};

/// The weights of one row.
struct WeightedRow {
  Index row = 0;
  std::span<const Index> neighbours;
  const double* weights = nullptr;  ///< as many per neighbour as there are channels
};

/// Calls visit(weighted row) for all rows in their order, without the memory of an operator: the
/// entries are those of one set up from the same.
template <int Dim>
void for_each_weighted_row(const Rows<Dim>& rows, const Ghosts<Dim>& ghosts, Channels channels,
                           const ConsistencyCorrection<Dim>& correction,
                           const std::function<void(const WeightedRow&)>& visit);

template <int Dim>
template <class Visitor>
void MomentOperator<Dim>::for_each_entry(Index row, Visitor&& visit) const {
  const auto block = static_cast<std::size_t>(row / block_rows);
  auto s = static_cast<std::size_t>(forward_.block_begin[block]);
  while (forward_.segments[s].first + forward_.segments[s].count <= row) ++s;
  const auto& segment = forward_.segments[s];
  const auto m = static_cast<std::size_t>(channel_count());
  const auto lane = static_cast<std::size_t>(row - segment.first);
  double weights[most_channels<Dim>];
  for (std::size_t k = 0; k < static_cast<std::size_t>(segment.width); ++k) {
    if (segment.kind == SegmentedRows::Kind::shared) {
      visit(row + forward_.ids[segment.id_begin + k],
            &forward_.weights[segment.weight_begin + k * m]);
      continue;
    }
    const Index b = segment.kind == SegmentedRows::Kind::aligned
                        ? forward_.ids[segment.id_begin + k] + static_cast<Index>(lane)
                        : forward_.ids[segment.id_begin + 4 * k + lane];
    if (b == row) continue;  // filler of a shorter row
    for (std::size_t c = 0; c < m; ++c) {
      weights[c] = forward_.weights[segment.weight_begin + (k * m + c) * 4 + lane];
    }
    visit(b, static_cast<const double*>(weights));
  }
}

}  // namespace fpm
