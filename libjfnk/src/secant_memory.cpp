#include "secant_memory.hpp"

#include <algorithm>
#include <cmath>

#include "passes.hpp"

namespace jfnk::detail {

void SecantMemory::resize(Eigen::Index n, int capacity, bool single_precision) {
  capacity_ = capacity;
  n_ = n;
  const auto slots = static_cast<std::size_t>(capacity_);
  for (ColumnStore* store : {&du_, &y_, &image_}) store->resize(slots, n, single_precision);
  gram_.resize(capacity_, capacity_);
  r_.resize(capacity_, capacity_);
  work_.resize(n);
  factors_.resize(2 * capacity_);
  gamma_.resize(capacity_);
  list_.reserve(2 * slots);
  clear();
}

void SecantMemory::clear(bool with_images) {
  size_ = 0;
  first_ = 0;
  given_ = 0;
  with_images_ = with_images;
  images_are_old_ = false;
}

void SecantMemory::add(const Vector& du, const Vector& dr, double max_condition,
                       const InnerProductRef& product, const Vector* image) {
  const double length = product.norm(dr);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const bool is_full = size_ == capacity_;
  if (is_full) drop_oldest();
  const std::size_t at = slot(size_);
  du_.assign(at, 1.0 / length, du, product);
  y_.assign(at, 1.0 / length, dr, product);
  if (image == nullptr) images_are_old_ = true;
  if (with_images_ && !images_are_old_) image_.assign(at, 1.0 / length, *image, product);
  // As it is kept, so that the Gram matrix is one whatever the rounding.
  y_.copy_to(at, work_, product);
  columns(y_, size_ + 1).dots(product, work_, gram_.col(size_).data());
  bool fits = is_full ? factorise(size_ + 1, max_condition) : extend_factor(size_, max_condition);
  ++size_;
  while (!fits) {
    drop_oldest();
    fits = factorise(size_, max_condition);
  }
}

bool SecantMemory::append(const Vector& du, const ColumnList& q,
                          const Eigen::Ref<const Eigen::VectorXd>& column, double max_condition,
                          const InnerProductRef& product) {
  const double length = column.norm();
  if (size_ == capacity_ || !(length > 0.0) || !std::isfinite(length)) return false;
  r_.col(size_).head(size_ + 1) = column / length;
  if (!well_conditioned(size_ + 1, max_condition)) return false;
  gram_.col(size_).head(size_ + 1).noalias() =
      r_.topLeftCorner(size_ + 1, size_ + 1).triangularView<Eigen::Upper>().transpose() *
      r_.col(size_).head(size_ + 1);
  du_.assign(slot(size_), 1.0 / length, du);
  factors_.head(size_ + 1) = r_.col(size_).head(size_ + 1);
  q.combine(product, 0.0, factors_.data(), work_);
  y_.assign(slot(size_), 1.0, work_, product);
  if (y_.is_single()) {
    y_.copy_to(slot(size_), work_, product);
    columns(y_, size_ + 1).dots(product, work_, gram_.col(size_).data());
    if (!extend_factor(size_, max_condition)) return false;
  }
  images_are_old_ = true;
  ++size_;
  return true;
}

void SecantMemory::begin_with(const Eigen::MatrixXf& du, const Eigen::MatrixXf& dr,
                              double max_condition, const InnerProductRef& product) {
  clear(with_images_);
  Vector step, change;
  for (Eigen::Index j = std::max<Eigen::Index>(du.cols() - capacity_, 0); j < du.cols(); ++j) {
    step = du.col(j).cast<double>();
    change = dr.col(j).cast<double>();
    add(step, change, max_condition, product);
  }
  given_ = size_;
}

void SecantMemory::copy_latest(int count, Eigen::MatrixXf& du, Eigen::MatrixXf& dr) const {
  const int kept = std::clamp(count, 0, size_);
  du.resize(n_, kept);
  dr.resize(n_, kept);
  Vector column;
  for (int j = 0; j < kept; ++j) {
    du_.copy_to(slot(size_ - kept + j), column);
    du.col(j) = column.cast<float>();
    y_.copy_to(slot(size_ - kept + j), column);
    dr.col(j) = column.cast<float>();
  }
}

// The first `count` columns of a store, oldest first.
const ColumnList& SecantMemory::columns(const ColumnStore& store, int count) {
  list_.clear();
  for (int j = 0; j < count; ++j) list_.add(store, slot(j));
  return list_;
}

// Column `last` of R from that of the Gram matrix; false if it is not fit for use.
bool SecantMemory::extend_factor(int last, double max_condition) {
  auto column = r_.col(last);
  column.head(last + 1) = gram_.col(last).head(last + 1);
  const auto before = r_.topLeftCorner(last, last).triangularView<Eigen::Upper>();
  before.transpose().solveInPlace(column.head(last));
  const double square = gram_(last, last) - column.head(last).squaredNorm();
  column[last] = square > 0.0 ? std::sqrt(square) : 0.0;
  return last == 0 || (square > 0.0 && well_conditioned(last + 1, max_condition));
}

bool SecantMemory::factorise(int size, double max_condition) {
  for (int j = 0; j < size; ++j) {
    if (!extend_factor(j, max_condition)) return false;
  }
  return true;
}

bool SecantMemory::well_conditioned(int size, double max_condition) const {
  const auto diagonal = r_.diagonal().head(size).cwiseAbs();
  return diagonal.maxCoeff() <= max_condition * diagonal.minCoeff();
}

void SecantMemory::drop_oldest() {
  --size_;
  given_ = std::max(given_ - 1, 0);
  first_ = (first_ + 1) % capacity_;
  for (int j = 0; j < size_; ++j) {
    for (int i = 0; i <= j; ++i) gram_(i, j) = gram_(i + 1, j + 1);
  }
}

// gamma_ = Y^T r becomes R^-1 R^-T Y^T r.
void SecantMemory::find_gamma() {
  const auto triangle = r_.topLeftCorner(size_, size_).triangularView<Eigen::Upper>();
  triangle.transpose().solveInPlace(gamma_.head(size_));
  triangle.solveInPlace(gamma_.head(size_));
}

void SecantMemory::project(const Vector& r, Vector& step, Vector& remainder,
                           const InnerProductRef& product) {
  const ColumnList& ys = columns(y_, size_);
  ys.dots(product, r, gamma_.data());
  find_gamma();
  factors_.head(size_) = -gamma_.head(size_);
  assign(product, remainder, r);
  ys.combine(product, 1.0, factors_.data(), remainder);
  step.resize(n_);
  columns(du_, size_).combine(product, 0.0, factors_.data(), step);
}

void SecantMemory::invert(const Vector& r, const Vector& image, double mixing, Vector& z,
                          const InnerProductRef& product) {
  columns(y_, size_).dots(product, r, gamma_.data());
  find_gamma();
  factors_.head(size_) = -mixing * gamma_.head(size_);
  factors_.segment(size_, size_) = gamma_.head(size_);
  (void)columns(with_images_ ? image_ : y_, size_);
  for (int j = 0; j < size_; ++j) list_.add(du_, slot(j));
  assign(product, z, image);
  list_.combine(product, mixing, factors_.data(), z);
}

}  // namespace jfnk::detail
