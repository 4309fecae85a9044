#pragma once

#include <Eigen/SparseCore>
#include <vector>

namespace limit::algebra {

/// Gathers linear equations row by row.
class EquationBuilder {
 public:
  /// Begins the next equation, whose right side this is.
  void begin(double right_side) { right_side_.push_back(right_side); }

  /// Adds coefficient x variable to the equation begun last.
  void add(Eigen::Index variable, double coefficient) {
    if (coefficient == 0.0) return;
    entries_.emplace_back(static_cast<Eigen::Index>(right_side_.size()) - 1, variable, coefficient);
  }

  [[nodiscard]] Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(Eigen::Index variables) const {
    Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(
        static_cast<Eigen::Index>(right_side_.size()), variables);
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

  [[nodiscard]] Eigen::VectorXd right_side() const {
    return Eigen::Map<const Eigen::VectorXd>(right_side_.data(),
                                             static_cast<Eigen::Index>(right_side_.size()));
  }

 private:
  std::vector<Eigen::Triplet<double, Eigen::Index>> entries_;
  std::vector<double> right_side_;
};

}  // namespace limit::algebra
