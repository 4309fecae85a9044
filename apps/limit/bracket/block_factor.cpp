#include "limit/bracket/block_factor.hpp"

#include <algorithm>
#include <cmath>

#include "limit/block/block_search.hpp"
#include "limit/bracket/factor_search.hpp"
#include "limit/bracket/weakened.hpp"

namespace limit::bracket {

namespace {

// Of the mesh's nodes: blocks are measured by it.
double height_of(const mesh::Mesh& mesh) {
  double low = mesh.nodes.front().y(), high = low;
  for (const mesh::Point& node : mesh.nodes) {
    low = std::min(low, node.y());
    high = std::max(high, node.y());
  }
  return high - low;
}

}  // namespace

std::optional<BlockFactor> block_factor(const problem::Problem& problem, double one, double first,
                                        double most_seconds, const Means& means) {
  // The search knows soils of one cohesion and friction and weights only.
  const auto varies = [](const problem::Soil& soil) { return soil.varies() || soil.is_curved(); };
  if (problem.has_water() || std::any_of(problem.soils.begin(), problem.soils.end(), varies))
    return std::nullopt;
  const double began = means.seconds();
  block::BlockSearch search(problem, height_of(problem.mesh));
  FactorSearch factors(first);
  std::optional<BlockFactor> best;
  problem::Problem weak = problem;
  constexpr int most_steps = 40;
  constexpr double close = 1e-4, end = 1e6;
  for (int step = 0; step < most_steps && means.seconds() - began < most_seconds; ++step) {
    const double factor = factors.root() * (1.0 + 0.1 * close);
    weak.soils = weakened(problem.soils, factor);
    const auto found = search.weakest(weak.soils);
    const double multiplier = found ? found->multiplier / one : end;
    factors.saw(factor, std::min(multiplier, end), multiplier >= end);
    const bool is_better = multiplier < 1.0 && (!best || factor < best->factor);
    if (is_better) {
      const auto certificate = certificate::certify_block(weak, found->block);
      if (certificate.holds() && certificate.multiplier < one) {
        best = BlockFactor{factor, found->block, certificate};
      }
    }
    const bool is_close = std::abs(std::log(multiplier)) < close || factors.width() < close;
    if (is_close && best) break;
  }
  return best;
}

}  // namespace limit::bracket
