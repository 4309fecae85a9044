#include "secant_memory.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

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
  next_.resize(capacity_);
  list_.reserve(2 * slots);
  steps_.reserve(slots);
  clear();
}

void SecantMemory::clear(bool with_images) {
  size_ = 0;
  first_ = 0;
  given_ = 0;
  next_known_ = false;
  with_images_ = with_images;
  images_are_old_ = false;
}

// Into a slot, and into work_ y as it is kept, so that the Gram matrix is one whatever the
// rounding.
void SecantMemory::store(const Pair& pair, std::size_t at, const InnerProductRef& product) {
  const bool with_image = with_images_ && !images_are_old_;
  du_.reserve(at, n_);
  y_.reserve(at, n_);
  if (with_image) image_.reserve(at, n_);
  const double factor = 1.0 / pair.length;
  product.pass(n_, with_image ? 7 : 5, [&](Rows rows) {
    du_.assign_rows(at, factor, pair.du, rows);
    y_.assign_rows(at, factor, pair.dr, rows);
    if (with_image) image_.assign_rows(at, factor, *pair.image, rows);
    y_.copy_rows(at, rows, work_);
  });
}

void SecantMemory::add(const Pair& pair, double max_condition, const InnerProductRef& product) {
  next_known_ = false;
  if (!(pair.length > 0.0) || !std::isfinite(pair.length)) return;
  const bool is_full = size_ == capacity_;
  if (is_full) drop_oldest();
  if (pair.image == nullptr) images_are_old_ = true;
  store(pair, slot(size_), product);
  const auto count = static_cast<std::size_t>(size_) + 1;
  const std::array<Products, 2> products{
      {{&work_, {gram_.col(size_).data(), count}}, {pair.next, {next_.data(), count}}}};
  next_known_ = pair.next != nullptr;
  columns(y_, size_ + 1).dots(product, std::span(products).first(next_known_ ? 2 : 1));
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
  next_known_ = false;
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
  Vector step(n_), change(n_);
  const Vector* const measured = &change;
  for (Eigen::Index j = std::max<Eigen::Index>(du.cols() - capacity_, 0); j < du.cols(); ++j) {
    double length = 0.0;
    product.pass(n_, 3,
                 [&](Rows rows) {
                   rows.of(step) = du.col(j).segment(rows.begin, rows.count).cast<double>();
                   rows.of(change) = dr.col(j).segment(rows.begin, rows.count).cast<double>();
                 },
                 {&measured, 1}, {&length, 1});
    add({step, change, length}, max_condition, product);
  }
  given_ = size_;
}

void SecantMemory::copy_latest(int count, Eigen::MatrixXf& du, Eigen::MatrixXf& dr,
                               const InnerProductRef& product) const {
  const int kept = std::clamp(count, 0, size_);
  du.resize(n_, kept);
  dr.resize(n_, kept);
  product.pass(n_, 2 * kept, [&](Rows rows) {
    for (int j = 0; j < kept; ++j) {
      const std::size_t at = slot(size_ - kept + j);
      du_.copy_rows(at, rows, du.col(j).segment(rows.begin, rows.count));
      y_.copy_rows(at, rows, dr.col(j).segment(rows.begin, rows.count));
    }
  });
}

// The first `count` columns of a store, oldest first.
void SecantMemory::list_columns(const ColumnStore& store, int count, ColumnList& list) const {
  list.clear();
  for (int j = 0; j < count; ++j) list.add(store, slot(j));
}

const ColumnList& SecantMemory::columns(const ColumnStore& store, int count) {
  list_columns(store, count, list_);
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
    next_[j] = next_[j + 1];
  }
}

// gamma_ = Y^T r becomes R^-1 R^-T Y^T r.
void SecantMemory::find_gamma() {
  const auto triangle = r_.topLeftCorner(size_, size_).triangularView<Eigen::Upper>();
  triangle.transpose().solveInPlace(gamma_.head(size_));
  triangle.solveInPlace(gamma_.head(size_));
}

// gamma_ = Y^T r.
void SecantMemory::find_products(const Vector& r, const InnerProductRef& product) {
  if (next_known_) {
    gamma_.head(size_) = next_.head(size_);
  } else {
    columns(y_, size_).dots(product, r, gamma_.data());
  }
}

void SecantMemory::project(const Vector& r, Vector& step, Vector& remainder,
                           const InnerProductRef& product) {
  find_products(r, product);
  find_gamma();
  factors_.head(size_) = -gamma_.head(size_);
  list_columns(y_, size_, list_);
  list_columns(du_, size_, steps_);
  remainder.resize(n_);
  step.resize(n_);
  product.pass(n_, 2 * size_ + 3, [&](Rows rows) {
    rows.of(remainder) = rows.of(r);
    list_.combine_rows(rows, 1.0, factors_.data(), remainder);
    steps_.combine_rows(rows, 0.0, factors_.data(), step);
  });
}

void SecantMemory::invert(const Vector& r, const Vector& image, double mixing, double sign,
                          Vector& z, const InnerProductRef& product) {
  find_products(r, product);
  find_gamma();
  factors_.head(size_) = -sign * mixing * gamma_.head(size_);
  factors_.segment(size_, size_) = sign * gamma_.head(size_);
  list_columns(with_images_ ? image_ : y_, size_, list_);
  for (int j = 0; j < size_; ++j) list_.add(du_, slot(j));
  z.resize(n_);
  product.pass(n_, 2 * size_ + 2, [&](Rows rows) {
    rows.of(z) = rows.of(image);
    list_.combine_rows(rows, sign * mixing, factors_.data(), z);
  });
}

}  // namespace jfnk::detail
