#include "jfnk/block_jacobi.hpp"

#include <Eigen/LU>
#include <stdexcept>
#include <string>

namespace jfnk {

BlockJacobi::BlockJacobi(const Eigen::SparseMatrix<double>& matrix, int block) : block_(block) {
  if (matrix.rows() != matrix.cols()) {
    throw std::invalid_argument("jfnk::BlockJacobi: the matrix is " +
                                std::to_string(matrix.rows()) + " x " +
                                std::to_string(matrix.cols()) + ", not square");
  }
  if (block < 1 || matrix.rows() % block != 0) {
    throw std::invalid_argument("jfnk::BlockJacobi: blocks of " + std::to_string(block) +
                                " do not divide a matrix of " + std::to_string(matrix.rows()));
  }
  inverse_.assign(static_cast<std::size_t>(matrix.rows() / block),
                  Eigen::MatrixXd::Zero(block, block));
  update(matrix);
}

void BlockJacobi::update(const Eigen::SparseMatrix<double>& matrix) {
  const auto rows = static_cast<Eigen::Index>(inverse_.size()) * block_;
  if (matrix.rows() != rows || matrix.cols() != rows) {
    throw std::invalid_argument("jfnk::BlockJacobi: the matrix has " +
                                std::to_string(matrix.rows()) + " rows, it had " +
                                std::to_string(rows));
  }
  singular_ = 0;
  for (Eigen::MatrixXd& inverse : inverse_) inverse.setZero();
  for (int column = 0; column < matrix.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator it(matrix, column); it; ++it) {
      if (it.row() / block_ != it.col() / block_) continue;
      inverse_[static_cast<std::size_t>(it.row() / block_)](it.row() % block_, it.col() % block_) +=
          it.value();
    }
  }
  for (Eigen::MatrixXd& inverse : inverse_) {
    const Eigen::FullPivLU<Eigen::MatrixXd> factors(inverse);
    if (factors.isInvertible()) {
      inverse = factors.inverse();
    } else {
      inverse.setIdentity();
      ++singular_;
    }
  }
}

void BlockJacobi::apply(const Vector& r, Vector& z) const {
  z.resize(r.size());
  for (std::size_t k = 0; k < inverse_.size(); ++k) {
    const auto first = static_cast<Eigen::Index>(k) * block_;
    z.segment(first, block_).noalias() = inverse_[k] * r.segment(first, block_);
  }
}

}  // namespace jfnk
