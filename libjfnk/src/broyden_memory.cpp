#include "broyden_memory.hpp"

#include <cmath>

namespace jfnk::detail {

void BroydenMemory::resize(Eigen::Index n, int capacity) {
  s_.resize(static_cast<std::size_t>(capacity));
  w_.resize(static_cast<std::size_t>(capacity));
  n_ = n;
  along_.resize(capacity, capacity);
  sums_.resize(capacity + 2);
  columns_.reserve(static_cast<std::size_t>(capacity) + 2);
  for (std::vector<Vector>* vectors : {&s_, &w_}) {
    for (Vector& v : *vectors) {
      if (v.size() != n) v.resize(0);
    }
  }
  clear();
}

Vectors BroydenMemory::first_of(const std::vector<Vector>& vectors) {
  columns_.clear();
  for (int i = 0; i < size_; ++i) columns_.push_back(&vectors[static_cast<std::size_t>(i)]);
  return columns_;
}

void BroydenMemory::improve(Vector& z, const InnerProductRef& product) {
  const std::span<double> sums{sums_.data(), static_cast<std::size_t>(size_)};
  product.dots(first_of(s_), z, sums);
  // Each factor sees z with what those before it have added.
  for (int i = 0; i < size_; ++i) {
    for (int j = 0; j < i; ++j) sums_[i] += along_(i, j) * sums_[j];
  }
  product.combine(1.0, first_of(w_), sums, z);
}

void BroydenMemory::improve_by_last(Vector& z, const InnerProductRef& product) const {
  const auto last = static_cast<std::size_t>(size_) - 1;
  z += product.dot(s_[last], z) * w_[last];
}

bool BroydenMemory::add(const Vector& du, const Vector& image, const InnerProductRef& product) {
  // |det H| grows at most tenfold by a pair.
  constexpr double least = 0.1;
  if (full()) return false;
  (void)first_of(w_);
  columns_.push_back(&image);
  columns_.push_back(&du);
  product.dots(columns_, du, {sums_.data(), columns_.size()});
  const double along = sums_[size_];
  const double square = sums_[size_ + 1];
  const bool usable = square > 0.0 && std::isfinite(square) && std::isfinite(product.norm(image));
  if (!usable) return false;
  // dr is mixed with B du, whose image is du.
  double part = 1.0;
  if (std::abs(along) < least * square) {
    const double wanted = along < 0.0 ? -least : least;
    part = (1.0 - wanted) / (1.0 - along / square);
  }
  const auto k = static_cast<std::size_t>(size_);
  const double denominator = part * along + (1.0 - part) * square;
  along_.row(size_).head(size_) = sums_.head(size_);
  s_[k] = du;
  w_[k] = (part / denominator) * (du - image);
  ++size_;
  return true;
}

}  // namespace jfnk::detail
