#include "broyden_memory.hpp"

#include <cmath>

namespace jfnk::detail {

void BroydenMemory::resize(Eigen::Index n, int capacity) {
  s_.resize(static_cast<std::size_t>(capacity));
  w_.resize(static_cast<std::size_t>(capacity));
  n_ = n;
  for (std::vector<Vector>* vectors : {&s_, &w_}) {
    for (Vector& v : *vectors) {
      if (v.size() != n) v.resize(0);
    }
  }
  clear();
}

void BroydenMemory::improve(Vector& z, const InnerProductRef& product) const {
  for (int i = 0; i < size_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    z += product.dot(s_[k], z) * w_[k];
  }
}

void BroydenMemory::improve_by_last(Vector& z, const InnerProductRef& product) const {
  const auto last = static_cast<std::size_t>(size_) - 1;
  z += product.dot(s_[last], z) * w_[last];
}

bool BroydenMemory::add(const Vector& du, const Vector& image, const InnerProductRef& product) {
  // |det H| grows at most tenfold by a pair.
  constexpr double least = 0.1;
  const double square = product.dot(du, du);
  const double along = product.dot(du, image);
  const bool usable = square > 0.0 && std::isfinite(square) && std::isfinite(product.norm(image));
  if (full() || !usable) return false;
  // dr is mixed with B du, whose image is du.
  double part = 1.0;
  if (std::abs(along) < least * square) {
    const double wanted = along < 0.0 ? -least : least;
    part = (1.0 - wanted) / (1.0 - along / square);
  }
  const auto k = static_cast<std::size_t>(size_);
  const double denominator = part * along + (1.0 - part) * square;
  s_[k] = du;
  w_[k] = (part / denominator) * (du - image);
  ++size_;
  return true;
}

}  // namespace jfnk::detail
