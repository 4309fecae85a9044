#include "jfnk/residual.hpp"

#include <cmath>
#include <limits>

namespace jfnk {

double InnerProductRef::norm(const Vector& a) const {
  // Squares of entries beyond these bounds overflow or lose digits to underflow.
  constexpr double smallest = std::numeric_limits<double>::min() * 1e16;
  const double square = dot(a, a);
  // Eigen's stableNorm may step over a NaN.
  if (std::isnan(square)) return square;
  if (dot_ == nullptr && !(square > smallest && std::isfinite(square))) return a.stableNorm();
  return std::sqrt(square);
}

}  // namespace jfnk
