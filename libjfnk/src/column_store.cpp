#include "jfnk/column_store.hpp"

namespace jfnk::detail {
namespace {

template <class V>
void fit(std::vector<V>& vectors, std::size_t slots, Eigen::Index n) {
  vectors.resize(slots);
  for (V& v : vectors) {
    if (v.size() != n) v.resize(0);
  }
}

template <class V>
std::size_t bytes_of(const std::vector<V>& vectors) {
  Eigen::Index numbers = 0;
  for (const V& v : vectors) numbers += v.size();
  return static_cast<std::size_t>(numbers) * sizeof(typename V::Scalar);
}

}  // namespace

void ColumnStore::resize(std::size_t slots, Eigen::Index n, bool single_precision) {
  is_single_ = single_precision;
  fit(doubles_, is_single_ ? 0 : slots, n);
  fit(singles_, is_single_ ? slots : 0, n);
}

void ColumnStore::reserve(std::size_t slot, Eigen::Index n) {
  is_single_ ? singles_[slot].resize(n) : doubles_[slot].resize(n);
}

void ColumnStore::assign_rows(std::size_t slot, double factor, const Vector& v, Rows rows) {
  if (is_single_) {
    rows.of(singles_[slot]) = (factor * rows.of(v)).cast<float>();
  } else {
    rows.of(doubles_[slot]) = factor * rows.of(v);
  }
}

void ColumnStore::copy_rows(std::size_t slot, Rows rows, Vector& kept) const {
  if (is_single_) {
    rows.of(kept) = rows.of(singles_[slot]).cast<double>();
  } else {
    rows.of(kept) = rows.of(doubles_[slot]);
  }
}

void ColumnStore::copy_rows(std::size_t slot, Rows rows, Eigen::Ref<SingleVector> kept) const {
  if (is_single_) {
    kept = rows.of(singles_[slot]);
  } else {
    kept = rows.of(doubles_[slot]).cast<float>();
  }
}

void ColumnStore::assign(std::size_t slot, double factor, const Vector& v,
                         const InnerProductRef& product) {
  reserve(slot, v.size());
  product.pass(v.size(), 2, [&](Rows rows) { assign_rows(slot, factor, v, rows); });
}

void ColumnStore::copy_to(std::size_t slot, Vector& v, const InnerProductRef& product) const {
  v.resize(is_single_ ? singles_[slot].size() : doubles_[slot].size());
  product.pass(v.size(), 2, [&](Rows rows) { copy_rows(slot, rows, v); });
}

void ColumnStore::rotate(std::size_t i, double c, double s, const InnerProductRef& product) {
  const auto turn = [&](auto& a, auto& b) {
    using Scalar = typename std::remove_reference_t<decltype(a)>::Scalar;
    product.pass(a.size(), 4, [&](Rows rows) {
      for (Eigen::Index k = rows.begin; k < rows.begin + rows.count; ++k) {
        const auto upper = static_cast<double>(a[k]), lower = static_cast<double>(b[k]);
        a[k] = static_cast<Scalar>(c * upper + s * lower);
        b[k] = static_cast<Scalar>(c * lower - s * upper);
      }
    });
  };
  is_single_ ? turn(singles_[i], singles_[i + 1]) : turn(doubles_[i], doubles_[i + 1]);
}

std::size_t ColumnStore::bytes() const {
  return bytes_of(doubles_) + bytes_of(singles_);
}

void ColumnList::clear() {
  doubles_.clear();
  singles_.clear();
}

void ColumnList::reserve(std::size_t count) {
  doubles_.reserve(count);
  singles_.reserve(count);
}

void ColumnList::add(const ColumnStore& store, std::size_t slot) {
  if (store.is_single_) {
    singles_.push_back(&store.singles_[slot]);
  } else {
    doubles_.push_back(&store.doubles_[slot]);
  }
}

void ColumnList::dots(const InnerProductRef& product, const Vector& w, double* sums) const {
  const Products one{&w, {sums, size()}};
  dots(product, {&one, 1});
}

void ColumnList::dots(const InnerProductRef& product, std::span<const Products> products) const {
  if (!doubles_.empty()) product.dots(Vectors(doubles_), products);
  if (!singles_.empty()) product.dots(SingleVectors(singles_), products);
}

void ColumnList::combine(const InnerProductRef& product, double own, const double* factors,
                         Vector& w) const {
  if (!singles_.empty()) {
    product.combine(own, SingleVectors(singles_), {factors, singles_.size()}, w);
  } else {
    product.combine(own, Vectors(doubles_), {factors, doubles_.size()}, w);
  }
}

void ColumnList::combine_rows(Rows rows, double own, const double* factors, Vector& w) const {
  if (!singles_.empty()) {
    jfnk::combine_rows(rows, own, SingleVectors(singles_), {factors, singles_.size()}, w);
  } else {
    jfnk::combine_rows(rows, own, Vectors(doubles_), {factors, doubles_.size()}, w);
  }
}

}  // namespace jfnk::detail
