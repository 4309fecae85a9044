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

/// One sentence on why the solve ended, with its numbers, and what to try if it failed.
/// @param decades  that the first u spans
[[nodiscard]] std::string reason(const Report& report, const Options& options, double decades);

/// Decades between the lower and the upper tenth of the |v_i| that are not zero; 0 if none are.
[[nodiscard]] double decades_of(const Vector& v);

}  // namespace jfnk::detail
