#pragma once

#include <optional>
#include <string_view>
#include <vector>

namespace convergence {

/// A value computed with one size of what is refined: spacing, step, tolerance.
struct Sample {
  double size = 0.0;  // > 0
  double value = 0.0;
};

/// How values go as the size falls.
enum class Course {
  still,        // the finest values are equal up to round-off
  monotone,     // differences shrink, with an order from 0.5 on
  slow,         // with a lower one, or they do not shrink
  oscillating,  // they change sign
  two,          // two values only: the order is assumed
};
[[nodiscard]] std::string_view name_of(Course course);

/// The value at size 0, and how far the finest value may be from it.
struct Extrapolation {
  Course course = Course::two;
  double limit = 0.0;
  double uncertainty = 0.0;           // of the finest value, on both sides
  std::optional<double> order;        // observed; absent where there is none
  std::optional<double> order_error;  // its standard error; absent below four values
};

/// Richardson's extrapolation of at least two samples of different sizes, in any order, safeguarded
/// as the grid convergence index is (Roache 1994; Eca & Hoekstra, J. Comput. Phys. 262 (2014) 104):
///
/// value = limit + a size^p by least squares over all samples. Where the values settle
/// monotonically with p >= 0.5, the uncertainty is 1.25 |finest - limit| and the scatter about the
/// fit, p taken as `formal` at most, since a larger one is a cancellation that ends. Elsewhere it
/// is three times the range of the three finest values, or of both of two, by Richardson of the
/// formal order, and the limit is the finest value, where the values do not say more.
/// @param formal  the highest order the method can have
/// @throws std::invalid_argument for fewer than two samples, equal sizes, or what is not finite.
[[nodiscard]] Extrapolation extrapolate(std::vector<Sample> samples, double formal = 2.0);

/// The slope of log |error| over log size, and its standard error (absent for two samples); nothing
/// if fewer than two samples have an error that is not 0.
struct Slope {
  double order = 0.0;
  std::optional<double> standard_error;
};
[[nodiscard]] std::optional<Slope> slope_of_errors(const std::vector<Sample>& errors);

}  // namespace convergence
