// The kernels by every instruction set that this processor has, against the narrow ones. The wider
// fuse products with sums: what each sum rounds differs, not what it sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "operator_kernels.hpp"
#include "segmented_rows.hpp"

namespace {

using fpm::Channels;
using fpm::Index;
using fpm::detail::InstructionSet;
using fpm::detail::KernelRows;
using fpm::detail::WeightedRows;

constexpr Index block_rows = 64;
constexpr Index padding = 8;

double random_number() {
  static std::mt19937 generator(7);
  return std::uniform_real_distribution<double>(-1.0, 1.0)(generator);
}

std::vector<double> random_numbers(std::size_t count) {
  std::vector<double> numbers(count);
  for (double& x : numbers) x = random_number();
  return numbers;
}

// Runs of rows of one stencil, of every remainder of the lanes, between rows of weights of their
// own, by turns with entries side by side and anywhere.
WeightedRows some_rows(Index size, int channels) {
  WeightedRows rows;
  rows.channels = channels;
  constexpr Index width = 5;
  const std::vector<double> shared = random_numbers(static_cast<std::size_t>(width * channels));
  for (Index a = 0, run = 1, left = 1; a < size; ++a) {
    const bool inside = a >= width && a + width < size;
    const bool alike = inside && left > 0;
    const bool beside = inside && run % 2 == 0;
    for (Index k = 0; k < width; ++k) {
      rows.id.push_back(alike || beside ? a + 2 * k - 4 : (a * 7 + k * 13 + 1) % size);
      for (int c = 0; c < channels; ++c) {
        rows.weight.push_back(alike ? shared[static_cast<std::size_t>(k * channels + c)]
                                    : random_number());
      }
    }
    rows.offset.push_back(rows.id.size());
    if (--left < -8) left = ++run;
  }
  return rows;
}

template <int Dim>
std::vector<double> everything(const fpm::SegmentedRows& rows, Channels channels,
                               InstructionSet set) {
  const auto kernels = fpm::detail::kernels<Dim>(channels, set);
  const std::ptrdiff_t stride = rows.row_count + padding;
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto field = [&](int count) {
    std::vector<double> f(static_cast<std::size_t>(count * stride));
    for (double& x : f) x = uniform(generator);
    return f;
  };
  const auto u = field(Dim), v = field(Dim), x = field(Dim);
  const auto stress = field(Dim * Dim + (channels.pair ? 1 + Dim + 2 * Dim * Dim : 0) +
                            (channels.second ? fpm::second_gradient_size<Dim> * Dim : 0));
  const int moments = channels.count(Dim) * Dim;
  std::vector<double> result(static_cast<std::size_t>((moments + Dim) * stride), 0.0);
  for (std::size_t b = 0; b + 1 < rows.block_begin.size(); ++b) {
    const KernelRows block{rows.segments.data() + rows.block_begin[b],
                           rows.segments.data() + rows.block_begin[b + 1], rows.ids.data(),
                           rows.weights.data()};
    const auto first = static_cast<Index>(b) * block_rows;
    kernels.gather(block, u.data(), stride, first, result.data() + first, stride);
    kernels.scatter(block, stress.data(), v.data(), x.data(), stride,
                    result.data() + moments * stride);
  }
  return result;
}

template <int Dim>
void expect_the_same_by_every_set(Channels channels) {
  constexpr Index size = 303;
  fpm::detail::Segmenter segmenter(channels.count(Dim), block_rows, size);
  segmenter.append(some_rows(size, channels.count(Dim)));
  const auto rows = segmenter.finish();
  using Kind = fpm::SegmentedRows::Kind;
  for (const Kind kind : {Kind::shared, Kind::aligned, Kind::own}) {
    EXPECT_GT(std::ranges::count(rows.segments, kind, &fpm::SegmentedRows::Segment::kind), 8);
  }
  const auto expected = everything<Dim>(rows, channels, InstructionSet::narrow);
  for (const InstructionSet set : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (set > fpm::detail::widest_instruction_set()) continue;
    const auto found = everything<Dim>(rows, channels, set);
    for (std::size_t k = 0; k < expected.size(); ++k) {
      // Five entries of up to 27 terms, each of up to a few: as many roundings.
      ASSERT_NEAR(found[k], expected[k], 5 * 27 * 2.3e-16 * 8) << static_cast<int>(set);
    }
  }
}

TEST(InstructionSets, GiveTheSameMomentsAndForces) {
  for (const bool pair : {false, true}) {
    for (const bool second : {false, true}) {
      expect_the_same_by_every_set<2>({pair, second});
      expect_the_same_by_every_set<3>({pair, second});
    }
  }
}

}  // namespace
