#include "limit/bracket/strength_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "limit/bracket/block_factor.hpp"
#include "limit/bracket/flank.hpp"

namespace limit::bracket {

namespace {

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
    result_.lower = larger(lower(), below_.enlarged_factor());
    result_.upper = upper();
    if (result_.block && result_.upper && result_.block->factor > *result_.upper) {
      result_.block.reset();
    }
    below_.give(result_.bracket);
    above_.give(result_.bracket);
    if (rough_ && rough_->factor() && rough_->factor() == result_.upper) {
      rough_->give(result_.bracket);
    }
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
    const bool is_known = upper().has_value();
    look_roughly();
    if (!is_known) settle(above_);
    if (upper()) below_.start_from(*upper(), close);
    settle(below_);
    // A block that is not the right mechanism at all. It mostly is, closer than a mesh can be; a
    // skin often is not.
    constexpr double far = 0.1;
    if (waits_above() && gap() > (result_.block ? far : options_.gap)) begin_above();
    try_long(below_, case_.lower, case_.long_lower, far);
    try_long(above_, case_.upper, case_.long_upper, far);
    while (gap() > options_.gap && remaining() > 0.0) {
      if (waits_above() && below_.triangles() > most_without_above) {
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

  // Meshes of long triangles instead of the first one, where steep soils may need them: if one
  // decides for a better factor at once.
  void try_long(Flank& flank, problem::Problem problem, const std::vector<mesh::Mesh>& meshes,
                double far) {
    const bool is_lower = &flank == &below_;
    for (const mesh::Mesh& mesh : meshes) {
      const std::optional<double> known = is_lower ? below_.factor() : upper();
      if (!known || gap() <= far || !flank.is_steep_at(*known) || remaining() <= 0.0) return;
      problem.mesh = mesh;
      Flank other(problem::in_units(problem, case_.units), is_lower, 1.0 / case_.units.multiplier(),
                  means_);
      const double better = is_lower ? close * *known : *known / close;
      other.rest_as(flank, better);
      static_cast<void>(solve(other, better));
      if (!other.factor()) continue;
      flank = std::move(other);
      settle(flank);
    }
  }

  void look_for_block() {
    constexpr double share = 0.15;  // of the time
    const double one = 1.0 / case_.units.multiplier();
    result_.block = block_factor(scaled_, one, estimated_factor(scaled_, one),
                                 share * options_.max_seconds, means_);
  }

  // How far the factor is, on a mesh whose solves cost next to nothing. Of soils in layers neither
  // their means nor blocks say that.
  void look_roughly() {
    if (case_.rough_upper.triangles.empty()) return;
    problem::Problem problem = case_.upper;
    problem.mesh = case_.rough_upper;
    rough_.emplace(problem::in_units(problem, case_.units), false, 1.0 / case_.units.multiplier(),
                   means_);
    settle(*rough_);
    if (!rough_->factor()) return;
    const double expected = *rough_->factor() / worse;
    above_.start_from(expected, worse);
    above_.rest_as(*rough_, expected);
  }

  // Between what is known: at the block's own factor, only the block is to be found again.
  void begin_above() {
    has_begun_above_ = true;
    if (upper()) {
      const double below = below_.factor().value_or(*upper());
      const double middle = std::sqrt(*upper() * below);
      // Of a mesh's own mechanism a finer one improves a little; far below it solvers lose
      // themselves in soils that are steep there.
      const bool is_rough = rough_ && rough_->factor() == upper();
      const double first = is_rough ? std::max(middle, *upper() / worse) : middle;
      above_.start_from(first, std::max(close, *upper() / first));
    }
    settle(above_);
  }

  [[nodiscard]] double remaining() const {
    return options_.max_seconds - (means_.seconds() - began_);
  }
  [[nodiscard]] std::optional<double> lower() const {
    return larger(below_.factor(), case_.known_lower);
  }
  [[nodiscard]] std::optional<double> upper() const {
    std::optional<double> least = smaller(above_.factor(), case_.known_upper);
    if (rough_) least = smaller(least, rough_->factor());
    if (result_.block) least = smaller(least, result_.block->factor);
    return least;
  }
  // Whether a mechanism that is no mesh's has spared the search for others so far.
  [[nodiscard]] bool waits_above() const {
    return (result_.block || case_.known_upper) && !has_begun_above_;
  }
  [[nodiscard]] double gap() const {
    if (!lower() || !upper()) return std::numeric_limits<double>::infinity();
    return 2.0 * (*upper() - *lower()) / (*upper() + *lower());
  }

  Flank* next_to_refine() {
    Flank* next = nullptr;
    for (Flank* flank : {&below_, &above_}) {
      if (waits_above() && flank == &above_) continue;
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

  // @return whether to go on
  [[nodiscard]] bool solve(Flank& flank, double factor) {
    if (remaining() <= 0.0) return false;
    BracketOptions rest = options_;
    // What takes more than a good share of it ends nowhere, and another factor might, or, sooner,
    // the same one with steep soils at rest, unless such solves have ended well so far.
    constexpr double share = 0.3, before_rest = 0.1, patience = 2.0, roughly = 0.05;
    const bool is_rough = rough_ && &flank == &*rough_;
    const double least = is_rough ? roughly : flank.may_rest(factor) ? before_rest : share;
    const double seconds = std::clamp(patience * flank.expected_seconds(),
                                      least * options_.max_seconds, share * options_.max_seconds);
    rest.max_seconds = std::min(remaining(), seconds);
    constexpr int enough = 50;  // more than what ends well takes on few triangles
    if (is_rough) rest.max_iterations = std::min(rest.max_iterations, enough);
    rest.solver_gap = solver_gap();
    flank.solve_at(factor, rest, watch_, result_.bracket.attempts);
    return gap() > options_.gap || !flank.factor();
  }

  void settle(Flank& flank) {
    const bool is_lower = &flank == &below_;
    // A mechanism that is to be shown is one of the mesh, whatever else is known.
    const auto known = [&] {
      return is_lower ? lower() : options_.wants_mechanism ? flank.factor() : upper();
    };
    flank.settle([this] { return nearness(); }, known,
                 [this](Flank& of, double factor) { return solve(of, factor); });
  }

  const BracketOptions& options_;
  const std::function<void(const Attempt&)>& watch_;
  const Means& means_;
  double began_;
  Flank below_, above_;
  std::optional<Flank> rough_;
  problem::Problem scaled_;
  const problem::Case& case_;
  Solution result_;
  // What stresses and mechanisms come to, mostly.
  static constexpr double close = 1.05;
  static constexpr double worse = 1.1;  // a mesh of few triangles than a finer one, mostly
  // With a block for a bound, mechanisms of a mesh are sought only where stresses do not come near.
  static constexpr int most_without_above = 5000;
  bool has_begun_above_ = false;
};

}  // namespace

Solution reduce_strength(const problem::Case& problem, const BracketOptions& options,
                         const std::function<void(const Attempt&)>& watch, const Means& means) {
  if (problem.lower.pore_pressure && !problem.lower.pressure_is_live) {
    throw std::invalid_argument("strength reduction: not all loads are live");
  }
  for (const problem::Soil& soil : problem.lower.soils) {
    if (soil.unit_weight != 0.0 || !soil.seepage.isZero(0.0) || !problem.lower.most_multiplier) {
      throw std::invalid_argument("strength reduction: not all loads are live, or without end");
    }
  }
  return Reduction(problem, options, watch, means).solution();
}

}  // namespace limit::bracket
