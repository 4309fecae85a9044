#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "limit/bracket/attempt.hpp"
#include "limit/bracket/factor_search.hpp"
#include "limit/bracket/means.hpp"
#include "limit/bracket/side.hpp"
#include "limit/bracket/weakened.hpp"
#include "limit/problem/at_rest.hpp"

namespace limit::bracket {

/// Where the search of a factor begins, near enough for slopes: friction against the mean
/// inclination of what is free, and Taylor's stability number. One, if there is no face.
/// @param one  the multiplier of the loads as they are
[[nodiscard]] double estimated_factor(const problem::Problem& problem, double one);

/// One bound of the factor.
class Flank {
 public:
  Flank(const problem::Problem& problem, bool is_lower, double one, const Means& means)
      : is_lower_(is_lower),
        means_(&means),
        problem_(problem),
        one_(one),
        most_(problem.most_multiplier.value()),
        side_(problem, is_lower, means),
        search_(estimated_factor(problem, one)) {}

  /// The best one certified so far.
  [[nodiscard]] const std::optional<double>& factor() const { return factor_; }
  [[nodiscard]] int triangles() const { return side_.triangles(); }
  [[nodiscard]] bool can_refine() const { return side_.can_refine() && failures_ < most_failures; }
  /// Whether a factor leaves some soil so much friction that solvers may lose themselves in it.
  [[nodiscard]] bool is_steep_at(double factor) const {
    const auto steep_there = [&](const problem::Soil& soil) { return is_steep(soil, factor); };
    return std::any_of(problem_.soils.begin(), problem_.soils.end(), steep_there);
  }
  /// Whether soils would be put to rest, or more of them, if a solver failed at a factor.
  [[nodiscard]] bool may_rest(double factor) const {
    return resting_ != Resting::all && is_steep_at(factor);
  }
  /// What a solve should take, by the last one that ended well; nothing if there is none.
  [[nodiscard]] double expected_seconds() const {
    constexpr double growth = 1.5;  // of the work with the triangles
    if (solved_triangles_ == 0) return 0.0;
    return seconds_ * std::pow(static_cast<double>(triangles()) / solved_triangles_, growth);
  }
  /// Gain of the last mesh for its work; infinite as long as it is not known.
  [[nodiscard]] double promise() const { return promise_; }
  /// @param reach  how far off it may be, as a factor
  void start_from(double factor, double reach) { search_ = FactorSearch(factor, reach); }

  /// Puts the soils to rest that had to be on another mesh, which the solver may then do without
  /// failing first.
  void rest_as(const Flank& other, double factor) {
    for (Resting before = Resting::all; resting_ != before && resting_ != other.resting_;) {
      before = resting_;
      put_to_rest(factor);
    }
  }

  /// Where no factor was certified, that of stresses which carry less than the loads at a factor
  /// tried: enlarged until they carry them, they lie within a strength that is as much more.
  [[nodiscard]] std::optional<double> enlarged_factor() const {
    return enlarged_ > 0.0 && !factor_ ? std::optional(enlarged_) : std::nullopt;
  }

  /// With the best fields so far.
  void give(Bracket& bracket) const {
    if (best_.lower || less_.lower) bracket.lower = best_.lower ? best_.lower : less_.lower;
    if (best_.upper) bracket.upper = best_.upper;
  }

  /// Finds the factor at which this mesh's bound of the multiplier is one, unless a better one is
  /// known from elsewhere.
  /// @param nearness  -> how closely, as a share of it
  /// @param known     -> the best factor so far on this side of the collapse, from anywhere
  /// @param solve     (*this, factor) -> whether to go on
  template <class Nearness, class Known, class Solve>
  void settle(const Nearness& nearness, const Known& known, const Solve& solve) {
    const std::optional<double> before = settled_;
    work_ = 0.0;
    constexpr int most_steps = 16;
    double last = 0.0;
    for (int step = 0; step < most_steps && failures_ < most_failures; ++step) {
      const double near = nearness();
      // To the side on which the certificate decides, by less than what is asked for, but not to
      // where it would be worth nothing.
      double target = next_factor() * std::exp((is_lower_ ? -0.25 : 0.25) * near);
      if (!is_better(target, known()) && is_better(next_factor(), known())) target = next_factor();
      const bool is_near = factor_ && std::abs(std::log(target / *factor_)) < near;
      // A multiplier that is far from one says that there is more to come, where it falls off.
      constexpr double steep_enough = 4.0, most_left = 0.1;
      if (is_near && step > 0 && excess_ < std::min(steep_enough * near, most_left)) break;
      if (factor_ && 2.0 * search_.width() < near && is_near) break;
      if (step > 0 && failures_ == 0 && is_surpassed(target, last, known())) break;
      if (!solve(*this, target)) break;
      last = target;
    }
    settled_ = search_.root();
    if (!before) return;
    // Of the mesh, whether it was certified or not.
    gain_ = std::log(*settled_ / *before);
    promise_ = std::abs(gain_) / std::max(1.0, work_);
  }

  /// @param wide  by how much the bracket is wider than asked for
  void refine(double wide) {
    // More than where every mesh is solved once.
    constexpr double least = 1.25, most = 2.0;
    side_.refine(std::clamp(std::sqrt(wide), least, most));
    // As steep as the solver goes along with: the more strength there is, the more is carried.
    constexpr double steeper = 1.5;
    if (failures_ == 0) steepest_ *= steeper;
    // A finer mesh gains less than the last one did, by about half.
    search_.begin_anew(std::exp(gain_ / 2.0));
  }

  /// Bounds the multiplier of the loads with the strength divided by the factor.
  void solve_at(double factor, const BracketOptions& options,
                const std::function<void(const Attempt&)>& watch, std::vector<Attempt>& attempts) {
    if (failures_ > 0 && resting_ != Resting::all) put_to_rest(factor);
    std::vector<problem::Soil> soils = problem_.soils;
    for (problem::Soil& soil : soils) soil = weakened(soil, weakening(soil, factor));
    side_.set_soils(soils);
    Bracket found;
    BracketOptions once = options;
    // Another factor close by costs less than another solver, and mostly helps.
    once.fall_back = failures_ > 2;
    constexpr int enough = 120;  // what takes more, twice what most do, ends nowhere
    once.max_iterations = std::min(once.max_iterations, enough);
    side_.attempt(found, once, [&](Attempt attempt) {
      attempt.factor = factor;
      attempts.push_back(attempt);
      if (watch) watch(attempt);
    });
    work_ += side_.work();
    learn(factor, found);
    keep(factor, found);
  }

 private:
  static constexpr int most_failures = 4;  // in a row
  // Soft clay beside sand: what divides the clay's strength to almost nothing, makes the sand's
  // friction so steep that solvers lose themselves in it.
  static constexpr double steep = 70.0 * std::numbers::pi / 180.0;

  [[nodiscard]] static bool is_steep(const problem::Soil& soil, double factor) {
    return std::tan(soil.friction_angle) > factor * std::tan(steep);
  }

  // A stress field of soils that are weaker than they must be is one of theirs.
  [[nodiscard]] double weakening(const problem::Soil& soil, double factor) const {
    if (!is_lower_ || resting_ == Resting::none) return factor;
    return std::max(factor, std::tan(soil.friction_angle) / steepest_);
  }

  [[nodiscard]] bool is_better(double factor, const std::optional<double>& known) const {
    return !known || (is_lower_ ? factor > *known : factor < *known);
  }

  // Whether the mesh has not decided for the last factor tried, and of what it may decide for a
  // better one is known: a finer mesh is wanted.
  [[nodiscard]] bool is_surpassed(double target, double last,
                                  const std::optional<double>& known) const {
    return !is_better(target, last) && !is_better(target, known);
  }

  // Soils that are nowhere at a side that is free to move.
  [[nodiscard]] std::vector<bool> buried() const {
    std::vector<bool> are(problem_.soils.size(), true);
    for (const mesh::Edge& edge : mesh::edges_of(problem_.mesh)) {
      if (edge.boundary < 0) continue;
      const problem::Boundary& side = problem_.boundaries[static_cast<std::size_t>(edge.boundary)];
      const auto& triangle = problem_.mesh.triangles[static_cast<std::size_t>(edge.left)];
      if (side.normal == problem::Known::traction) {
        are[static_cast<std::size_t>(triangle.region)] = false;
      }
    }
    return are;
  }

  // Steep soils that the solver has failed with stay at rest from here on, if anything else moves:
  // first those below others, as strong ground under soft, if it fails again all of them.
  void put_to_rest(double factor) {
    if (!is_lower_ && resting_ == Resting::none && rest(factor, buried())) {
      resting_ = Resting::buried;
    } else if (rest(factor, std::vector<bool>(problem_.soils.size(), true))) {
      resting_ = Resting::all;
    }
  }

  // @param may  whether each soil may be at rest
  // @return whether some are, and others not
  bool rest(double factor, const std::vector<bool>& may) {
    std::vector<bool> rests;
    for (std::size_t i = 0; i < may.size(); ++i) {
      rests.push_back(may[i] && is_steep(problem_.soils[i], factor));
    }
    const auto moves = [&](const mesh::Triangle& triangle) {
      return !rests[static_cast<std::size_t>(triangle.region)];
    };
    const auto& triangles = problem_.mesh.triangles;
    if (std::all_of(triangles.begin(), triangles.end(), moves) ||
        std::none_of(triangles.begin(), triangles.end(), moves)) {
      return false;
    }
    steepest_ = std::tan(steep);
    failures_ = 0;
    if (is_lower_) return true;  // weakened instead
    side_ = Side(problem::with_soils_at_rest(problem_, rests), false, *means_);
    search_ = FactorSearch(factor);
    return true;
  }

  // Away from where a solver has just failed, to the side on which an answer is a bound. Where next
  // to no cohesion makes the multiplier of the loads a matter of all or nothing, solvers fail
  // between the two, and what either side of them decides is all there is to know.
  [[nodiscard]] double next_factor() const {
    constexpr double step = 0.004, share = 0.2;
    const double away = 1.0 + (is_lower_ ? -step : step) * failures_;
    return search_.root_towards(is_lower_, share * failures_) * away;
  }

  // What a solver certified before it failed may be far from the multiplier. But if it decides for
  // this factor there is nothing to go back from; and between a mechanism and the stresses proposed
  // with it lies the multiplier.
  [[nodiscard]] bool is_of_use(const Attempt& attempt) const {
    if (!attempt.certified) return false;
    constexpr double close = 0.01;
    const double bound = *attempt.certified;
    if (is_lower_) return bound >= one_;
    return bound <= one_ || std::abs(bound - attempt.proposed) <= close * bound;
  }

  void learn(double factor, const Bracket& found) {
    const Attempt& last = found.attempts.back();
    const bool is_solved = last.status == solver::SolverStatus::solved ||
                           last.status == solver::SolverStatus::acceptable;
    if (!(is_solved || is_of_use(last)) || !std::isfinite(last.proposed)) {
      ++failures_;
      if (resting_ != Resting::none) steepest_ = std::tan(steep);
      return;
    }
    failures_ = 0;
    if (is_solved) seconds_ = last.seconds, solved_triangles_ = last.triangles;
    constexpr double rounding = 1e-3;
    // Without any cohesion next to nothing may be left at once.
    constexpr double next_to_nothing = 1e-3;
    const double multiplier =
        std::max(last.certified.value_or(last.proposed), next_to_nothing * one_);
    const bool has_no_end = multiplier >= (1.0 - rounding) * most_;
    search_.saw(factor, std::min(multiplier, most_) / one_, has_no_end);
  }

  // As every stress field may be scaled down, a multiplier beyond one decides for one.
  void keep(double factor, const Bracket& found) {
    const bool carries = is_lower_ && found.lower && found.lower_bound() >= one_;
    const bool fails = !is_lower_ && found.upper && found.upper_bound() <= one_;
    if (is_lower_ && !carries && found.lower) enlarge(factor, found);
    if (!carries && !fails) return;
    excess_ = std::abs(std::log((is_lower_ ? found.lower_bound() : found.upper_bound()) / one_));
    if (factor_ && (is_lower_ ? factor <= *factor_ : factor >= *factor_)) return;
    factor_ = factor;
    best_ = found;
  }

  // Enlarged, pressures add to friction's share, which is at the factor that is less in proportion
  // more than that; tensions would take more of it than cohesion gives.
  [[nodiscard]] static bool may_be_enlarged(const problem::Soil& soil) {
    if (soil.is_curved() || soil.variation) return false;
    return soil.friction_angle == 0.0 || soil.is_loose() || soil.tension == 0.0;
  }

  void enlarge(double factor, const Bracket& found) {
    const double share = found.lower_bound() / one_;
    if (!std::ranges::all_of(problem_.soils, may_be_enlarged) || !(factor * share > enlarged_)) {
      return;
    }
    // What is left unbalanced grows with the stresses.
    constexpr double rounding = 1e-10;
    if (!(found.lower->certificate.residual / share < rounding * std::max(1.0, one_))) return;
    enlarged_ = factor * share;
    less_ = found;
    for (auto& stresses : less_.lower->certificate.field) stresses /= share;
    less_.lower->certificate.multiplier = less_.lower->certificate.proposed = one_;
    less_.lower->certificate.residual /= share;
    less_.lower->certificate.yield_excess /= share;
  }

  bool is_lower_;
  const Means* means_;
  problem::Problem problem_;
  double one_;   // the multiplier of the loads as they are, in its unit
  double most_;  // where it is not followed any further, likewise
  Side side_;
  FactorSearch search_;
  std::optional<double> factor_;
  double excess_ = 0.0;  // how far the multiplier is from one where it last decided, as a logarithm
  Bracket best_;
  double enlarged_ = 0.0;
  Bracket less_;  // the same stresses, enlarged
  int failures_ = 0;
  enum class Resting { none, buried, all };
  Resting resting_ = Resting::none;    // which steep soils have been put to rest
  double steepest_ = std::tan(steep);  // tangent of the friction that is left to them
  std::optional<double> settled_;      // where the last mesh's multiplier should be one
  double seconds_ = 0.0;               // of the last solve that ended well
  int solved_triangles_ = 0;           // and of how many
  double gain_ = 0.0;                  // of the last mesh, as a logarithm
  double work_ = 0.0;                  // for it
  double promise_ = std::numeric_limits<double>::infinity();
};

}  // namespace limit::bracket
