#include "secant_memory.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk::detail {
namespace {

// A Gram-Schmidt sweep is repeated when it cancels more than this (Daniel et al. 1976): the memory
// lives long, so Q is kept orthogonal to round-off.
constexpr double reorthogonalise_below = 0.5;

// Rows rotated together: 20 columns of 256 doubles stay in a first-level cache of 48 kB.
constexpr Eigen::Index rows_per_block = 256;

}  // namespace

void SecantMemory::resize(Eigen::Index n, int capacity) {
  capacity_ = capacity;
  const auto columns = static_cast<std::size_t>(capacity_);
  du_.resize(columns);
  q_.resize(columns);
  n_ = n;
  // Grown as pairs come: most solves hold few.
  for (std::vector<Vector>* vectors : {&du_, &q_}) {
    for (Vector& v : *vectors) {
      if (v.size() != n) v.resize(0);
    }
  }
  r_.resize(capacity_, capacity_);
  work_.resize(n);
  column_.resize(capacity_);
  gamma_.resize(capacity_);
  cosines_.resize(capacity_);
  sines_.resize(capacity_);
  clear();
}

void SecantMemory::clear() {
  size_ = 0;
  first_ = 0;
}

void SecantMemory::add(const Vector& du, const Vector& dr, double max_condition,
                       const InnerProductRef& product) {
  const double length = product.norm(dr);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  if (size_ == capacity_) drop_oldest();
  double diagonal = 0.0;
  while (true) {
    work_ = dr / length;
    diagonal = orthogonalise(product);
    if (size_ == 0 || well_conditioned(diagonal, max_condition)) break;
    drop_oldest();
  }
  this->du(size_) = du / length;
  q_[static_cast<std::size_t>(size_)] = work_ / diagonal;
  r_.col(size_).head(size_) = column_.head(size_);
  r_(size_, size_) = diagonal;
  ++size_;
}

bool SecantMemory::append(const Vector& du, const Vector& q,
                          const Eigen::Ref<const Eigen::VectorXd>& column, double max_condition) {
  const double length = column.norm();
  if (size_ == capacity_ || !(length > 0.0) || !std::isfinite(length)) return false;
  const double diagonal = std::abs(column[size_]) / length;
  if (!well_conditioned(diagonal, max_condition)) return false;
  this->du(size_) = du / length;
  q_[static_cast<std::size_t>(size_)] = q;
  r_.col(size_).head(size_ + 1) = column / length;
  ++size_;
  return true;
}

// Removes from work_ its parts along Q, whose coefficients go to column_; returns what is left.
double SecantMemory::orthogonalise(const InnerProductRef& product) {
  double before = 1.0;
  double after = product.norm(work_);
  column_.setZero();
  for (int sweep = 0; sweep < 2 && size_ > 0; ++sweep) {
    for (int j = 0; j < size_; ++j) {
      const Vector& q = q_[static_cast<std::size_t>(j)];
      const double h = product.dot(q, work_);
      work_ -= h * q;
      column_[j] += h;
    }
    after = product.norm(work_);
    if (after >= reorthogonalise_below * before) break;
    before = after;
  }
  return after;
}

bool SecantMemory::well_conditioned(double diagonal, double max_condition) const {
  double low = diagonal;
  double high = diagonal;
  for (int i = 0; i < size_; ++i) {
    const double d = std::abs(r_(i, i));
    low = std::min(low, d);
    high = std::max(high, d);
  }
  return high <= max_condition * low;
}

// R without its first column is Hessenberg; Givens rotations of its rows and of the columns of Q
// bring the triangle back (Daniel, Gragg, Kaufman & Stewart 1976).
void SecantMemory::drop_oldest() {
  const int kept = size_ - 1;
  for (int j = 0; j < kept; ++j) r_.col(j).head(j + 2) = r_.col(j + 1).head(j + 2);
  for (int i = 0; i < kept; ++i) {
    const double length = std::hypot(r_(i, i), r_(i + 1, i));
    const double c = length == 0.0 ? 1.0 : r_(i, i) / length;
    const double s = length == 0.0 ? 0.0 : r_(i + 1, i) / length;
    for (int j = i; j < kept; ++j) {
      const double upper = r_(i, j);
      const double lower = r_(i + 1, j);
      r_(i, j) = c * upper + s * lower;
      r_(i + 1, j) = c * lower - s * upper;
    }
    cosines_[i] = c;
    sines_[i] = s;
  }
  rotate_columns();
  first_ = (first_ + 1) % capacity_;
  size_ = kept;
}

void SecantMemory::rotate_columns() {
  const Eigen::Index n = work_.size();
  for (Eigen::Index begin = 0; begin < n; begin += rows_per_block) {
    const Eigen::Index rows = std::min(rows_per_block, n - begin);
    for (int i = 0; i + 1 < size_; ++i) {
      double* a = q_[static_cast<std::size_t>(i)].data() + begin;
      double* b = q_[static_cast<std::size_t>(i) + 1].data() + begin;
      const double c = cosines_[i];
      const double s = sines_[i];
      for (Eigen::Index k = 0; k < rows; ++k) {
        const double upper = a[k];
        const double lower = b[k];
        a[k] = c * upper + s * lower;
        b[k] = c * lower - s * upper;
      }
    }
  }
}

void SecantMemory::project(const Vector& r, Vector& step, Vector& remainder,
                           const InnerProductRef& product) {
  remainder = r;
  for (int j = 0; j < size_; ++j) {
    const Vector& q = q_[static_cast<std::size_t>(j)];
    gamma_[j] = product.dot(q, remainder);
    remainder -= gamma_[j] * q;
  }
  for (int i = size_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < size_; ++j) gamma_[i] -= r_(i, j) * gamma_[j];
    gamma_[i] /= r_(i, i);
  }
  step.setZero();
  for (int j = 0; j < size_; ++j) step -= gamma_[j] * du(j);
}

}  // namespace jfnk::detail
