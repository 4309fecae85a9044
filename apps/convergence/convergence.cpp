#include "convergence/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace convergence {

namespace {

constexpr double lowest_order = 0.5;  // below it, what the fit says is no limit
constexpr double safe = 1.25;         // factors of safety of the grid convergence index:
constexpr double cautious = 3.0;      // where the order is observed, and where it is not
constexpr double least_order = 0.02;  // of the search
constexpr double largest_order = 12.0;
constexpr double round_off = 1e-13;  // of a value, many operations deep

/// value = limit + slope size^order by least squares.
struct Fit {
  double order = 0.0;
  double limit = 0.0;
  double slope = 0.0;
  double squares = 0.0;  // of what is left
};

Fit fit_of(const std::vector<Sample>& samples, double order) {
  // Sizes over the largest: no power of them overflows.
  const double unit = samples.back().size;
  const auto count = static_cast<double>(samples.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (const Sample& sample : samples) {
    mean_x += std::pow(sample.size / unit, order) / count;
    mean_y += sample.value / count;
  }
  double xx = 0.0, xy = 0.0;
  for (const Sample& sample : samples) {
    const double x = std::pow(sample.size / unit, order) - mean_x;
    xx += x * x;
    xy += x * (sample.value - mean_y);
  }
  Fit fit{order, 0.0, xy / xx, 0.0};
  fit.limit = mean_y - fit.slope * mean_x;
  for (const Sample& sample : samples) {
    const double left = sample.value - fit.limit - fit.slope * std::pow(sample.size / unit, order);
    fit.squares += left * left;
  }
  return fit;
}

/// The best fit over all orders: a scan, and a search by thirds around its best.
Fit best_fit(const std::vector<Sample>& samples) {
  constexpr double stride = 0.02;
  Fit best = fit_of(samples, least_order);
  for (double order = least_order; order <= largest_order; order += stride) {
    const Fit fit = fit_of(samples, order);
    if (fit.squares < best.squares) best = fit;
  }
  double low = std::max(best.order - stride, least_order / 2.0), high = best.order + stride;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double third = (high - low) / 3.0;
    const bool left = fit_of(samples, low + third).squares < fit_of(samples, high - third).squares;
    (left ? high : low) = left ? high - third : low + third;
  }
  return fit_of(samples, (low + high) / 2.0);
}

/// Standard error of the order, from the scatter about the fit and its curvature.
std::optional<double> order_error_of(const std::vector<Sample>& samples, const Fit& fit) {
  constexpr std::size_t unknowns = 3;
  if (samples.size() <= unknowns) return std::nullopt;
  const double variance = fit.squares / static_cast<double>(samples.size() - unknowns);
  // The sum of squares, the other two unknowns at their best, rises by the variance at one
  // standard error from its least.
  constexpr double step = 1e-3;
  const double curvature = (fit_of(samples, fit.order + step).squares - 2.0 * fit.squares +
                            fit_of(samples, fit.order - step).squares) /
                           (step * step);
  if (!(curvature > 0.0)) return std::nullopt;
  return std::sqrt(2.0 * variance / curvature);
}

void check(const std::vector<Sample>& samples) {
  if (samples.size() < 2) throw std::invalid_argument("extrapolate: fewer than two samples");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const Sample& sample = samples[i];
    if (!(sample.size > 0.0) || !std::isfinite(sample.size) || !std::isfinite(sample.value)) {
      throw std::invalid_argument("extrapolate: a size that is not > 0, or no finite value");
    }
    if (i > 0 && sample.size == samples[i - 1].size) {
      throw std::invalid_argument("extrapolate: two samples of one size");
    }
  }
}

double range_of(const std::vector<Sample>& samples) {
  const std::size_t finest = std::min<std::size_t>(3, samples.size());
  double low = samples[0].value, high = samples[0].value;
  for (std::size_t i = 1; i < finest; ++i) {
    low = std::min(low, samples[i].value);
    high = std::max(high, samples[i].value);
  }
  return high - low;
}

Extrapolation of_two(const std::vector<Sample>& samples, double formal) {
  const Fit fit = fit_of(samples, formal);
  const double distance = std::abs(samples[0].value - fit.limit);
  return {Course::two, fit.limit, cautious * distance, std::nullopt, std::nullopt};
}

Extrapolation of_a_monotone_course(const std::vector<Sample>& samples, double formal) {
  const Fit best = best_fit(samples);
  const Fit used = best.order > formal ? fit_of(samples, formal) : best;
  Extrapolation found{Course::monotone, best.limit, 0.0, best.order, order_error_of(samples, best)};
  if (best.order < lowest_order) {
    found.course = Course::slow;
    found.limit = samples[0].value;
    found.uncertainty = cautious * range_of(samples);
    return found;
  }
  const double scatter = std::sqrt(best.squares / static_cast<double>(samples.size()));
  found.uncertainty = safe * std::abs(samples[0].value - used.limit) + scatter;
  return found;
}

}  // namespace

std::string_view name_of(Course course) {
  switch (course) {
    case Course::still:
      return "still";
    case Course::monotone:
      return "monotone";
    case Course::slow:
      return "slow";
    case Course::oscillating:
      return "oscillating";
    case Course::two:
      break;
  }
  return "two values";
}

Extrapolation extrapolate(std::vector<Sample> samples, double formal) {
  std::ranges::sort(samples, {}, &Sample::size);
  check(samples);
  const double range = range_of(samples);
  if (range <= round_off * std::abs(samples[0].value)) {
    return {Course::still, samples[0].value, range, std::nullopt, std::nullopt};
  }
  if (samples.size() == 2) return of_two(samples, formal);
  const double fine = samples[1].value - samples[0].value;
  const double coarse = samples[2].value - samples[1].value;
  if (fine * coarse < 0.0) {
    return {Course::oscillating, samples[0].value, cautious * range, std::nullopt, std::nullopt};
  }
  return of_a_monotone_course(samples, formal);
}

std::optional<Slope> slope_of_errors(const std::vector<Sample>& errors) {
  std::vector<double> x, y;
  for (const Sample& sample : errors) {
    const double error = std::abs(sample.value);
    if (!(error > 0.0) || !std::isfinite(error) || !(sample.size > 0.0)) continue;
    x.push_back(std::log(sample.size));
    y.push_back(std::log(error));
  }
  if (x.size() < 2) return std::nullopt;
  const auto count = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / count;
    mean_y += y[i] / count;
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0.0)) return std::nullopt;
  Slope slope{xy / xx, std::nullopt};
  if (x.size() == 2) return slope;
  double squares = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double left = y[i] - mean_y - slope.order * (x[i] - mean_x);
    squares += left * left;
  }
  slope.standard_error = std::sqrt(squares / (count - 2.0) / xx);
  return slope;
}

}  // namespace convergence
