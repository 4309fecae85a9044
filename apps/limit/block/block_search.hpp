#pragma once

#include <optional>
#include <vector>

#include "limit/block/block_ground.hpp"

namespace limit::block {

/// The block that fails at the least multiplier.
struct Weakest {
  double multiplier = 0.0;
  problem::TurningBlock block;
};

/// Looks for the weakest of a ground's turning blocks: everywhere, and near the best ones of the
/// last time, then closer to the best of those. What it misses makes a bound worse, not wrong.
class BlockSearch {
 public:
  /// @param height  of what may fail, to measure radii by
  BlockSearch(const problem::Problem& problem, double height);

  /// For soils of these strengths; none if no block fails however large the live loads.
  [[nodiscard]] std::optional<Weakest> weakest(const std::vector<problem::Soil>& soils);

 private:
  struct Candidate {
    double multiplier = 0.0;
    LowEnd end;
  };
  struct View {
    BlockGround ground;
    bool is_mirrored = false;
    std::vector<Candidate> best;  // of the last soils
  };
  void look_everywhere(View& view) const;
  [[nodiscard]] double polish(View& view, Candidate& candidate) const;

  double height_;
  std::vector<View> views_;
};

}  // namespace limit::block
