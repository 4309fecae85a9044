#include "limit/block/block_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace limit::block {

namespace {

// Over the height of what may fail.
constexpr double most_radius = 200.0, least_length = 0.02;

// [rad] into the ground.
constexpr double least_turn = 0.002, most_turn = 2.6;

constexpr double none = std::numeric_limits<double>::infinity();

// Geometric, both ends included.
std::vector<double> graded(double first, double last, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) {
    values.push_back(first * std::pow(last / first, static_cast<double>(k) / (count - 1)));
  }
  return values;
}

// Along free outline, from piece to piece; a place outside of it stays where it was.
void move_along(const std::vector<OutlinePiece>& outline, LowEnd& end, double share) {
  if (share >= 0.0 && share < 1.0) {
    end.share = share;
    return;
  }
  // The pieces of a mesh's outline follow each other in no order; the neighbour by its end.
  const OutlinePiece& here = outline[end.piece];
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const OutlinePiece& other = outline[i];
    if (!other.is_free) continue;
    const bool follows = share >= 1.0 && other.first == here.second;
    const bool precedes = share < 0.0 && other.second == here.first;
    if (!follows && !precedes) continue;
    end.piece = i;
    end.share = follows ? 0.0 : 0.999;
    return;
  }
}

}  // namespace

BlockSearch::BlockSearch(const problem::Problem& problem, double height) : height_(height) {
  const double least = least_length * height;
  views_.push_back({BlockGround(problem, least), false, {}});
  views_.push_back({BlockGround(mirrored(problem), least), true, {}});
}

void BlockSearch::look_everywhere(View& view) const {
  constexpr int turns = 14, radii = 8;
  const std::vector<double> turn = graded(least_turn, most_turn, turns);
  const std::vector<double> radius = graded(0.2 * height_, most_radius * height_, radii);
  const auto& outline = view.ground.outline();
  // The best one from each place, and of those the best.
  std::vector<Candidate> found;
  const auto free = static_cast<std::size_t>(std::count_if(
      outline.begin(), outline.end(), [](const OutlinePiece& piece) { return piece.is_free; }));
  constexpr std::size_t enough = 24;
  for (std::size_t piece = 0, count = 0; piece < outline.size(); ++piece) {
    if (!outline[piece].is_free) continue;
    if (!outline[piece].is_corner && count++ % (1 + free / enough) != 0) continue;
    Candidate best{none, {}};
    for (const double t : turn) {
      for (const double r : radius) {
        const LowEnd end{piece, 0.0, t, r};
        const double here = view.ground.multiplier(end);
        if (here < best.multiplier) best = {here, end};
      }
    }
    if (best.multiplier < none) found.push_back(best);
  }
  std::sort(found.begin(), found.end(),
            [](const Candidate& a, const Candidate& b) { return a.multiplier < b.multiplier; });
  constexpr std::size_t kept = 4;
  if (found.size() > kept) found.resize(kept);
  view.best = std::move(found);
}

// A pattern search in the logarithms of turn and radius, and along the outline.
double BlockSearch::polish(View& view, Candidate& candidate) const {
  BlockGround& ground = view.ground;
  candidate.multiplier = ground.multiplier(candidate.end);
  constexpr std::array<std::array<double, 3>, 10> ways{{{1, 0, 0},
                                                        {-1, 0, 0},
                                                        {0, 1, 0},
                                                        {0, -1, 0},
                                                        {1, 1, 0},
                                                        {-1, -1, 0},
                                                        {1, -1, 0},
                                                        {-1, 1, 0},
                                                        {0, 0, 1},
                                                        {0, 0, -1}}};
  constexpr double first_step = 0.3, last_step = 1e-5;
  constexpr int most_steps = 500;
  double step = first_step;
  for (int count = 0; step > last_step && count < most_steps; ++count) {
    bool is_better = false;
    for (const auto& way : ways) {
      // As long as it helps.
      for (bool helps = true; helps;) {
        LowEnd end = candidate.end;
        end.turn *= std::exp(step * way[0]);
        end.radius *= std::exp(2.0 * step * way[1]);
        if (way[2] != 0.0) move_along(ground.outline(), end, end.share + step * way[2]);
        // Where radii are all that large, powers are differences of large numbers.
        if (end.radius > most_radius * height_ || end.turn < least_turn) break;
        const double here = ground.multiplier(end);
        helps = here < candidate.multiplier;
        if (helps) candidate = {here, end};
        is_better = is_better || helps;
      }
    }
    if (!is_better) step /= 2.0;
  }
  return candidate.multiplier;
}

std::optional<Weakest> BlockSearch::weakest(const std::vector<problem::Soil>& soils) {
  View* best_view = nullptr;
  Candidate best{none, {}};
  for (View& view : views_) {
    view.ground.set_soils(soils);
    look_everywhere(view);
  }
  // Nor does ground that slopes one way fail the other way.
  constexpr double hopeless = 3.0;
  const auto least = [](const View& view) {
    double multiplier = none;
    for (const Candidate& one : view.best) multiplier = std::min(multiplier, one.multiplier);
    return multiplier;
  };
  const double most = hopeless * std::min(least(views_[0]), least(views_[1]));
  for (View& view : views_) {
    if (least(view) > most) continue;
    for (Candidate& candidate : view.best) {
      if (polish(view, candidate) >= best.multiplier) continue;
      best = candidate;
      best_view = &view;
    }
  }
  if (best_view == nullptr) return std::nullopt;
  const double multiplier = best_view->ground.multiplier(best.end);
  Weakest found{multiplier, best_view->ground.last()};
  found.block.clockwise = best_view->is_mirrored;
  return found;
}

}  // namespace limit::block
