#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "compare/source.hpp"

namespace comparison {

/// A bound on differences of the fields whose name matches a pattern (`*` and `?` as in a shell).
/// A pattern without a slash also matches the last part of a name.
struct Tolerance {
  std::string pattern = "*";
  double value = 0.0;
};

/// What is compared, and what is let pass.
struct Request {
  std::vector<Tolerance> absolute{};  // in the unit of the field; the last that matches counts
  std::vector<Tolerance> relative{};  // of the field's largest magnitude; likewise, and both add up
  std::vector<std::string> only{};    // patterns; empty: all fields
  std::vector<std::string> ignored{};
};

/// How far a field of one source is from that of the other.
struct Difference {
  std::string name;
  std::string unit;
  std::string obstacle;        // why it cannot be compared number by number, or ""
  bool identical = false;      // bit by bit
  double largest = 0.0;        // absolute; infinite if only one of two numbers is finite
  double relative = 0.0;       // `largest` over the largest magnitude of either field
  std::size_t count = 0;       // of the numbers that differ
  std::size_t at = 0;          // index of the largest
  std::size_t row = 0;         // of `at`: the particle, or the row of the curve
  std::size_t component = 0;   // of `at`
  std::size_t components = 1;  // of the field
  double first = 0.0;          // the two numbers there
  double second = 0.0;
  bool passes = false;
};

/// Whether a field's name matches a pattern.
[[nodiscard]] bool matches(const std::string& name, const std::string& pattern);

/// The largest difference of two fields; NaN is equal to NaN.
[[nodiscard]] Difference difference_of(const Quantity& a, const Quantity& b);

/// The differences of all fields that the request asks for, in the order of their names. A field
/// that only one of them has is a difference. Curves are compared at the steps that both have; that
/// one has others is a difference of `curve/step`.
[[nodiscard]] std::vector<Difference> differences(const Source& a, const Source& b,
                                                  const Request& request);

}  // namespace comparison
