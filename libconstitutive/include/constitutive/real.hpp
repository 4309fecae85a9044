#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

/// What a stress update asks of its number type `Real`, with the answers for `double`.
///
/// The hot updates are templates over `Real`, so that one text serves a single point (`double`) and
/// several points side by side in the lanes of a vector register. Such a pack type, which is the
/// caller's, has arithmetic, comparisons to a mask with &, | and !, `Eigen::NumTraits`, and in its
/// own namespace the functions below as well as sqrt, hypot, abs, min and max, lane by lane.
namespace constitutive {

/// Result of comparing two numbers: bool for `double`.
template <class Real>
using Mask = decltype(Real() < Real());

/// `yes` where the condition holds, otherwise `no`.
inline double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}

/// Whether the condition holds in any lane.
inline bool any(bool condition) {
  return condition;
}

/// Neither infinite nor NaN.
inline bool is_finite(double x) {
  return std::isfinite(x);
}

}  // namespace constitutive
