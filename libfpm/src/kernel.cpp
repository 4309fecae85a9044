#include "fpm/kernel.hpp"

namespace fpm {
namespace {

double power(double base, int exponent) {
  double result = 1.0;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

// Each takes q = r / ls and returns W and dW/dq, both relative to W(0) = 1.
KernelValue cubic_spline(double q) {
  if (q < 1.0) return {1.0 - 1.5 * q * q + 0.75 * q * q * q, -3.0 * q + 2.25 * q * q};
  const double s = 2.0 - q;
  return {0.25 * s * s * s, -0.75 * s * s};
}

KernelValue quintic_spline(double q) {
  constexpr double at_centre = 66.0;
  double value = power(3.0 - q, 5);
  double slope = -5.0 * power(3.0 - q, 4);
  if (q < 2.0) {
    value -= 6.0 * power(2.0 - q, 5);
    slope += 30.0 * power(2.0 - q, 4);
  }
  if (q < 1.0) {
    value += 15.0 * power(1.0 - q, 5);
    slope -= 75.0 * power(1.0 - q, 4);
  }
  return {value / at_centre, slope / at_centre};
}

KernelValue wendland_c2(double q) {
  const double s = 1.0 - 0.5 * q;
  return {power(s, 4) * (1.0 + 2.0 * q), -5.0 * q * power(s, 3)};
}

}  // namespace

double support_over_smoothing_length(Kernel kernel) {
  return kernel == Kernel::quintic_spline ? 3.0 : 2.0;
}

KernelValue evaluate(Kernel kernel, double r, double support_radius) {
  if (r >= support_radius) return {};
  const double smoothing_length = support_radius / support_over_smoothing_length(kernel);
  const double q = r / smoothing_length;
  KernelValue w;
  switch (kernel) {
    case Kernel::cubic_spline:
      w = cubic_spline(q);
      break;
    case Kernel::quintic_spline:
      w = quintic_spline(q);
      break;
    case Kernel::wendland_c2:
      w = wendland_c2(q);
      break;
  }
  w.derivative /= smoothing_length;
  return w;
}

}  // namespace fpm
