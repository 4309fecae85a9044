#include "segmented_rows.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <unordered_map>

namespace fpm::detail {
namespace {

constexpr Index lanes = 4;
constexpr Index shortest_shared_run = 4;  // a shorter one fills no vector of lanes

// The bytes of a stencil (neighbour offsets and weights): equal keys mean equal to the last bit.
std::string stencil_key(const WeightedRows& rows, Index row) {
  const auto ids = rows.ids(row);
  const auto weights = rows.weights(row);
  std::string key(ids.size() * sizeof(Index) + weights.size_bytes(), '\0');
  char* at = key.data();
  for (const Index b : ids) {
    const Index offset = b - row;
    std::memcpy(at, &offset, sizeof(offset));
    at += sizeof(offset);
  }
  std::memcpy(at, weights.data(), weights.size_bytes());
  return key;
}

class Layout {
 public:
  Layout(const WeightedRows& rows, Index sources, SegmentedRows& out)
      : rows_(rows), sources_(sources), out_(out) {}

  void add_shared(Index first, Index count, const std::string& key) {
    const auto ids = rows_.ids(first);
    const auto [known, is_new] =
        pool_.try_emplace(key, Place{out_.ids.size(), out_.weights.size()});
    if (is_new) {
      for (const Index b : ids) out_.ids.push_back(b - first);
      const auto weights = rows_.weights(first);
      out_.weights.insert(out_.weights.end(), weights.begin(), weights.end());
    }
    out_.segments.push_back({first, count, static_cast<Index>(ids.size()),
                             SegmentedRows::Kind::shared, known->second.id, known->second.weight});
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

 private:
  struct Place {
    std::size_t id;
    std::size_t weight;
  };
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
};

}  // namespace

WeightedRows transpose(const WeightedRows& rows, Index transposed_size,
                       const std::vector<char>& in_sum) {
  const auto m = static_cast<std::size_t>(rows.channels);
  WeightedRows out;
  out.channels = rows.channels;
  std::vector<std::size_t> count(static_cast<std::size_t>(transposed_size), 0);
  for (const Index b : rows.id) ++count[static_cast<std::size_t>(b)];
  for (Index a = 0; a < rows.size(); ++a) ++count[static_cast<std::size_t>(a)];
  out.offset.resize(count.size() + 1);
  for (std::size_t b = 0; b < count.size(); ++b) out.offset[b + 1] = out.offset[b] + count[b];
  out.id.resize(out.offset.back());
  out.weight.assign(out.offset.back() * m, 0.0);

  std::vector<std::size_t> fill(out.offset.begin(), out.offset.end() - 1);
  for (Index a = 0; a < rows.size(); ++a) {
    const auto own = fill[static_cast<std::size_t>(a)]++;
    out.id[own] = a;
    const auto ids = rows.ids(a);
    const auto weights = rows.weights(a);
    for (std::size_t k = 0; k < ids.size(); ++k) {
      const auto at = fill[static_cast<std::size_t>(ids[k])]++;
      out.id[at] = a;
      for (std::size_t c = 0; c < m; ++c) {
        const double w = weights[k * m + c];
        out.weight[at * m + c] = w;
        if (in_sum[c] != 0) out.weight[own * m + c] -= w;
      }
    }
  }
  return out;
}

SegmentedRows segment(const WeightedRows& rows, Index block_rows, Index sources) {
  SegmentedRows out;
  out.row_count = rows.size();
  Layout layout(rows, sources, out);
  for (Index begin = 0; begin < rows.size(); begin += block_rows) {
    out.block_begin.push_back(static_cast<Index>(out.segments.size()));
    const Index end = std::min(begin + block_rows, rows.size());
    Index pending = begin;  // rows [pending, row) wait for a segment of their own
    const auto flush = [&](Index until) {
      for (; pending < until; pending += std::min(lanes, until - pending)) {
        layout.add_own(pending, std::min(lanes, until - pending));
      }
    };
    Index row = begin;
    while (row < end) {
      const std::string key = stencil_key(rows, row);
      Index run = 1;
      while (row + run < end && stencil_key(rows, row + run) == key) ++run;
      if (run >= shortest_shared_run) {
        flush(row);
        layout.add_shared(row, run, key);
        pending = row + run;
      }
      row += run;
    }
    flush(end);
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
