#include "limit/solver/interior_point.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <utility>

#include "limit/solver/cone_system.hpp"

namespace limit::solver {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using second_order_cone::Scaling;

namespace {

using Cones = std::vector<Vector3d>;

// Residuals, relative to an objective of order one, that count as none when the descent begins, and
// what rounding may make of them on the way; certificates mend that much.
constexpr double none = 1e-9, little = 1e-8;
// Where no multipliers well inside are wanted, the descent takes away so much of them, too, each
// step as much as its length, as long as steps are no shorter than this.
constexpr double rough = 1e-3, stuck = 0.1;

// Where centring crawls though the equations hold, the multipliers it has to reach, which grow with
// the load, are far above those of the start: it begins anew with more, at most with so many.
constexpr double crawl = 0.05, more = 100.0, most = 1e4;

struct Steps {
  double primal, dual;
};

double largest_step(const Cones& at, const Cones& direction) {
  double step = INFINITY;
  for (std::size_t k = 0; k < at.size(); ++k) {
    step = std::min(step, second_order_cone::largest_step(at[k], direction[k]));
  }
  return step;
}

// Short of the boundary; well short of it while centring, or it does not end: from a point by the
// boundary Newton's direction to the centre leads across it again.
double damped(double largest, bool centres) {
  constexpr double close = 0.98, far = 0.7;
  if (close * largest >= 1.0) return 1.0;
  return (centres ? far : close) * largest;
}

/// Minimises cost' x, equations x = right_side, with the slack u = (strength, 0, 0) - G (p, d, t)
/// of every cone in the second-order cone (slack_form). With multipliers y of the equations and z
/// of the cones: cost + equations' y + G' z = 0, u and z in their cones, u'z = 0 in the end.
class InteriorPoint {
 public:
  /// @param acceptable  duality gap, as a share of the objective, to end at if it must
  /// @param rough       residuals with which the descent may begin, to be taken away on it
  InteriorPoint(const ScaledProgram& program, double acceptable, double rough)
      : program_(program), system_(program), acceptable_(acceptable), rough_(rough) {
    begin(1.0);
  }

  [[nodiscard]] const VectorXd& variables() const { return x_; }
  [[nodiscard]] const VectorXd& multipliers() const { return y_; }
  [[nodiscard]] double gap() const { return gap_; }
  [[nodiscard]] double work() const { return system_.work(); }
  [[nodiscard]] double scale() const { return std::max(1.0, std::abs(program_.cost.dot(x_))); }
  /// Whether both kinds of equations have held, and still do but for rounding.
  [[nodiscard]] bool is_feasible() const { return was_feasible_ && holds(little); }

  /// Whether the equations hold well enough to go down.
  [[nodiscard]] bool descends() const { return is_feasible() || holds(rough_); }

  /// One iteration; nothing, with all as it was, if no step could be made.
  [[nodiscard]] bool advance() {
    if (!factorise()) return false;
    const bool centres = !descends() || (is_stuck_ && !is_feasible());
    Direction way = centres ? direction(1.0, complementarity(1.0)) : predicted_and_corrected();
    const Steps steps{damped(largest_step(slacks_, way.slacks), centres),
                      damped(largest_step(z_, way.z), centres)};
    if (centres && crawls(steps) && begun_with_ < most) {
      begin(more * begun_with_);
      return true;
    }
    if (!(std::max(steps.primal, steps.dual) > 1e-6)) return false;
    const InteriorPoint::State before{x_, y_, z_};
    const double off_before = off_equations_.lpNorm<Eigen::Infinity>();
    x_ += steps.primal * way.x;
    y_ += steps.dual * way.y;
    for (std::size_t k = 0; k < z_.size(); ++k) z_[k] += steps.dual * way.z[k];
    update();
    // Of a whole step nothing is left but what the system could not solve.
    constexpr double hardly = 0.1;
    must_hold_ = steps.primal >= 1.0 && !equations_hold(none) &&
                 off_equations_.lpNorm<Eigen::Infinity>() > hardly * off_before;
    is_stuck_ = std::min(steps.primal, steps.dual) < stuck;
    if (is_inside() && (is_feasible() || !was_feasible_)) return true;
    std::tie(x_, y_, z_) = std::tie(before.x, before.y, before.z);
    update();
    return false;
  }

 private:
  struct State {
    VectorXd x, y;
    Cones z;
  };
  struct Direction {
    VectorXd x, y;
    Cones slacks, z;
  };

  [[nodiscard]] Vector3d form(std::size_t k) const { return slack_form(program_.cones[k]); }
  static Vector3d part(const VectorXd& x, std::size_t k) {
    return x.segment<3>(static_cast<Index>(3 * k));
  }

  [[nodiscard]] bool equations_hold(double residual) const {
    return off_equations_.lpNorm<Eigen::Infinity>() < residual * scale();
  }

  [[nodiscard]] bool holds(double residual) const {
    return equations_hold(residual) && off_multipliers_.lpNorm<Eigen::Infinity>() < residual;
  }

  [[nodiscard]] bool crawls(const Steps& steps) const {
    return std::max(steps.primal, steps.dual) < crawl && equations_hold(none);
  }

  // At the program's start, all cones' multipliers of this size.
  void begin(double size) {
    begun_with_ = size;
    was_feasible_ = false;
    x_ = program_.start;
    y_ = VectorXd::Zero(program_.equations.rows());
    z_.assign(program_.cones.size(), size * Vector3d::UnitX());
    update();
  }

  void update() {
    const std::size_t cones = z_.size();
    slacks_.resize(cones);
    off_equations_ = program_.equations * x_ - program_.right_side;
    off_multipliers_ = program_.cost + program_.equations.transpose() * y_;
    gap_ = 0.0;
    for (std::size_t k = 0; k < cones; ++k) {
      slacks_[k] = -form(k).cwiseProduct(part(x_, k));
      slacks_[k][0] += program_.cones[k].strength;
      off_multipliers_.segment<3>(static_cast<Index>(3 * k)) += form(k).cwiseProduct(z_[k]);
      gap_ += slacks_[k].dot(z_[k]);
    }
    was_feasible_ = was_feasible_ || holds(none);
  }

  [[nodiscard]] bool is_inside() const {
    const auto inside = [](const Vector3d& u) {
      return u[0] > 0.0 && second_order_cone::determinant(u) > 0.0;
    };
    return std::isfinite(gap_) && std::all_of(slacks_.begin(), slacks_.end(), inside) &&
           std::all_of(z_.begin(), z_.end(), inside);
  }

  [[nodiscard]] bool factorise() {
    scalings_.clear();
    for (std::size_t k = 0; k < z_.size(); ++k) scalings_.emplace_back(slacks_[k], z_[k]);
    return system_.factorise(scalings_);
  }

  [[nodiscard]] double mean_gap() const { return gap_ / static_cast<double>(z_.size()); }

  // What W dz + W^-1 du, times the scaling point, must be to bring every cone's u'z to `share` of
  // the mean.
  [[nodiscard]] Cones complementarity(double share) const {
    Cones wanted(z_.size());
    for (std::size_t k = 0; k < z_.size(); ++k) {
      wanted[k] = -second_order_cone::product(scalings_[k].point, scalings_[k].point);
      wanted[k][0] += share * mean_gap();
    }
    return wanted;
  }

  // Newton's direction that takes `share` of the residuals away.
  [[nodiscard]] Direction direction(double share, const Cones& wanted) {
    const std::size_t cones = z_.size();
    Cones fixed(cones);
    VectorXd first = -share * off_multipliers_;
    for (std::size_t k = 0; k < cones; ++k) {
      fixed[k] =
          scalings_[k].inverse_times(second_order_cone::quotient(wanted[k], scalings_[k].point));
      first.segment<3>(static_cast<Index>(3 * k)) -= form(k).cwiseProduct(fixed[k]);
    }
    // While centring, what a direction lacks is left to the next, unless that gets nowhere.
    ConeSystem::Solution solution =
        system_.solve(first, -share * off_equations_, is_feasible() || must_hold_);
    Direction way{std::move(solution.x), std::move(solution.y), Cones(cones), Cones(cones)};
    const VectorXd strain = share * off_multipliers_ + program_.equations.transpose() * way.y;
    for (std::size_t k = 0; k < cones; ++k) {
      way.slacks[k] = -form(k).cwiseProduct(part(way.x, k));
      // From the multipliers of the equations, where these determine it: what rounding there is
      // then harms the complementarity, which the next iteration mends, not the flow rule.
      const Vector3d flow = -part(strain, k);
      way.z[k] = fixed[k] - scalings_[k].inverse_squared() * way.slacks[k];
      way.z[k].tail<2>() = flow.tail<2>();
      if (const double slope = program_.cones[k].slope; slope > 0.0) way.z[k][0] = flow[0] / slope;
    }
    return way;
  }

  [[nodiscard]] Direction predicted_and_corrected() {
    const Direction guess = direction(1.0, complementarity(0.0));
    const Steps steps{std::min(1.0, largest_step(slacks_, guess.slacks)),
                      std::min(1.0, largest_step(z_, guess.z))};
    double gap = 0.0;
    for (std::size_t k = 0; k < z_.size(); ++k) {
      gap += (slacks_[k] + steps.primal * guess.slacks[k]).dot(z_[k] + steps.dual * guess.z[k]);
    }
    double share = std::clamp(std::pow(gap / gap_, 3.0), 1e-6, 1.0);
    if (std::min(steps.primal, steps.dual) < 0.1) share = std::max(share, 0.3);
    Cones wanted = complementarity(share);
    for (std::size_t k = 0; k < z_.size(); ++k) {
      wanted[k] -= second_order_cone::product(scalings_[k].inverse_times(guess.slacks[k]),
                                              scalings_[k].times(guess.z[k]));
    }
    return direction(1.0 - share, wanted);
  }

  const ScaledProgram& program_;
  ConeSystem system_;
  double acceptable_, rough_;
  VectorXd x_, y_;
  Cones z_, slacks_;
  VectorXd off_equations_, off_multipliers_;
  double gap_ = 0.0;
  double begun_with_ = 0.0;
  bool was_feasible_ = false;
  bool must_hold_ = false;  // the equations after each direction, to rounding
  bool is_stuck_ = false;   // the last step was a short one
  std::vector<Scaling> scalings_;
};

}  // namespace

ConeSolution solve_by_interior_point(const programme::ConeProgram& program,
                                     const SolverOptions& options) {
  const ScaledProgram scaled(program);
  const double acceptable = std::max(1e-3, options.cone_gap);
  InteriorPoint point(scaled, acceptable, options.wants_interior ? none : rough);
  ConeSolution solution;
  const std::clock_t began = std::clock();
  const auto seconds = [&] { return static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC; };
  const auto is_within = [&](double share) {
    return point.is_feasible() && point.gap() <= share * point.scale();
  };
  for (;; ++solution.iterations) {
    if (solution.interior_multipliers.size() == 0 && point.is_feasible()) {
      solution.interior_multipliers = scaled.multipliers(point.multipliers());
    }
    if (is_within(options.cone_gap)) {
      solution.status = SolverStatus::solved;
      solution.message = "solved";
    } else if (solution.iterations >= options.max_iterations) {
      solution.status = SolverStatus::capped;
      solution.message = "iteration limit";
    } else if (seconds() > options.max_seconds) {
      solution.status = SolverStatus::timed_out;
      solution.message = "time limit";
    } else if (point.advance()) {
      continue;
    } else {
      const bool is_close = is_within(acceptable);
      solution.status = is_close ? SolverStatus::acceptable : SolverStatus::failed;
      solution.message =
          is_close ? "acceptable, no further step for rounding" : "no further step for rounding";
    }
    break;
  }
  solution.variables = scaled.variables(point.variables());
  solution.multipliers = scaled.multipliers(point.multipliers());
  solution.work = point.work();
  return solution;
}

}  // namespace limit::solver
