#pragma once

#include <algorithm>
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

/// Calls visit(id) for all that a block's entries refer to, some more than once.
template <class Visitor>
void for_each_id(const SegmentedRows& rows, std::size_t block, const Visitor& visit) {
  for (Index s = rows.block_begin[block]; s < rows.block_begin[block + 1]; ++s) {
    const SegmentedRows::Segment& segment = rows.segments[static_cast<std::size_t>(s)];
    const auto width = static_cast<std::size_t>(segment.width);
    const Index* const id = rows.ids.data() + segment.id_begin;
    if (segment.kind == SegmentedRows::Kind::own) {
      std::for_each_n(id, 4 * width, visit);
      continue;
    }
    const Index base = segment.kind == SegmentedRows::Kind::shared ? segment.first : 0;
    for (std::size_t k = 0; k < width; ++k) {
      for (Index row = 0; row < segment.count; ++row) visit(base + id[k] + row);
    }
  }
}

/// What `transpose` has for the columns where `wanted` is set, and nothing for the others.
/// @param sources  the rows that may have an entry in these columns, ascending, `wanted` ones among
///   them
/// @param for_each_entry  called as for_each_entry(row, visit) with visit(column, weights)
template <class ForEachEntry>
WeightedRows transpose_part(const std::vector<Index>& sources, const std::vector<char>& wanted,
                            int channels, const std::vector<char>& in_sum,
                            const ForEachEntry& for_each_entry);

/// Lays rows out for the kernels, in blocks of `block_rows`; equal stencils are stored once. Rows
/// of one group are filled up to the widest with entries of no weight, which refer to the row
/// itself or, as a transposed row may be none, to the last of the `sources` that an entry may refer
/// to: what they read must exist, since zero times garbage may be NaN.
SegmentedRows segment(const WeightedRows& rows, Index block_rows, Index sources);

/// The same where only the blocks with `changed` set have rows in `rows`; the others stay as they
/// are in `before`.
SegmentedRows segment_anew(const SegmentedRows& before, const WeightedRows& rows,
                           const std::vector<char>& changed, Index block_rows, Index sources);

template <class ForEachEntry>
WeightedRows transpose_part(const std::vector<Index>& sources, const std::vector<char>& wanted,
                            int channels, const std::vector<char>& in_sum,
                            const ForEachEntry& for_each_entry) {
  const auto m = static_cast<std::size_t>(channels);
  const auto is_wanted = [&](Index b) { return wanted[static_cast<std::size_t>(b)] != 0; };
  WeightedRows out;
  out.channels = channels;
  std::vector<std::size_t> count(wanted.size(), 0);
  for (const Index a : sources) {
    if (is_wanted(a)) ++count[static_cast<std::size_t>(a)];
    for_each_entry(a, [&](Index b, const double*) {
      if (is_wanted(b)) ++count[static_cast<std::size_t>(b)];
    });
  }
  out.offset.resize(count.size() + 1);
  for (std::size_t b = 0; b < count.size(); ++b) out.offset[b + 1] = out.offset[b] + count[b];
  out.id.resize(out.offset.back());
  out.weight.assign(out.offset.back() * m, 0.0);

  std::vector<std::size_t> fill(out.offset.begin(), out.offset.end() - 1);
  for (const Index a : sources) {
    const bool own_wanted = is_wanted(a);
    const auto own = own_wanted ? fill[static_cast<std::size_t>(a)]++ : 0;
    if (own_wanted) out.id[own] = a;
    for_each_entry(a, [&](Index b, const double* weights) {
      const bool entry_wanted = is_wanted(b);
      const auto at = entry_wanted ? fill[static_cast<std::size_t>(b)]++ : 0;
      if (entry_wanted) out.id[at] = a;
      for (std::size_t c = 0; c < m; ++c) {
        const double w = weights[c];
        if (entry_wanted) out.weight[at * m + c] = w;
        if (own_wanted && in_sum[c] != 0) out.weight[own * m + c] -= w;
      }
    });
  }
  return out;
}

}  // namespace fpm::detail
