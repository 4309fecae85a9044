#include "material/element_test.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <optional>

namespace material {

namespace {

using constitutive::Material;

constexpr double converged = 1e-11;  // of a stress, relative to the largest of the step

Stress trial_of(const Material& material, const State& begin, const Strain& increment) {
  return begin.stress + constitutive::elastic_stress<3>(constitutive::moduli(material), increment);
}

/// Rows whose stress is given.
std::vector<int> rows_of_stress(const Prescription& given) {
  std::vector<int> rows;
  for (int row = 0; row < 6; ++row) {
    if (given.control[static_cast<std::size_t>(row)] == Control::stress) rows.push_back(row);
  }
  return rows;
}

/// One step: the strains that bring the given stresses about, by Newton's method.
class Step {
 public:
  Step(const Material& material, const State& begin, const std::vector<int>& rows,
       const Strain& given_strain, const Stress& wanted)
      : material_(material),
        begin_(begin),
        rows_(rows),
        wanted_(wanted),
        increment_(given_strain),
        scale_(wanted.norm() + begin.stress.norm() +
               trial_of(material, begin, given_strain).norm() +
               std::numeric_limits<double>::min()) {}

  /// Whether the stresses were found.
  bool solve() {
    constexpr int most = 60;
    if (!evaluate(increment_)) return false;
    for (int iteration = 0; iteration < most; ++iteration) {
      if (rest_.norm() <= converged * scale_) return true;
      if (!improve()) return rest_.norm() <= sqrt_of_converged() * scale_;
    }
    return false;
  }

  [[nodiscard]] const Strain& increment() const { return increment_; }
  [[nodiscard]] const State& end() const { return end_; }
  [[nodiscard]] const constitutive::UpdateOutcome& outcome() const { return outcome_; }

 private:
  // Where round-off of a singular tangent ends the search, this is what the stresses are good to.
  static double sqrt_of_converged() { return std::sqrt(converged); }

  bool evaluate(const Strain& increment) {
    const Stress trial = trial_of(material_, begin_, increment);
    State end;
    const constitutive::UpdateOutcome outcome =
        constitutive::update<3>(material_, trial, begin_, end);
    if (outcome.failed) return false;
    Eigen::VectorXd rest(static_cast<Eigen::Index>(rows_.size()));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      rest[static_cast<Eigen::Index>(i)] = end.stress[rows_[i]] - wanted_[rows_[i]];
    }
    increment_ = increment;
    end_ = end;
    outcome_ = outcome;
    rest_ = rest;
    return true;
  }

  /// A Newton step, shortened until the rest falls; false if it does not.
  bool improve() {
    const auto tangent =
        constitutive::tangent<3>(material_, trial_of(material_, begin_, increment_), begin_);
    const auto count = static_cast<Eigen::Index>(rows_.size());
    Eigen::MatrixXd part(count, count);
    for (Eigen::Index i = 0; i < count; ++i) {
      for (Eigen::Index j = 0; j < count; ++j) {
        part(i, j) =
            tangent(rows_[static_cast<std::size_t>(i)], rows_[static_cast<std::size_t>(j)]);
      }
    }
    // On a corner several strains give one stress: the least of them.
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least;
    constexpr double singular = 1e-9;
    least.setThreshold(singular);
    least.compute(part);
    const Eigen::VectorXd move = least.solve(rest_);
    const Strain from = increment_;
    const double before = rest_.norm();
    constexpr int halvings = 12;
    double share = 1.0;
    for (int k = 0; k < halvings; ++k, share /= 2.0) {
      Strain to = from;
      for (std::size_t i = 0; i < rows_.size(); ++i) {
        to[rows_[i]] -= share * move[static_cast<Eigen::Index>(i)];
      }
      const State end = end_;
      const auto outcome = outcome_;
      const Eigen::VectorXd rest = rest_;
      if (evaluate(to) && rest_.norm() < before) return true;
      increment_ = from;
      end_ = end;
      outcome_ = outcome;
      rest_ = rest;
    }
    return false;
  }

  const Material& material_;
  const State& begin_;
  const std::vector<int>& rows_;
  Stress wanted_;
  Strain increment_;
  double scale_;  // [Pa] of the stresses of the step, whatever strains are tried
  State end_;
  constitutive::UpdateOutcome outcome_;
  Eigen::VectorXd rest_;
};

/// The stages one after the other.
class Walk {
 public:
  Walk(const Material& material, const Path& path) : material_(material), path_(path) {
    for (std::size_t i = 0; i < path.initial_stress.size(); ++i) {
      point_.state.stress[static_cast<Eigen::Index>(i)] = path.initial_stress[i];
    }
  }

  Course operator()() {
    // The stress to begin with must be one that the material can have.
    State begin;
    const auto outcome =
        constitutive::update<3>(material_, point_.state.stress, point_.state, begin);
    if (outcome.failed || outcome.plastic) {
      course_.obstacle = "the initial stress is beyond the strength";
      return std::move(course_);
    }
    for (std::size_t i = 0; i < path_.stage.size() && course_.obstacle.empty(); ++i) stage(i);
    return std::move(course_);
  }

 private:
  void stage(std::size_t number) {
    const Stage& stage = path_.stage[number];
    given_ = prescription_of(stage);
    rows_ = rows_of_stress(given_);
    begin_ = point_.state.stress;
    point_.stage = number;
    point_.step = 0;
    course_.points.push_back(point_);
    for (int step = 1; step <= stage.steps; ++step) {
      const double from = (step - 1.0) / stage.steps, to = 1.0 * step / stage.steps;
      point_.step = step;
      if (!advance(from, to, 0)) {
        course_.obstacle = fmt::format(
            "stage {} ends at {:.4g} % of its way: the material cannot have the stress that is "
            "asked for",
            number, 100.0 * reached_);
        return;
      }
      course_.points.push_back(point_);
    }
  }

  /// From one part of the stage to another, in halves if need be.
  bool advance(double from, double to, int depth) {
    constexpr int deepest = 8;
    Strain strain = Strain::Zero();
    Stress wanted = begin_;
    for (Eigen::Index row = 0; row < 6; ++row) {
      const auto r = static_cast<std::size_t>(row);
      if (given_.control[r] == Control::strain) strain[row] = (to - from) * given_.change[r];
      if (given_.control[r] == Control::stress) wanted[row] += to * given_.change[r];
    }
    const State begin = point_.state;
    Step step(material_, begin, rows_, strain, wanted);
    if (step.solve()) {
      point_.strain += step.increment();
      point_.state = step.end();
      point_.plastic = bool(step.outcome().plastic);
      point_.apex = bool(step.outcome().apex);
      const auto tangent =
          constitutive::tangent<3>(material_, trial_of(material_, begin, step.increment()), begin);
      point_.tangent_error = tangent_error(material_, begin, step.increment(), tangent);
      reached_ = to;
      return true;
    }
    if (depth == deepest) {
      reached_ = from;
      return false;
    }
    const double middle = (from + to) / 2.0;
    return advance(from, middle, depth + 1) && advance(middle, to, depth + 1);
  }

  const Material& material_;
  const Path& path_;
  Point point_;
  Prescription given_;
  std::vector<int> rows_;
  Stress begin_ = Stress::Zero();  // of the stage
  double reached_ = 0.0;           // of the stage
  Course course_;
};

}  // namespace

double tangent_error(const Material& material, const State& begin, const Strain& increment,
                     const constitutive::TangentMatrix<3>& tangent) {
  const constitutive::ElasticModuli& moduli = constitutive::moduli(material);
  const double young = 9.0 * moduli.bulk * moduli.shear / (3.0 * moduli.bulk + moduli.shear);
  const Stress trial = trial_of(material, begin, increment);
  // The step is to the stress' own strain what the cube root of round-off is to one: truncation and
  // round-off then are some 1e-10 of the tangent each.
  const double step =
      6e-6 * (trial.norm() / young + increment.norm() + std::numeric_limits<double>::min());
  State base;
  if (constitutive::update<3>(material, trial, begin, base).failed) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  double worst = 0.0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    const auto moved = [&](double by) {
      Strain to = increment;
      to[row] += by;
      State end;
      (void)constitutive::update<3>(material, trial_of(material, begin, to), begin, end);
      return end.stress;
    };
    const Stress forward = (moved(step) - base.stress) / step;
    const Stress backward = (base.stress - moved(-step)) / step;
    // Curvature makes them differ by some 1e-5 of the tangent, a corner by parts of one.
    constexpr double corner = 1e-3;
    if ((forward - backward).norm() > corner * young) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const Stress column = tangent.col(row);
    worst = std::max(worst, ((forward + backward) / 2.0 - column).norm() / young);
  }
  return worst;
}

Course follow(const Material& material, const Path& path) {
  return Walk(material, path)();
}

}  // namespace material
