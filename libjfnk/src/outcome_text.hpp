#pragma once

#include <string>

#include "jfnk/options.hpp"
#include "jfnk/report.hpp"
#include "jfnk/residual.hpp"

namespace jfnk::detail {

/// A number to be read: so many digits, no trailing zeros, no minus before zero.
[[nodiscard]] std::string number(double value, int digits = 3);

/// Index of the first NaN or infinity, -1 if there is none.
/// @param written_only  pass over what the residual did not write
[[nodiscard]] Eigen::Index first_not_finite(const Vector& v, bool written_only = false);

/// What is wrong with an F that did not overwrite a component of r.
[[nodiscard]] std::string unwritten_text(Eigen::Index component);

/// How large the components of a vector are that are not zero.
struct Sizes {
  double decades = 0.0;  ///< between the lower and the upper tenth of the |v_i|
  double typical = 0.0;  ///< their median; 0 if all are zero
};
[[nodiscard]] Sizes sizes_of(const Vector& v);

/// One sentence on why the solve ended, with its numbers, and what to try if it failed.
/// @param first  sizes of the first u, for a word on units
[[nodiscard]] std::string reason(const Report& report, const Options& options, const Sizes& first);

}  // namespace jfnk::detail
