#include "segmented_rows.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>
#include <string>
#include <tuple>
#include <unordered_map>

namespace fpm::detail {
namespace {

constexpr Index lanes = 4;
constexpr Index shortest_shared_run = 4;  // a shorter one fills no vector of lanes

// The bytes of a stencil (neighbour offsets and weights): equal keys mean equal to the last bit.
std::string key_of(std::span<const Index> ids, Index row, std::span<const double> weights) {
  std::string key(ids.size_bytes() + weights.size_bytes(), '\0');
  char* at = key.data();
  for (const Index b : ids) {
    const Index offset = b - row;
    std::memcpy(at, &offset, sizeof(offset));
    at += sizeof(offset);
  }
  std::memcpy(at, weights.data(), weights.size_bytes());
  return key;
}

std::string stencil_key(const WeightedRows& rows, Index row) {
  return key_of(rows.ids(row), row, rows.weights(row));
}

class Layout {
  struct Place {
    std::size_t id;
    std::size_t weight;
  };

 public:
  Layout(const WeightedRows& rows, Index sources, SegmentedRows& out)
      : rows_(rows), sources_(sources), out_(out) {}

  void add_block(Index begin, Index end) {
    Index pending = begin;  // rows [pending, row) wait for a segment of their own
    const auto flush = [&](Index until) {
      for (; pending < until; pending += std::min(lanes, until - pending)) {
        add_own(pending, std::min(lanes, until - pending));
      }
    };
    Index row = begin;
    while (row < end) {
      const std::string key = stencil_key(rows_, row);
      Index run = 1;
      while (row + run < end && stencil_key(rows_, row + run) == key) ++run;
      if (run >= shortest_shared_run) {
        flush(row);
        add_shared(row, run, key);
        pending = row + run;
      }
      row += run;
    }
    flush(end);
  }

  // A segment as it is in another layout. Of a stencil that is shared there one copy is kept.
  void add_copy(const SegmentedRows& before, SegmentedRows::Segment segment) {
    const bool shared = segment.kind == SegmentedRows::Kind::shared;
    const auto width = static_cast<std::size_t>(segment.width);
    const std::size_t ids = segment.kind == SegmentedRows::Kind::own ? lanes * width : width;
    const std::size_t weights =
        (shared ? 1 : lanes) * width * static_cast<std::size_t>(rows_.channels);
    const std::span<const Index> id{before.ids.data() + segment.id_begin, ids};
    const std::span<const double> weight{before.weights.data() + segment.weight_begin, weights};
    const std::size_t old = segment.id_begin;
    Place place{out_.ids.size(), out_.weights.size()};
    bool is_new = true;
    if (const auto copied = copied_.find(old); shared && copied != copied_.end()) {
      place = copied->second;
      is_new = false;
    } else if (shared) {
      std::tie(place, is_new) = pooled(key_of(id, 0, weight), place);
      copied_.emplace(old, place);
    }
    segment.id_begin = place.id;
    segment.weight_begin = place.weight;
    out_.segments.push_back(segment);
    if (!is_new) return;
    out_.ids.insert(out_.ids.end(), id.begin(), id.end());
    out_.weights.insert(out_.weights.end(), weight.begin(), weight.end());
  }

 private:
  void add_shared(Index first, Index count, const std::string& key) {
    const auto ids = rows_.ids(first);
    const auto [place, is_new] = pooled(key, {out_.ids.size(), out_.weights.size()});
    if (is_new) {
      for (const Index b : ids) out_.ids.push_back(b - first);
      const auto weights = rows_.weights(first);
      out_.weights.insert(out_.weights.end(), weights.begin(), weights.end());
    }
    out_.segments.push_back({first, count, static_cast<Index>(ids.size()),
                             SegmentedRows::Kind::shared, place.id, place.weight});
  }

  // Where a stencil is that was met before, else `next`, where it will be.
  std::pair<Place, bool> pooled(const std::string& key, const Place& next) {
    const auto [known, is_new] = pool_.try_emplace(key, next);
    return {known->second, is_new};
  }

  void add_own(Index first, Index count) {
    std::size_t width = 0;
    for (Index r = first; r < first + count; ++r) width = std::max(width, rows_.width(r));
    const auto m = static_cast<std::size_t>(rows_.channels);
    const bool aligned = are_aligned(first, count);
    out_.segments.push_back({first, count, static_cast<Index>(width),
                             aligned ? SegmentedRows::Kind::aligned : SegmentedRows::Kind::own,
                             out_.ids.size(), out_.weights.size()});
    for (std::size_t k = 0; k < width; ++k) {
      for (Index lane = 0; lane < (aligned ? 1 : lanes); ++lane) {
        const Index row = std::min(first + lane, first + count - 1);
        const auto ids = rows_.ids(row);
        out_.ids.push_back(k < ids.size() ? ids[k] : std::min(row, sources_ - 1));
      }
      for (std::size_t c = 0; c < m; ++c) {
        for (Index lane = 0; lane < lanes; ++lane) {
          const bool real = lane < count && k < rows_.width(first + lane);
          out_.weights.push_back(real ? rows_.weights(first + lane)[k * m + c] : 0.0);
        }
      }
    }
  }

  // Whether the entries of four rows stand side by side as the rows do.
  bool are_aligned(Index first, Index count) const {
    if (count != lanes) return false;
    const auto ids = rows_.ids(first);
    for (Index lane = 1; lane < lanes; ++lane) {
      const auto others = rows_.ids(first + lane);
      const auto follows = [&](Index id, Index other) { return other == id + lane; };
      if (!std::ranges::equal(ids, others, follows)) return false;
    }
    return true;
  }

  const WeightedRows& rows_;
  Index sources_;
  SegmentedRows& out_;
  std::unordered_map<std::string, Place> pool_;
  std::unordered_map<std::size_t, Place> copied_;  // by where the ids were
};

}  // namespace

WeightedRows transpose(const WeightedRows& rows, Index transposed_size,
                       const std::vector<char>& in_sum) {
  const auto m = static_cast<std::size_t>(rows.channels);
  std::vector<Index> sources(static_cast<std::size_t>(rows.size()));
  std::iota(sources.begin(), sources.end(), 0);
  const std::vector<char> all(static_cast<std::size_t>(transposed_size), 1);
  return transpose_part(sources, all, rows.channels, in_sum, [&](Index a, const auto& visit) {
    const auto ids = rows.ids(a);
    const double* const weights = rows.weights(a).data();
    for (std::size_t k = 0; k < ids.size(); ++k) visit(ids[k], weights + k * m);
  });
}

SegmentedRows segment(const WeightedRows& rows, Index block_rows, Index sources) {
  const auto blocks = static_cast<std::size_t>((rows.size() + block_rows - 1) / block_rows);
  return segment_anew({}, rows, std::vector<char>(blocks, 1), block_rows, sources);
}

SegmentedRows segment_anew(const SegmentedRows& before, const WeightedRows& rows,
                           const std::vector<char>& changed, Index block_rows, Index sources) {
  SegmentedRows out;
  out.row_count = rows.size();
  Layout layout(rows, sources, out);
  for (std::size_t block = 0; block < changed.size(); ++block) {
    out.block_begin.push_back(static_cast<Index>(out.segments.size()));
    if (changed[block] == 0) {
      for (Index s = before.block_begin[block]; s < before.block_begin[block + 1]; ++s) {
        layout.add_copy(before, before.segments[static_cast<std::size_t>(s)]);
      }
      continue;
    }
    const auto begin = static_cast<Index>(block) * block_rows;
    layout.add_block(begin, std::min(begin + block_rows, rows.size()));
  }
  out.block_begin.push_back(static_cast<Index>(out.segments.size()));
  // Kept for the whole run, and half of it may be room to grow.
  out.segments.shrink_to_fit();
  out.block_begin.shrink_to_fit();
  out.ids.shrink_to_fit();
  out.weights.shrink_to_fit();
  return out;
}

}  // namespace fpm::detail
