#pragma once

#include <Eigen/Core>

namespace jfnk::detail {

/// <a, b>; columns may be in single precision, sums are not.
[[nodiscard]] double dot_one(Eigen::Index n, const double* a, const double* b);
[[nodiscard]] double dot_one(Eigen::Index n, const float* a, const double* b);
/// The products of four vectors with b; each as `dot_one` has it, to the bit.
void dot_four(Eigen::Index n, const double* a0, const double* a1, const double* a2,
              const double* a3, const double* b, double* sums);
void dot_four(Eigen::Index n, const float* a0, const float* a1, const float* a2, const float* a3,
              const double* b, double* sums);
/// w += factor a.
void add_one(Eigen::Index n, const double* a, double factor, double* w);
void add_one(Eigen::Index n, const float* a, double factor, double* w);
/// w += factors[0] a0, += factors[1] a1, ... in this order.
void add_four(Eigen::Index n, const double* a0, const double* a1, const double* a2,
              const double* a3, const double* factors, double* w);
void add_four(Eigen::Index n, const float* a0, const float* a1, const float* a2, const float* a3,
              const double* factors, double* w);

}  // namespace jfnk::detail
