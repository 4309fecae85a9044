#pragma once

#include <span>
#include <vector>

#include "jfnk/vector_operations.hpp"

namespace equilibrium {

/// What libjfnk does with vectors, on the threads of OpenMP. Blocks of rows are shared out and
/// their sums added up in order: the bits are those of libjfnk's own, for any number of threads.
class ThreadedVectors {
 public:
  /// @param particles  of which vectors hold one component after the other
  explicit ThreadedVectors(Eigen::Index particles) : particles_(particles) {}
  double dot(const jfnk::Vector& a, const jfnk::Vector& b) const;
  /// sums[j] = <columns[j], w>. Allocates where w is longer than any before it.
  void dots(jfnk::Vectors columns, const jfnk::Vector& w, std::span<double> sums) const;
  /// w = own w + sum_j factors[j] columns[j]; w is not read if own = 0.
  void combine(double own, jfnk::Vectors columns, std::span<const double> factors,
               jfnk::Vector& w) const;
  /// Both of columns in single precision.
  void dots(jfnk::SingleVectors columns, const jfnk::Vector& w, std::span<double> sums) const;
  void combine(double own, jfnk::SingleVectors columns, std::span<const double> factors,
               jfnk::Vector& w) const;

  std::size_t bytes() const { return block_sums_.capacity() * sizeof(double); }

 private:
  template <class Columns>
  void dots_of(Columns columns, const jfnk::Vector& w, std::span<double> sums) const;

  Eigen::Index particles_;
  mutable std::vector<double> block_sums_;
};

}  // namespace equilibrium
