#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "fpm/moment_operator.hpp"

namespace fpm::detail {

/// Rows of a sparse operator with several weights per entry, that follow one another.
struct WeightedRows {
  int channels = 0;
  Index first = 0;
  std::vector<std::size_t> offset{0};
  std::vector<Index> id;
  std::vector<double> weight;  // `channels` per entry

  Index size() const { return static_cast<Index>(offset.size()) - 1; }
  Index last() const { return first + size(); }
  std::size_t begin(Index row) const { return offset[static_cast<std::size_t>(row - first)]; }
  std::size_t width(Index row) const { return begin(row + 1) - begin(row); }
  std::span<const Index> ids(Index row) const { return {id.data() + begin(row), width(row)}; }
  std::span<const double> weights(Index row) const {
    const auto m = static_cast<std::size_t>(channels);
    return {weight.data() + begin(row) * m, width(row) * m};
  }
};

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

/// Columns of an operator.
template <class Predicate>
struct Columns {
  Index first, last;
  Predicate is_wanted;  // of those in [first, last)

  bool operator()(Index b) const { return b >= first && b < last && is_wanted(b); }
};
template <class Predicate>
Columns(Index, Index, Predicate) -> Columns<Predicate>;

/// Rows of the transposed operator: those of the wanted columns, and nothing for the others. If it
/// is a row of the operator as well, each starts from its own entry: minus the sum of that row's
/// weights in the channels where `in_sum` is set, zero in the others.
/// @param sources  the rows that may have an entry in these columns, ascending, wanted ones among
///   them
/// @param for_each_entry  called as for_each_entry(row, visit) with visit(column, weights)
template <class Predicate, class ForEachEntry>
WeightedRows transpose_part(const std::vector<Index>& sources, const Columns<Predicate>& wanted,
                            int channels, const std::vector<char>& in_sum,
                            const ForEachEntry& for_each_entry);

/// Lays rows out for the kernels, in blocks of `block_rows`; equal stencils are stored once. Rows
/// of one group are filled up to the widest with entries of no weight, which refer to the row
/// itself or, as a transposed row may be none, to the last of the `sources` that an entry may refer
/// to: what they read must exist, since zero times garbage may be NaN.
class Segmenter {
 public:
  Segmenter(int channels, Index block_rows, Index sources)
      : channels_(channels), block_rows_(block_rows), sources_(sources) {}

  /// The blocks that follow, from rows that are all of theirs.
  void append(const WeightedRows& rows);
  /// The block that follows, from rows that have it.
  void append_block(const WeightedRows& rows, Index block);
  /// The block that follows, as it is in `before`.
  void append_copy(const SegmentedRows& before, Index block);
  SegmentedRows finish();

 private:
  struct Place {
    std::size_t id;
    std::size_t weight;
  };

  void add_rows(const WeightedRows& rows, Index begin, Index end);
  void add_shared(const WeightedRows& rows, Index first, Index count, const std::string& key);
  void add_own(const WeightedRows& rows, Index first, Index count);
  void add_copy(const SegmentedRows& before, SegmentedRows::Segment segment);
  std::pair<Place, bool> pooled(const std::string& key, const Place& next);

  int channels_;
  Index block_rows_;
  Index sources_;
  SegmentedRows out_;
  std::unordered_map<std::string, Place> pool_;
  std::unordered_map<std::size_t, Place> copied_;  // by where the ids were
};

/// All of an operator's blocks anew where `changed` is set, from `rows`; the others stay as they
/// are in `before`.
SegmentedRows segment_anew(const SegmentedRows& before, const WeightedRows& rows,
                           const std::vector<char>& changed, Index block_rows, Index sources);

template <class Predicate, class ForEachEntry>
WeightedRows transpose_part(const std::vector<Index>& sources, const Columns<Predicate>& wanted,
                            int channels, const std::vector<char>& in_sum,
                            const ForEachEntry& for_each_entry) {
  const auto m = static_cast<std::size_t>(channels);
  const auto place = [&](Index b) { return static_cast<std::size_t>(b - wanted.first); };
  WeightedRows out;
  out.channels = channels;
  out.first = wanted.first;
  out.offset.assign(place(wanted.last) + 1, 0);
  for (const Index a : sources) {
    if (wanted(a)) ++out.offset[place(a) + 1];
    for_each_entry(a, [&](Index b, const double*) {
      if (wanted(b)) ++out.offset[place(b) + 1];
    });
  }
  std::partial_sum(out.offset.begin(), out.offset.end(), out.offset.begin());
  out.id.resize(out.offset.back());
  out.weight.assign(out.offset.back() * m, 0.0);

  std::vector<std::size_t> fill(out.offset.begin(), out.offset.end() - 1);
  for (const Index a : sources) {
    const bool own_wanted = wanted(a);
    const auto own = own_wanted ? fill[place(a)]++ : 0;
    if (own_wanted) out.id[own] = a;
    for_each_entry(a, [&](Index b, const double* weights) {
      const bool entry_wanted = wanted(b);
      const auto at = entry_wanted ? fill[place(b)]++ : 0;
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
