#include "secant_memory.hpp"

#include <algorithm>
#include <cmath>

namespace jfnk::detail {
namespace {

// A Gram-Schmidt sweep is repeated when it cancels more than this (Daniel et al. 1976): the memory
// lives long, so Q is kept orthogonal to round-off.
constexpr double reorthogonalise_below = 0.7;

}  // namespace

void SecantMemory::resize(Eigen::Index n, int capacity) {
  capacity_ = capacity;
  const auto columns = static_cast<std::size_t>(capacity_);
  du_.resize(columns);
  q_.resize(columns);
  image_.resize(columns);
  n_ = n;
  // Grown as pairs come: most solves hold few.
  for (std::vector<Vector>* vectors : {&du_, &q_, &image_}) {
    for (Vector& v : *vectors) {
      if (v.size() != n) v.resize(0);
    }
  }
  r_.resize(capacity_, capacity_);
  work_.resize(n);
  column_.resize(capacity_);
  sums_.resize(2 * capacity_);
  gamma_.resize(capacity_);
  cosines_.resize(capacity_);
  sines_.resize(capacity_);
  columns_.reserve(2 * columns);
  rotated_.reserve(columns);
  clear();
}

void SecantMemory::clear(bool with_images) {
  size_ = 0;
  first_ = 0;
  with_images_ = with_images;
  images_are_old_ = false;
}

void SecantMemory::add(const Vector& du, const Vector& dr, double max_condition,
                       const InnerProductRef& product, const Vector* image) {
  const double length = product.norm(dr);
  if (!(length > 0.0) || !std::isfinite(length)) return;
  if (size_ == capacity_) drop_oldest(product);
  double diagonal = 0.0;
  while (true) {
    work_ = dr / length;
    diagonal = orthogonalise(product);
    if (size_ == 0 || well_conditioned(diagonal, max_condition)) break;
    drop_oldest(product);
  }
  const auto last = static_cast<std::size_t>(size_);
  this->du(size_) = du / length;
  q_[last] = work_ / diagonal;
  if (image == nullptr) images_are_old_ = true;
  if (with_images_ && !images_are_old_) {
    // q is what is left of dr, and so is its image.
    sums_.head(size_) = -column_.head(size_) / diagonal;
    image_[last] = *image;
    product.combine(1.0 / length / diagonal, first_of(image_), {sums_.data(), last}, image_[last]);
  }
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
  images_are_old_ = true;
  ++size_;
  return true;
}

Vectors SecantMemory::first_of(const std::vector<Vector>& vectors) {
  columns_.clear();
  for (int j = 0; j < size_; ++j) columns_.push_back(&vectors[static_cast<std::size_t>(j)]);
  return columns_;
}

// Removes from work_ its parts along Q, whose coefficients go to column_; returns what is left.
// Classical Gram-Schmidt: all the inner products of a sweep are one sum.
double SecantMemory::orthogonalise(const InnerProductRef& product) {
  double before = 1.0;
  double after = 1.0;
  column_.setZero();
  if (size_ == 0) return product.norm(work_);
  const auto size = static_cast<std::size_t>(size_);
  for (int sweep = 0; sweep < 2; ++sweep) {
    const Vectors q = first_of(q_);
    product.dots(q, work_, {sums_.data(), size});
    column_.head(size_) += sums_.head(size_);
    sums_.head(size_) *= -1.0;
    product.combine(1.0, q, {sums_.data(), size}, work_);
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
void SecantMemory::drop_oldest(const InnerProductRef& product) {
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
  rotate(q_, product);
  if (with_images_ && !images_are_old_) rotate(image_, product);
  first_ = (first_ + 1) % capacity_;
  size_ = kept;
}

void SecantMemory::rotate(std::vector<Vector>& vectors, const InnerProductRef& product) {
  rotated_.clear();
  for (int j = 0; j < size_; ++j) rotated_.push_back(&vectors[static_cast<std::size_t>(j)]);
  const auto turns = static_cast<std::size_t>(size_ - 1);
  product.rotate(rotated_, {cosines_.data(), turns}, {sines_.data(), turns});
}

// gamma_ = Q^T r becomes R^-1 Q^T r.
void SecantMemory::find_gamma() {
  for (int i = size_ - 1; i >= 0; --i) {
    for (int j = i + 1; j < size_; ++j) gamma_[i] -= r_(i, j) * gamma_[j];
    gamma_[i] /= r_(i, i);
  }
}

void SecantMemory::project(const Vector& r, Vector& step, Vector& remainder,
                           const InnerProductRef& product) {
  const auto size = static_cast<std::size_t>(size_);
  const Vectors q = first_of(q_);
  remainder = r;
  product.dots(q, r, {gamma_.data(), size});
  sums_.head(size_) = -gamma_.head(size_);
  product.combine(1.0, q, {sums_.data(), size}, remainder);
  find_gamma();
  sums_.head(size_) = -gamma_.head(size_);
  columns_.clear();
  for (int j = 0; j < size_; ++j) columns_.push_back(&du(j));
  product.combine(0.0, columns_, {sums_.data(), size}, step);
}

void SecantMemory::invert(const Vector& r, const Vector& image, double mixing, Vector& z,
                          const InnerProductRef& product) {
  const auto size = static_cast<std::size_t>(size_);
  product.dots(first_of(q_), r, {gamma_.data(), size});
  sums_.head(size_) = -mixing * gamma_.head(size_);
  find_gamma();
  sums_.segment(size_, size_) = gamma_.head(size_);
  (void)first_of(with_images_ ? image_ : q_);
  for (int j = 0; j < size_; ++j) columns_.push_back(&du(j));
  z = image;
  product.combine(mixing, columns_, {sums_.data(), 2 * size}, z);
}

}  // namespace jfnk::detail
