#include "segmented_rows.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <tuple>
#include <utility>

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

// Whether the entries of four rows stand side by side as the rows do.
bool are_aligned(const WeightedRows& rows, Index first, Index count) {
  if (count != lanes) return false;
  const auto ids = rows.ids(first);
  for (Index lane = 1; lane < lanes; ++lane) {
    const auto others = rows.ids(first + lane);
    const auto follows = [&](Index id, Index other) { return other == id + lane; };
    if (!std::ranges::equal(ids, others, follows)) return false;
  }
  return true;
}

}  // namespace

void Segmenter::append(const WeightedRows& rows) {
  const Index end = (rows.last() + block_rows_ - 1) / block_rows_;
  for (Index block = rows.first / block_rows_; block < end; ++block) append_block(rows, block);
}

void Segmenter::append_block(const WeightedRows& rows, Index block) {
  out_.block_begin.push_back(static_cast<Index>(out_.segments.size()));
  out_.row_count = std::min((block + 1) * block_rows_, rows.last());
  add_rows(rows, block * block_rows_, out_.row_count);
}

void Segmenter::append_copy(const SegmentedRows& before, Index block) {
  const auto at = static_cast<std::size_t>(block);
  out_.block_begin.push_back(static_cast<Index>(out_.segments.size()));
  for (Index s = before.block_begin[at]; s < before.block_begin[at + 1]; ++s) {
    add_copy(before, before.segments[static_cast<std::size_t>(s)]);
  }
  out_.row_count = std::min((block + 1) * block_rows_, before.row_count);
}

SegmentedRows Segmenter::finish() {
  out_.block_begin.push_back(static_cast<Index>(out_.segments.size()));
  // Kept for the whole run, and half of it may be room to grow.
  out_.segments.shrink_to_fit();
  out_.block_begin.shrink_to_fit();
  out_.ids.shrink_to_fit();
  out_.weights.shrink_to_fit();
  return std::move(out_);
}

void Segmenter::add_rows(const WeightedRows& rows, Index begin, Index end) {
  Index pending = begin;  // rows [pending, row) wait for a segment of their own
  const auto flush = [&](Index until) {
    for (; pending < until; pending += std::min(lanes, until - pending)) {
      add_own(rows, pending, std::min(lanes, until - pending));
    }
  };
  Index row = begin;
  while (row < end) {
    const std::string key = stencil_key(rows, row);
    Index run = 1;
    while (row + run < end && stencil_key(rows, row + run) == key) ++run;
    if (run >= shortest_shared_run) {
      flush(row);
      add_shared(rows, row, run, key);
      pending = row + run;
    }
    row += run;
  }
  flush(end);
}

void Segmenter::add_shared(const WeightedRows& rows, Index first, Index count,
                           const std::string& key) {
  const auto ids = rows.ids(first);
  const auto [place, is_new] = pooled(key, {out_.ids.size(), out_.weights.size()});
  if (is_new) {
    for (const Index b : ids) out_.ids.push_back(b - first);
    const auto weights = rows.weights(first);
    out_.weights.insert(out_.weights.end(), weights.begin(), weights.end());
  }
  out_.segments.push_back({first, count, static_cast<Index>(ids.size()),
                           SegmentedRows::Kind::shared, place.id, place.weight});
}

void Segmenter::add_own(const WeightedRows& rows, Index first, Index count) {
  std::size_t width = 0;
  for (Index r = first; r < first + count; ++r) width = std::max(width, rows.width(r));
  const auto m = static_cast<std::size_t>(channels_);
  const bool aligned = are_aligned(rows, first, count);
  out_.segments.push_back({first, count, static_cast<Index>(width),
                           aligned ? SegmentedRows::Kind::aligned : SegmentedRows::Kind::own,
                           out_.ids.size(), out_.weights.size()});
  for (std::size_t k = 0; k < width; ++k) {
    for (Index lane = 0; lane < (aligned ? 1 : lanes); ++lane) {
      const Index row = std::min(first + lane, first + count - 1);
      const auto ids = rows.ids(row);
      out_.ids.push_back(k < ids.size() ? ids[k] : std::min(row, sources_ - 1));
    }
    for (std::size_t c = 0; c < m; ++c) {
      for (Index lane = 0; lane < lanes; ++lane) {
        const bool real = lane < count && k < rows.width(first + lane);
        out_.weights.push_back(real ? rows.weights(first + lane)[k * m + c] : 0.0);
      }
    }
  }
}

// A segment as it is in another layout. Of a stencil that is shared there one copy is kept.
void Segmenter::add_copy(const SegmentedRows& before, SegmentedRows::Segment segment) {
  // An empty one begins where the next one does.
  const bool shared = segment.kind == SegmentedRows::Kind::shared && segment.width > 0;
  const auto width = static_cast<std::size_t>(segment.width);
  const std::size_t ids = segment.kind == SegmentedRows::Kind::own ? lanes * width : width;
  const std::size_t weights = (shared ? 1 : lanes) * width * static_cast<std::size_t>(channels_);
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

// Where a stencil is that was met before, else `next`, where it will be.
std::pair<Segmenter::Place, bool> Segmenter::pooled(const std::string& key, const Place& next) {
  const auto [known, is_new] = pool_.try_emplace(key, next);
  return {known->second, is_new};
}

SegmentedRows segment_anew(const SegmentedRows& before, const WeightedRows& rows,
                           const std::vector<char>& changed, Index block_rows, Index sources) {
  Segmenter segmenter(rows.channels, block_rows, sources);
  for (std::size_t block = 0; block < changed.size(); ++block) {
    if (changed[block] == 0) {
      segmenter.append_copy(before, static_cast<Index>(block));
    } else {
      segmenter.append_block(rows, static_cast<Index>(block));
    }
  }
  return segmenter.finish();
}

}  // namespace fpm::detail
