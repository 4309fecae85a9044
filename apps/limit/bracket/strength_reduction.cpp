#include "limit/bracket/strength_reduction.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "limit/bracket/block_factor.hpp"
#include "limit/bracket/factor_search.hpp"
#include "limit/bracket/side.hpp"
#include "limit/problem/at_rest.hpp"

namespace limit::bracket {

namespace {

// Where the search begins, near enough for slopes: friction against the mean inclination of what is
// free, and Taylor's stability number, between 4 and 6 for most faces. One, if there is no face.
double estimate(const problem::Problem& problem, double one) {
  double low = std::numeric_limits<double>::infinity(), high = -low, rise = 0.0, run = 0.0;
  const auto& nodes = problem.mesh.nodes;
  for (const mesh::BoundaryEdge& edge : problem.mesh.boundary) {
    const problem::Boundary& side = problem.boundaries[static_cast<std::size_t>(edge.boundary)];
    if (side.normal != problem::Known::traction) continue;
    const mesh::Point &a = nodes[static_cast<std::size_t>(edge.first)],
                      &b = nodes[static_cast<std::size_t>(edge.second)];
    low = std::min({low, a.y(), b.y()});
    high = std::max({high, a.y(), b.y()});
    constexpr double level = 0.05;
    if (std::abs(b.y() - a.y()) <= level * std::abs(b.x() - a.x())) continue;
    rise += std::abs(b.y() - a.y());
    run += std::abs(b.x() - a.x());
  }
  double area = 0.0, cohesion = 0.0, friction = 0.0, weight = 0.0;
  for (const mesh::Triangle& triangle : problem.mesh.triangles) {
    const problem::Soil& soil = problem.soils[static_cast<std::size_t>(triangle.region)];
    const double here = mesh::twice_area(problem.mesh, triangle);
    area += here;
    cohesion += here * soil.cohesion;
    friction += here * std::tan(soil.friction_angle);
    weight += here * one * soil.live_unit_weight;
  }
  constexpr double stability = 5.0;
  const double factor =
      friction / area * run / rise + stability * cohesion / (weight * (high - low));
  return std::isfinite(factor) && factor > 0.0 ? std::clamp(factor, 1e-3, 1e3) : 1.0;
}

/// One bound of the factor.
class Flank {
 public:
  Flank(const problem::Problem& problem, bool is_lower, double one, const Means& means)
      : is_lower_(is_lower),
        means_(means),
        problem_(problem),
        one_(one),
        most_(problem.most_multiplier.value()),
        side_(problem, is_lower, means),
        search_(estimate(problem, one)) {}

  /// The best one certified so far.
  [[nodiscard]] const std::optional<double>& factor() const { return factor_; }
  [[nodiscard]] int triangles() const { return side_.triangles(); }
  [[nodiscard]] bool can_refine() const { return side_.can_refine() && failures_ < most_failures; }
  /// Whether soils would be put to rest if a solver failed at a factor.
  [[nodiscard]] bool may_rest(double factor) const {
    const auto steep_there = [&](const problem::Soil& soil) { return is_steep(soil, factor); };
    return !rests_ && std::any_of(problem_.soils.begin(), problem_.soils.end(), steep_there);
  }
  /// Gain of the last mesh for its work; infinite as long as it is not known.
  [[nodiscard]] double promise() const { return promise_; }
  /// @param reach  how far off it may be, as a factor
  void start_from(double factor, double reach) { search_ = FactorSearch(factor, reach); }

  /// With the best fields so far.
  void give(Bracket& bracket) const {
    if (best_.lower) bracket.lower = best_.lower;
    if (best_.upper) bracket.upper = best_.upper;
  }

  /// Finds the factor at which this mesh's bound of the multiplier is one.
  /// @param nearness  -> how closely, as a share of it
  /// @param solve     (*this, factor) -> whether to go on
  template <class Nearness, class Solve>
  void settle(const Nearness& nearness, const Solve& solve) {
    const std::optional<double> before = settled_;
    work_ = 0.0;
    constexpr int most_steps = 16;
    for (int step = 0; step < most_steps && failures_ < most_failures; ++step) {
      const double near = nearness();
      // To the side on which the certificate decides, by less than what is asked for.
      const double target = next_factor() * std::exp((is_lower_ ? -0.25 : 0.25) * near);
      const bool is_near = factor_ && std::abs(std::log(target / *factor_)) < near;
      // A multiplier that is far from one says that there is more to come, where it falls off.
      constexpr double steep_enough = 4.0;
      if (is_near && step > 0 && excess_ < steep_enough * near) break;
      if (factor_ && 2.0 * search_.width() < near && is_near) break;
      if (!solve(*this, target)) break;
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
    if (failures_ > 0 && !rests_) put_to_rest(factor);
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
    if (!is_lower_ || !rests_) return factor;
    return std::max(factor, std::tan(soil.friction_angle) / steepest_);
  }

  // Steep soils that the solver has failed with stay at rest from here on, if anything else moves.
  void put_to_rest(double factor) {
    std::vector<bool> rests;
    for (const problem::Soil& soil : problem_.soils) rests.push_back(is_steep(soil, factor));
    const auto moves = [&](const mesh::Triangle& triangle) {
      return !rests[static_cast<std::size_t>(triangle.region)];
    };
    const auto& triangles = problem_.mesh.triangles;
    if (std::all_of(triangles.begin(), triangles.end(), moves) ||
        std::none_of(triangles.begin(), triangles.end(), moves)) {
      return;
    }
    rests_ = true;
    steepest_ = std::tan(steep);
    failures_ = 0;
    if (is_lower_) return;  // weakened instead
    side_ = Side(problem::with_soils_at_rest(problem_, rests), false, means_);
    search_ = FactorSearch(factor);
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
      if (rests_) steepest_ = std::tan(steep);
      return;
    }
    failures_ = 0;
    constexpr double rounding = 1e-3;
    const double multiplier = last.certified.value_or(last.proposed);
    const bool has_no_end = multiplier >= (1.0 - rounding) * most_;
    search_.saw(factor, std::min(multiplier, most_) / one_, has_no_end);
  }

  // As every stress field may be scaled down, a multiplier beyond one decides for one.
  void keep(double factor, const Bracket& found) {
    const bool carries = is_lower_ && found.lower && found.lower_bound() >= one_;
    const bool fails = !is_lower_ && found.upper && found.upper_bound() <= one_;
    if (!carries && !fails) return;
    excess_ = std::abs(std::log((is_lower_ ? found.lower_bound() : found.upper_bound()) / one_));
    if (factor_ && (is_lower_ ? factor <= *factor_ : factor >= *factor_)) return;
    factor_ = factor;
    best_ = found;
  }

  bool is_lower_;
  const Means& means_;
  problem::Problem problem_;
  double one_;   // the multiplier of the loads as they are, in its unit
  double most_;  // where it is not followed any further, likewise
  Side side_;
  FactorSearch search_;
  std::optional<double> factor_;
  double excess_ = 0.0;  // how far the multiplier is from one where it last decided, as a logarithm
  Bracket best_;
  int failures_ = 0;
  bool rests_ = false;                 // whether soils have been put to rest
  double steepest_ = std::tan(steep);  // tangent of the friction that is left to them
  std::optional<double> settled_;      // where the last mesh's multiplier should be one
  double gain_ = 0.0;                  // of the last mesh, as a logarithm
  double work_ = 0.0;                  // for it
  double promise_ = std::numeric_limits<double>::infinity();
};

class Reduction {
 public:
  Reduction(const problem::Case& problem, const BracketOptions& options,
            const std::function<void(const Attempt&)>& watch, const Means& means)
      : options_(options),
        watch_(watch),
        means_(means),
        began_(means.seconds()),
        below_(problem::in_units(problem.lower, problem.units), true,
               1.0 / problem.units.multiplier(), means),
        above_(problem::in_units(problem.upper, problem.units), false,
               1.0 / problem.units.multiplier(), means),
        scaled_(problem::in_units(problem.upper, problem.units)),
        case_(problem) {}

  Solution solution() {
    if (!(case_.known_lower && case_.known_upper)) search();
    result_.lower = larger(below_.factor(), case_.known_lower);
    result_.upper = smaller(upper(), case_.known_upper);
    if (result_.block && result_.upper && result_.block->factor > *result_.upper) {
      result_.block.reset();
    }
    below_.give(result_.bracket);
    above_.give(result_.bracket);
    result_.bracket.reached = result_.gap() <= options_.gap;
    return std::move(result_);
  }

 private:
  static std::optional<double> larger(const std::optional<double>& a,
                                      const std::optional<double>& b) {
    return a && b ? std::max(*a, *b) : a ? a : b;
  }
  static std::optional<double> smaller(const std::optional<double>& a,
                                       const std::optional<double>& b) {
    return a && b ? std::min(*a, *b) : a ? a : b;
  }

  void search() {
    look_for_block();
    if (!result_.block) settle(above_);
    if (upper()) below_.start_from(*upper(), close);
    if (case_.has_lower) settle(below_);
    // A block that is not the right mechanism at all. It mostly is, closer than a mesh can be.
    constexpr double far = 0.1;
    if (result_.block && (gap() > far || !case_.has_lower)) begin_above();
    while (case_.has_lower && gap() > options_.gap && remaining() > 0.0) {
      if (result_.block && !has_begun_above_ && below_.triangles() > most_without_above) {
        begin_above();
        continue;
      }
      Flank* next = next_to_refine();
      if (next == nullptr) break;
      next->refine(gap() / options_.gap);
      settle(*next);
    }
    if (options_.wants_mechanism && !above_.factor()) begin_above();
  }

  void look_for_block() {
    constexpr double share = 0.15;  // of the time
    const double one = 1.0 / case_.units.multiplier();
    result_.block =
        block_factor(scaled_, one, estimate(scaled_, one), share * options_.max_seconds, means_);
  }

  // Between what is known: at the block's own factor, only the block is to be found again.
  void begin_above() {
    has_begun_above_ = true;
    if (upper()) {
      const double below = below_.factor().value_or(*upper());
      above_.start_from(std::sqrt(*upper() * below), std::max(close, std::sqrt(*upper() / below)));
    }
    settle(above_);
  }

  [[nodiscard]] double remaining() const {
    return options_.max_seconds - (means_.seconds() - began_);
  }
  [[nodiscard]] std::optional<double> upper() const {
    std::optional<double> least = above_.factor();
    if (result_.block)
      least = std::min(least.value_or(result_.block->factor), result_.block->factor);
    return least;
  }
  [[nodiscard]] double gap() const {
    if (!below_.factor() || !upper()) return std::numeric_limits<double>::infinity();
    return 2.0 * (*upper() - *below_.factor()) / (*upper() + *below_.factor());
  }

  Flank* next_to_refine() {
    Flank* next = nullptr;
    for (Flank* flank : {&below_, &above_}) {
      if (result_.block && !has_begun_above_ && flank == &above_) continue;
      if (!flank->can_refine() || flank->triangles() >= options_.max_triangles) continue;
      if (next == nullptr || flank->promise() > next->promise()) next = flank;
    }
    return next;
  }

  // Not to more than is of use: the mesh may be what is far off.
  [[nodiscard]] double nearness() const {
    constexpr double of_wanted = 0.2, of_gap = 0.15, roughly = 0.03, most = 0.1;
    const double known = std::isfinite(gap()) ? std::min(of_gap * gap(), most) : roughly;
    return std::max(of_wanted * options_.gap, known);
  }

  // As a share of the multiplier, which the factor follows at most in proportion.
  [[nodiscard]] double solver_gap() const {
    constexpr double share = 0.02;
    return share * nearness();
  }

  void settle(Flank& flank) {
    const auto solve = [&](Flank& of, double factor) {
      if (remaining() <= 0.0) return false;
      BracketOptions rest = options_;
      // What takes more than a good share of it ends nowhere, and another factor might, or, sooner,
      // the same one with steep soils at rest.
      constexpr double share = 0.3, before_rest = 0.1;
      rest.max_seconds =
          std::min(remaining(), (of.may_rest(factor) ? before_rest : share) * options_.max_seconds);
      rest.solver_gap = solver_gap();
      of.solve_at(factor, rest, watch_, result_.bracket.attempts);
      return gap() > options_.gap || !of.factor();
    };
    flank.settle([this] { return nearness(); }, solve);
  }

  const BracketOptions& options_;
  const std::function<void(const Attempt&)>& watch_;
  const Means& means_;
  double began_;
  Flank below_, above_;
  problem::Problem scaled_;
  const problem::Case& case_;
  Solution result_;
  // What stresses and mechanisms come to, mostly.
  static constexpr double close = 1.05;
  // With a block for a bound, mechanisms of a mesh are sought only where stresses do not come near.
  static constexpr int most_without_above = 5000;
  bool has_begun_above_ = false;
};

}  // namespace

Solution reduce_strength(const problem::Case& problem, const BracketOptions& options,
                         const std::function<void(const Attempt&)>& watch, const Means& means) {
  for (const problem::Soil& soil : problem.lower.soils) {
    if (soil.unit_weight != 0.0 || !soil.seepage.isZero(0.0) || !problem.lower.most_multiplier) {
      throw std::invalid_argument("strength reduction: not all loads are live, or without end");
    }
  }
  return Reduction(problem, options, watch, means).solution();
}

}  // namespace limit::bracket
