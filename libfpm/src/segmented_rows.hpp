#pragma once

#include <span>
#include <vector>

#include "fpm/moment_operator.hpp"

namespace fpm::detail {

/// A sparse operator with several weights per entry, row by row.
struct WeightedRows {
  int channels = 0;
  std::vector<std::size_t> offset{0};
  std::vector<Index> id;
  std::vector<double> weight;  // `channels` per entry

  Index size() const { return static_cast<Index>(offset.size()) - 1; }
  std::size_t width(Index row) const {
    return offset[static_cast<std::size_t>(row) + 1] - offset[static_cast<std::size_t>(row)];
  }
  std::span<const Index> ids(Index row) const {
    return {id.data() + offset[static_cast<std::size_t>(row)], width(row)};
  }
  std::span<const double> weights(Index row) const {
    const auto m = static_cast<std::size_t>(channels);
    return {weight.data() + offset[static_cast<std::size_t>(row)] * m, width(row) * m};
  }
};

/// The transposed operator. Its row b < rows.size() starts from its own entry: minus the
/// sum of its weights in the channels where `in_sum` is set, zero in the others.
WeightedRows transpose(const WeightedRows& rows, Index transposed_size,
                       const std::vector<char>& in_sum);

/// Lays rows out for the kernels, in blocks of `block_rows`; equal stencils are stored once. Rows
/// of one group are filled up to the widest with entries of no weight, which refer to the row
/// itself or, as a transposed row may be none, to the last of the `sources` that an entry may refer
/// to: what they read must exist, since zero times garbage may be NaN.
SegmentedRows segment(const WeightedRows& rows, Index block_rows, Index sources);

}  // namespace fpm::detail
