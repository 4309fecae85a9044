#pragma once

namespace fpm {

/// Radial kernels with compact support. Their normalisation cancels in every corrected weight, so
/// they are given up to a factor, with W(0) = 1.
enum class Kernel {
  cubic_spline,    ///< C2 piecewise cubic, support R = 2 ls (the paper's choice)
  quintic_spline,  ///< C4 piecewise quintic, support R = 3 ls
  wendland_c2,     ///< Wendland's C2 polynomial, support R = 2 ls
};

/// Support radius over smoothing length, R / ls.
double support_over_smoothing_length(Kernel kernel);

/// Value and radial derivative of a kernel at one distance.
struct KernelValue {
  double value = 0.0;       ///< W(r), W(0) = 1
  double derivative = 0.0;  ///< dW/dr [1/length], never positive
};

/// Kernel at distance `r` from its centre, zero from `support_radius` on.
/// @param r  [length] >= 0
/// @param support_radius  [length] > 0
KernelValue evaluate(Kernel kernel, double r, double support_radius);

}  // namespace fpm
